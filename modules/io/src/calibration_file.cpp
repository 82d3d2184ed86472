// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "calibration_file.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <sstream>

#include "foothold/io/calibration.h"
#include "text_file.h"

namespace foothold::io {
namespace {

constexpr Intrinsics kSevenScenesDepth{585.0F, 585.0F, 320.0F, 240.0F};
constexpr Intrinsics kSevenScenesColour{525.0F, 525.0F, 320.0F, 240.0F};

/// Where the Kinect of 7-Scenes has its colour camera, found by letting edges of depth meet edges of colour: docs/sequences.md.
SE3 seven_scenes_depth_from_colour() {
  Tangent6 tangent;
  tangent << 0.0043F, 0.0004F, 0.0081F, 0.0F, 0.0F, 0.0F;
  SE3 colour_from_depth = se3_exp(tangent);
  colour_from_depth.translation << -0.0241F, 0.0F, 0.0F;
  return colour_from_depth.inverse();
}

bool same(const Intrinsics& a, const Intrinsics& b) {
  constexpr float kPrinted_px = 1e-3F;  // text files round
  return std::abs(a.fx - b.fx) < kPrinted_px && std::abs(a.fy - b.fy) < kPrinted_px && std::abs(a.cx - b.cx) < kPrinted_px &&
         std::abs(a.cy - b.cy) < kPrinted_px;
}

std::string numbers_text(const std::vector<double>& numbers, std::size_t begin, std::size_t count) {
  std::ostringstream text;
  for (std::size_t i = begin; i < begin + count; ++i) text << (i == begin ? "" : " ") << numbers[i];
  return text.str();
}

Intrinsics read_intrinsics(const std::filesystem::path& file) { return parse_intrinsics(read_file(file, kMaxNumbersFileBytes), file); }

}  // namespace

SE3 parse_transform(std::string_view text, const std::filesystem::path& file) {
  const std::vector<double> numbers = parse_numbers(text, 16, file, "4x4 pose");
  const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  const Eigen::RowVector4d last_row(0.0, 0.0, 0.0, 1.0);
  if ((matrix.row(3) - last_row).cwiseAbs().maxCoeff() > 1e-6) {
    throw_file_error(file, "a last row of " + numbers_text(numbers, 12, 4), "0 0 0 1");
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const double error = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double determinant = rotation.determinant();
  if (!(error <= kRotationTolerance) || !(determinant > 0.0)) {
    std::ostringstream found;
    found << "a matrix R with |R^T R - I| = " << error << " and determinant " << determinant;
    std::ostringstream expected;
    expected << "a rotation: at most " << kRotationTolerance << ", and determinant 1";
    throw_file_error(file, found.str(), expected.str());
  }
  constexpr double kMaxDistance_m = 1e6;  // beyond, single precision no longer resolves a decimetre
  if (matrix.topRightCorner<3, 1>().cwiseAbs().maxCoeff() > kMaxDistance_m) {
    throw_file_error(file, "a translation of " + numbers_text({numbers[3], numbers[7], numbers[11]}, 0, 3), "at most 1e6 m");
  }
  return {nearest_rotation(rotation.cast<float>()), matrix.topRightCorner<3, 1>().cast<float>()};
}

Intrinsics parse_intrinsics(std::string_view text, const std::filesystem::path& file) {
  const std::vector<double> k = parse_numbers(text, 9, file, "3x3 camera matrix");
  constexpr double kMaxFocalLength_px = 1e6;
  for (const std::size_t i : {std::size_t{0}, std::size_t{4}}) {
    if (!(k[i] >= 1.0 && k[i] <= kMaxFocalLength_px)) {
      throw_file_error(file, "a focal length of " + numbers_text(k, i, 1) + " pixels", "1 to 1e6");
    }
  }
  for (const std::size_t i : {std::size_t{2}, std::size_t{5}}) {
    if (!(std::abs(k[i]) <= kMaxFocalLength_px)) {
      throw_file_error(file, "a principal point at " + numbers_text(k, i, 1) + " pixels", "at most 1e6");
    }
  }
  if (k[1] != 0.0 || k[3] != 0.0 || k[6] != 0.0 || k[7] != 0.0 || k[8] != 1.0) {
    throw_file_error(file, "the matrix " + numbers_text(k, 0, 9), "fx 0 cx  0 fy cy  0 0 1");
  }
  return {static_cast<float>(k[0]), static_cast<float>(k[4]), static_cast<float>(k[2]), static_cast<float>(k[5])};
}

RgbdCalibration read_seven_scenes_calibration(const std::filesystem::path& folder) {
  const std::filesystem::path depth_file = folder / "camera-intrinsics.txt";
  const std::filesystem::path colour_file = folder / "colour-intrinsics.txt";
  const std::filesystem::path transform_file = folder / "depth-from-colour.txt";
  const bool has_colour = std::filesystem::exists(colour_file);
  const bool has_transform = std::filesystem::exists(transform_file);

  RgbdCalibration calibration;
  calibration.depth = std::filesystem::exists(depth_file) ? read_intrinsics(depth_file) : kSevenScenesDepth;
  if (!has_colour && !has_transform && same(calibration.depth, kSevenScenesDepth)) {
    calibration.colour = kSevenScenesColour;
    calibration.depth_from_colour = seven_scenes_depth_from_colour();
    return calibration;
  }
  calibration.colour = has_colour ? read_intrinsics(colour_file) : calibration.depth;
  if (has_transform) calibration.depth_from_colour = parse_transform(read_file(transform_file, kMaxNumbersFileBytes), transform_file);
  return calibration;
}

}  // namespace foothold::io

namespace foothold {

RgbdCalibration read_calibration(const std::string& folder) {
  const std::filesystem::path depth_file = std::filesystem::path(folder) / "camera-intrinsics.txt";
  if (!std::filesystem::exists(depth_file)) throw FileError(depth_file.string() + ": missing; expected the 3x3 matrix of the depth camera");
  return io::read_seven_scenes_calibration(folder);
}

}  // namespace foothold
