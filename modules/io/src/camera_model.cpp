// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "camera_model.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "keyed_numbers.h"
#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

Intrinsics checked_intrinsics(double fx, double fy, double cx, double cy, const fs::path& file) {
  constexpr double kMax_px = 1e6;
  for (const double focal : {fx, fy}) {
    if (!(focal >= 1.0 && focal <= kMax_px)) throw_file_error(file, "a focal length of " + numbers_text(&focal, 1) + " pixels", "1 to 1e6");
  }
  for (const double centre : {cx, cy}) {
    if (!(std::abs(centre) <= kMax_px)) {
      throw_file_error(file, "a principal point at " + numbers_text(&centre, 1) + " pixels", "at most 1e6");
    }
  }
  return {static_cast<float>(fx), static_cast<float>(fy), static_cast<float>(cx), static_cast<float>(cy)};
}

/// Intrinsics of the upper left 3x3 part of a matrix with rows of `columns` numbers.
Intrinsics intrinsics_of_matrix(const std::vector<double>& k, std::size_t columns, const fs::path& file) {
  const std::array<double, 9> m{
      k[0], k[1], k[2], k[columns], k[columns + 1], k[columns + 2], k[2 * columns], k[2 * columns + 1], k[2 * columns + 2]};
  const Intrinsics intrinsics = checked_intrinsics(m[0], m[4], m[2], m[5], file);
  if (m[1] != 0.0 || m[3] != 0.0 || m[6] != 0.0 || m[7] != 0.0 || m[8] != 1.0) {
    throw_file_error(file, "the matrix " + numbers_text(m.data(), m.size()), "fx 0 cx  0 fy cy  0 0 1");
  }
  return intrinsics;
}

/// Fills in coefficients as OpenCV orders them.
Distortion brown_conrady(const double* coefficients, std::size_t count, const fs::path& file) {
  constexpr double kMax = 1e4;
  const bool sane = std::all_of(coefficients, coefficients + count, [](double x) { return std::abs(x) <= kMax; });
  if (!sane) throw_file_error(file, "distortion of " + numbers_text(coefficients, count), "coefficients of at most 1e4");
  Distortion distortion;
  std::copy_n(coefficients, std::min(count, distortion.coefficients.size()), distortion.coefficients.begin());
  return distortion;
}

/// fx fy cx cy with width and height before or behind: those between which the principal point is nearer to the middle.
CameraModel camera_with_size(const std::vector<double>& n, const fs::path& file) {
  const auto off_centre = [](double c, double side) { return side < 1.0 || side > 1e5 ? 1e9 : std::abs(c / side - 0.5); };
  const bool behind = off_centre(n[2], n[4]) + off_centre(n[3], n[5]) <= off_centre(n[4], n[0]) + off_centre(n[5], n[1]);
  const std::size_t k = behind ? 0 : 2;
  const std::size_t size = behind ? 4 : 0;
  if (!(n[size] >= 1.0 && n[size] <= 1e5 && n[size + 1] >= 1.0 && n[size + 1] <= 1e5)) {
    throw_file_error(file, "the numbers " + numbers_text(n.data(), n.size()), "fx fy cx cy width height");
  }
  return {checked_intrinsics(n[k], n[k + 1], n[k + 2], n[k + 3], file), {}, {static_cast<int>(n[size]), static_cast<int>(n[size + 1])}};
}

/// The camera that a row or matrix of numbers means. @throws FileError
CameraModel camera_of_numbers(const std::vector<double>& n, const fs::path& file) {
  const auto ends_as_matrix = [&](std::size_t columns) {
    return n[2 * columns] == 0.0 && n[2 * columns + 1] == 0.0 && n[2 * columns + 2] == 1.0;
  };
  if (n.size() == 16) return {intrinsics_of_matrix(n, 4, file), {}, {}};
  if (n.size() == 9 && ends_as_matrix(3)) return {intrinsics_of_matrix(n, 3, file), {}, {}};
  if (n.size() == 12 && ends_as_matrix(4)) return {intrinsics_of_matrix(n, 4, file), {}, {}};
  if (n.size() == 6) return camera_with_size(n, file);
  if (n.size() == 4 || n.size() == 8 || n.size() == 9 || n.size() == 12) {
    return {checked_intrinsics(n[0], n[1], n[2], n[3], file), brown_conrady(n.data() + 4, n.size() - 4, file), {}};
  }
  throw_file_error(file, std::to_string(n.size()) + " numbers",
                   "a camera: a 3x3 or 4x4 matrix, or fx fy cx cy with 0, 4, 5 or 8 coefficients of distortion behind");
}

using Keys = std::vector<KeyedNumbers>;

/// What a file of both cameras tells of one of them.
Keys part_of(const Keys& all, CameraKind kind) {
  return kind == CameraKind::kDepth ? section(all, {"depth"}, {"color", "colour", "rgb"})
                                    : section(all, {"color", "colour", "rgb"}, {"depth"});
}

/// A scalar of a keyed file; `missing` if it is not there.
double scalar(const Keys& all, std::initializer_list<std::string_view> keys, double missing = 0.0) {
  const std::vector<double> found = find_numbers(all, keys, 1);
  return found.empty() ? missing : found.front();
}

Intrinsics keyed_intrinsics(const Keys& all, CameraKind kind, const fs::path& file) {
  const std::string_view own = kind == CameraKind::kDepth ? "mcalibrationdepthintrinsic" : "mcalibrationcolorintrinsic";
  const auto matrix = [&](std::size_t count) {
    return find_numbers(all, {own, "intrinsicmatrix", "cameramatrix", "k", "intrinsics", "intrinsic", "kmatrix", "matrix"}, count);
  };
  std::vector<double> numbers = matrix(9);
  if (!numbers.empty()) {
    const bool by_columns = numbers[2] == 0.0 && numbers[5] == 0.0 && (numbers[6] != 0.0 || numbers[7] != 0.0);  // Open3D
    if (by_columns) numbers = {numbers[0], numbers[3], numbers[6], numbers[1], numbers[4], numbers[7], numbers[2], numbers[5], numbers[8]};
    return intrinsics_of_matrix(numbers, 3, file);
  }
  for (const std::size_t count : {std::size_t{16}, std::size_t{4}}) {
    numbers = matrix(count);
    if (!numbers.empty()) return camera_of_numbers(numbers, file).intrinsics;
  }
  const double fx = scalar(all, {"fx", "focalx", "focallengthx"});
  const double cx = scalar(all, {"cx", "ppx", "centerx", "principalpointx"}, -1e9);
  const double cy = scalar(all, {"cy", "ppy", "centery", "principalpointy"}, -1e9);
  if (fx == 0.0 || cx == -1e9 || cy == -1e9) throw_file_error(file, "no intrinsics among its names", "fx, fy, cx and cy, or a 3x3 matrix");
  return checked_intrinsics(fx, scalar(all, {"fy", "focaly", "focallengthy"}, fx), cx, cy, file);
}

bool mentions(std::string_view text, std::initializer_list<std::string_view> words) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

Distortion keyed_distortion(const Keys& all, std::string_view text, const fs::path& file) {
  const bool is_fisheye = mentions(text, {"equidistant", "fisheye", "kannala"});
  std::vector<double> c = {scalar(all, {"k1"}), scalar(all, {"k2"}), scalar(all, {"p1"}), scalar(all, {"p2"}),
                           scalar(all, {"k3"}), scalar(all, {"k4"}), scalar(all, {"k5"}), scalar(all, {"k6"})};
  if (is_fisheye) c = {c[0], c[1], c[4], c[5]};
  for (const std::size_t count : {std::size_t{4}, std::size_t{5}, std::size_t{8}}) {
    const auto listed = find_numbers(all, {"distortioncoefficients", "distortioncoeffs", "distcoeffs", "distortion", "coeffs", "d"}, count);
    if (!listed.empty()) c = listed;
  }
  Distortion distortion = brown_conrady(c.data(), c.size(), file);
  if (is_fisheye) distortion.model = Distortion::Model::kKannalaBrandt;
  if (distortion.any() && mentions(text, {"inverse_brown", "inverse brown"})) {
    throw_file_error(file, "coefficients of the inverse Brown-Conrady model", "Brown-Conrady or Kannala-Brandt");
  }
  return distortion;
}

ImageSize keyed_size(const Keys& all, CameraKind kind) {
  const bool depth = kind == CameraKind::kDepth;
  const double width = scalar(all, {depth ? "mdepthwidth" : "mcolorwidth", "width", "imagewidth", "w"});
  const double height = scalar(all, {depth ? "mdepthheight" : "mcolorheight", "height", "imageheight", "h"});
  std::vector<double> size = find_numbers(all, {"resolution", "imagesize", "size"}, 2);
  if (size.empty()) size = {width, height};
  const bool sane = std::all_of(size.begin(), size.end(), [](double side) { return side >= 1.0 && side <= 1e5; });
  return sane ? ImageSize{static_cast<int>(size[0]), static_cast<int>(size[1])} : ImageSize{};
}

/// Numbers near 1 mean something else.
std::optional<double> keyed_depth_scale(const Keys& all) {
  constexpr double kLeast = 100.0;
  const double value = scalar(all, {"depthscale", "depthmapfactor", "pngdepthscale", "mdepthshift", "depthfactor", "scale"});
  const double units_per_m = depth_units_per_m(value);
  if (!(units_per_m >= kLeast && units_per_m <= 1e6)) return std::nullopt;
  return units_per_m;
}

}  // namespace

bool Distortion::any() const {
  return std::any_of(coefficients.begin(), coefficients.end(), [](double k) { return k != 0.0; });
}

CameraFile parse_camera(std::string_view text, const fs::path& file, CameraKind kind) {
  if (!has_keys(text)) {
    std::vector<double> numbers;
    const std::string bare = bare_numbers(text);
    for (const std::string_view word : split_words(bare)) {
      numbers.push_back(parse_number(word, file, "entry " + std::to_string(numbers.size() + 1) + " of a camera"));
    }
    return {camera_of_numbers(numbers, file), std::nullopt, false};
  }
  const Keys all = parse_keyed_numbers(text);
  const Keys own = part_of(all, kind);
  const bool has_both = own.size() < all.size() || !find_numbers(all, {"mcalibrationcolorintrinsic"}, 16).empty();
  return {{keyed_intrinsics(own, kind, file), keyed_distortion(own, text, file), keyed_size(own, kind)}, keyed_depth_scale(all), has_both};
}

CameraModel resized(const CameraModel& camera, const ImageSize& size) {
  CameraModel result = camera;
  const float x = static_cast<float>(size.width) / static_cast<float>(camera.size.width);
  const float y = static_cast<float>(size.height) / static_cast<float>(camera.size.height);
  const Intrinsics& k = camera.intrinsics;
  result.intrinsics = {k.fx * x, k.fy * y, (k.cx + 0.5F) * x - 0.5F, (k.cy + 0.5F) * y - 0.5F};
  result.size = size;
  return result;
}

std::string describe_impossible(const Intrinsics& k, const ImageSize& size) {
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  std::ostringstream text;
  if (k.cx < 0.0F || k.cy < 0.0F || k.cx > width - 1.0F || k.cy > height - 1.0F) {
    text << "a principal point at " << k.cx << " " << k.cy;
  } else {
    constexpr float kMaxRatio = 3.0F;  // fields of view of 19 to 113 degrees along the longer side
    const float side = std::max(width, height);
    const bool possible =
        std::min(k.fx, k.fy) >= side / kMaxRatio && std::max(k.fx, k.fy) <= side * kMaxRatio && k.fx / k.fy < 2.0F && k.fy / k.fx < 2.0F;
    if (!possible) text << "focal lengths of " << k.fx << " " << k.fy;
  }
  return text.str();
}

std::string to_string(const Intrinsics& k) {
  std::ostringstream text;
  text << k.fx << " " << k.fy << " " << k.cx << " " << k.cy;
  return text.str();
}

std::string to_string(const Distortion& distortion) {
  if (!distortion.any()) return "none";
  const bool fisheye = distortion.model == Distortion::Model::kKannalaBrandt;
  std::size_t count = distortion.coefficients.size();
  while (count > 4 && distortion.coefficients[count - 1] == 0.0) --count;
  return (fisheye ? "Kannala-Brandt " : "Brown-Conrady ") + numbers_text(distortion.coefficients.data(), count);
}

}  // namespace foothold::io
