// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "recorded_pose.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "text_file.h"

namespace foothold::io {
namespace {

bool all_finite(const double* begin, std::size_t count) {
  return std::all_of(begin, begin + count, [](double x) { return std::isfinite(x); });
}

/// The numbers of a file, of which some may be NaN or infinite as "nan", "-inf" or "-1.#IND". @throws FileError for anything else.
std::vector<double> parse_lenient_numbers(std::string_view text, const std::filesystem::path& file) {
  std::vector<double> numbers;
  const std::string bare = bare_numbers(text);
  for (const std::string_view word : split_words(bare)) {
    numbers.push_back(is_not_finite(word) ? std::numeric_limits<double>::quiet_NaN()
                                          : parse_number(word, file, "entry " + std::to_string(numbers.size() + 1) + " of a 4x4 pose"));
  }
  return numbers;
}

void check_rotation(const Eigen::Matrix3d& rotation, const std::filesystem::path& file) {
  const double error = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double determinant = rotation.determinant();
  if (error <= kRotationTolerance && determinant > 0.0) return;
  std::ostringstream found;
  found << "a matrix R with |R^T R - I| = " << error << " and determinant " << determinant;
  std::ostringstream expected;
  expected << "a rotation: at most " << kRotationTolerance << ", and determinant 1";
  throw_file_error(file, found.str(), expected.str());
}

/// True for a matrix that was written column by column: its translation stands in the last row.
bool is_by_columns(const std::vector<double>& n) {
  const auto is_bottom_row = [&](std::size_t i, std::size_t step) {
    return n[i] == 0.0 && n[i + step] == 0.0 && n[i + 2 * step] == 0.0 && n[i + 3 * step] == 1.0;
  };
  return n.size() == 16 && is_bottom_row(3, 4) && !is_bottom_row(12, 1);
}

struct Word {
  const char* word;
  const char* meaning;
  void (*set)(PoseConvention&);
};

constexpr std::array<Word, 8> kWords{{
    {"inverse", "poses are camera_from_world", [](PoseConvention& c) { c.inverse = true; }},
    {"opengl", "the camera looks along -z, y up", [](PoseConvention& c) { c.axes = PoseConvention::Axes::kOpenGl; }},
    {"ros", "the camera looks along x, z up", [](PoseConvention& c) { c.axes = PoseConvention::Axes::kRos; }},
    {"mirror-y", "world and camera have y upwards, left-handed", [](PoseConvention& c) { c.mirror_y = true; }},
    {"w-first", "quaternions are w x y z", [](PoseConvention& c) { c.w_first = true; }},
    {"mm", "positions in millimetres", [](PoseConvention& c) { c.metres_per_unit = 1e-3; }},
    {"cm", "positions in centimetres", [](PoseConvention& c) { c.metres_per_unit = 1e-2; }},
    {"as-is", "none of these", [](PoseConvention& c) { c = {}; }},
}};

/// Takes points of a camera as Foothold has it into one with other axes.
Eigen::Matrix3d theirs_from_ours(PoseConvention::Axes axes) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  if (axes == PoseConvention::Axes::kOpenGl) matrix.diagonal() << 1.0, -1.0, -1.0;
  if (axes == PoseConvention::Axes::kRos) matrix << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return matrix;
}

/// What a rotation would have been, had its quaternion been read w first.
Eigen::Matrix3d reread_w_first(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond read(rotation);
  return Eigen::Quaterniond(read.x(), read.y(), read.z(), read.w()).normalized().toRotationMatrix();
}

}  // namespace

std::optional<RecordedPose> pose_from_matrix(const std::vector<double>& numbers, const std::filesystem::path& file) {
  if (numbers.size() != 16 && numbers.size() != 12) {
    throw_file_error(file, std::to_string(numbers.size()) + " numbers", "16 for a 4x4 pose");
  }
  if (!all_finite(numbers.data(), numbers.size())) return std::nullopt;
  if (std::all_of(numbers.begin(), numbers.begin() + 12, [](double x) { return x == 0.0; })) return std::nullopt;
  const bool by_columns = is_by_columns(numbers);
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
  if (by_columns) matrix = Eigen::Map<const Eigen::Matrix4d>(numbers.data()).topRows<3>();
  if (numbers.size() == 16 && !by_columns) {
    const Eigen::Vector4d last_row(numbers[12], numbers[13], numbers[14], numbers[15]);
    if ((last_row - Eigen::Vector4d(0.0, 0.0, 0.0, 1.0)).cwiseAbs().maxCoeff() > 1e-6) {
      throw_file_error(file, "a last row of " + numbers_text(&numbers[12], 4), "0 0 0 1");
    }
  }
  check_rotation(matrix.leftCols<3>(), file);
  if (matrix.col(3).cwiseAbs().maxCoeff() > kMaxDistance_m) {
    throw_file_error(file, "a translation of " + numbers_text(matrix.col(3).data(), 3), "at most 1e8 m");
  }
  return RecordedPose{matrix.leftCols<3>(), matrix.col(3)};
}

std::optional<RecordedPose> parse_pose(std::string_view text, const std::filesystem::path& file) {
  const std::vector<double> numbers = parse_lenient_numbers(text, file);
  return numbers.empty() ? std::nullopt : pose_from_matrix(numbers, file);
}

std::optional<RecordedPose> pose_from_quaternion(const std::array<double, 7>& numbers, const std::filesystem::path& file,
                                                 const std::string& where) {
  constexpr double kLengthTolerance = 1e-2;
  if (!all_finite(numbers.data(), numbers.size())) return std::nullopt;
  const Eigen::Quaterniond rotation(numbers[6], numbers[3], numbers[4], numbers[5]);
  if (rotation.norm() == 0.0) return std::nullopt;
  if (!(std::abs(rotation.norm() - 1.0) <= kLengthTolerance)) {
    throw_file_error(file, "a quaternion of length " + std::to_string(rotation.norm()) + " in " + where, "length 1");
  }
  const Eigen::Vector3d translation_m(numbers[0], numbers[1], numbers[2]);
  if (translation_m.cwiseAbs().maxCoeff() > kMaxDistance_m) throw_file_error(file, "a position beyond 1e8 m in " + where, "metres");
  return RecordedPose{rotation.normalized().toRotationMatrix(), translation_m};
}

SE3 to_se3(const RecordedPose& pose, const Eigen::Vector3d& origin_m) {
  return {nearest_rotation(pose.rotation.cast<float>()), (pose.translation_m - origin_m).cast<float>()};
}

bool PoseConvention::operator==(const PoseConvention& other) const {
  return w_first == other.w_first && inverse == other.inverse && mirror_y == other.mirror_y && axes == other.axes &&
         metres_per_unit == other.metres_per_unit;
}

std::string pose_convention_help() {
  std::string text;
  for (const Word& word : kWords) text += (text.empty() ? "" : ", ") + std::string(word.word) + " (" + word.meaning + ")";
  return text;
}

PoseConvention parse_pose_convention(const std::string& text) {
  PoseConvention convention;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const auto known = std::find_if(kWords.begin(), kWords.end(), [&](const Word& word) { return part == word.word; });
    if (known == kWords.end()) throw InvalidSettings("pose convention: got " + in_quotes(part) + ", expected " + pose_convention_help());
    known->set(convention);
  }
  return convention;
}

std::string to_string(const PoseConvention& convention) {
  std::string text;
  const auto add = [&](bool is_set, const char* word) {
    if (is_set) text += (text.empty() ? "" : ",") + std::string(word);
  };
  add(convention.w_first, "w-first");
  add(convention.inverse, "inverse");
  add(convention.mirror_y, "mirror-y");
  add(convention.axes == PoseConvention::Axes::kOpenGl, "opengl");
  add(convention.axes == PoseConvention::Axes::kRos, "ros");
  add(convention.metres_per_unit == 1e-3, "mm");
  add(convention.metres_per_unit == 1e-2, "cm");
  return text.empty() ? "as-is" : text;
}

RecordedPose apply(const PoseConvention& convention, const RecordedPose& pose) {
  RecordedPose result = pose;
  if (convention.w_first) result.rotation = reread_w_first(pose.rotation);
  result.translation_m *= convention.metres_per_unit;
  if (convention.inverse) {
    const Eigen::Matrix3d inverse = Eigen::Quaterniond(result.rotation).normalized().conjugate().toRotationMatrix();
    result = {inverse, -(inverse * result.translation_m)};
  }
  if (convention.mirror_y) {
    const Eigen::Vector3d mirror(1.0, -1.0, 1.0);
    result = {mirror.asDiagonal() * result.rotation * mirror.asDiagonal(), mirror.asDiagonal() * result.translation_m};
  }
  if (convention.axes != PoseConvention::Axes::kVision) result.rotation = result.rotation * theirs_from_ours(convention.axes);
  return result;
}

}  // namespace foothold::io
