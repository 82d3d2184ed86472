// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "calibration_file.h"

#include <cmath>

#include "camera_search.h"
#include "foothold/io/calibration.h"
#include "recorded_pose.h"
#include "text_file.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

constexpr Intrinsics kSevenScenesDepth{585.0F, 585.0F, 320.0F, 240.0F};
constexpr Intrinsics kSevenScenesColour{525.0F, 525.0F, 320.0F, 240.0F};
constexpr ImageSize kVga{640, 480};
constexpr const char* kGiven = "as given";  // the source of intrinsics that are no file's

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

/// A camera with the name of where it was found.
struct NamedCamera {
  CameraModel camera;
  std::string source;
  std::optional<double> depth_units_per_m;
};

/// What the user gave: numbers, or the name of a file.
NamedCamera given_camera(const std::string& text) {
  const bool is_file = text.find_first_not_of("0123456789.,+-eE ") != std::string::npos;
  if (is_file) {
    const CameraFile content = parse_camera(read_text(text, kMaxNumbersFileBytes), text);
    return {content.camera, text, content.depth_units_per_m};
  }
  try {
    return {parse_camera(plain_text(text), "intrinsics '" + text + "'").camera, kGiven, std::nullopt};
  } catch (const FileError& error) {
    throw InvalidSettings(error.what());
  }
}

NamedCamera data_set_camera(const fs::path& folder, const CalibrationHints& hints, const ImageSize& depth_size) {
  if (hints.data_set.has_value() && hints.data_set->size == depth_size) return {*hints.data_set, hints.data_set_name, std::nullopt};
  throw FileError(folder.string() + ": no intrinsics for its images of " + to_string(depth_size) +
                  (hints.data_set.has_value() ? " (" + hints.data_set_name + " has " + to_string(hints.data_set->size) + ")" : "") +
                  "; expected camera-intrinsics.txt in this folder or the one above, or intrinsics fx,fy,cx,cy of its depth camera "
                  "(--intrinsics)");
}

NamedCamera depth_camera(const fs::path& folder, const CalibrationHints& hints, const ImageSize& size, const SequenceOptions& options) {
  if (!options.intrinsics.empty()) return given_camera(options.intrinsics);
  if (hints.depth.has_value()) return {*hints.depth, hints.header, std::nullopt};
  if (const auto found = find_camera(folder, CameraKind::kDepth, false)) {
    return {found->content.camera, found->file.string(), found->content.depth_units_per_m};
  }
  return data_set_camera(folder, hints, size);
}

/// Makes a camera that of images of a size: enlarges or reduces it where its own size is known. @throws FileError if it cannot be theirs.
void fit(NamedCamera& named, const ImageSize& size) {
  CameraModel& camera = named.camera;
  if (!camera.size.empty() && camera.size != size) {
    if (!same_shape(camera.size, size)) {
      throw_file_error(named.source, "a camera of " + to_string(camera.size) + " pixels",
                       "one of " + to_string(size) + ", as the images have");
    }
    named.source += ", resized from " + to_string(camera.size);
    camera = resized(camera, size);
  }
  const std::string impossible = describe_impossible(camera.intrinsics, size);
  if (!impossible.empty()) {
    throw_file_error(named.source == kGiven ? "intrinsics that were given" : named.source, impossible,
                     "those of its images of " + to_string(size) + "; the right ones can be given as fx,fy,cx,cy (--intrinsics)");
  }
  camera.size = size;
}

/// Intrinsics found for depth may be those of a larger colour image, whose shape depth has: then depth was resized to it.
void fit_depth(NamedCamera& named, const ImageSize& depth_size, const ImageSize& colour_size) {
  CameraModel& camera = named.camera;
  const bool is_colours = camera.size.empty() && depth_size != colour_size && same_shape(depth_size, colour_size) &&
                          !describe_impossible(camera.intrinsics, depth_size).empty() &&
                          describe_impossible(camera.intrinsics, colour_size).empty();
  if (is_colours) camera.size = colour_size;
  fit(named, depth_size);
}

std::string describe_off_centre(const NamedCamera& named) {
  constexpr float kMaxShift = 0.2F;  // of a side
  const Intrinsics& k = named.camera.intrinsics;
  const auto width = static_cast<float>(named.camera.size.width);
  const auto height = static_cast<float>(named.camera.size.height);
  if (std::abs(k.cx / width - 0.5F) <= kMaxShift && std::abs(k.cy / height - 0.5F) <= kMaxShift) return {};
  return named.source + ": the principal point " + to_string(k).substr(to_string(k).find(' ', to_string(k).find(' ') + 1) + 1) +
         " is far from the middle of the images of " + to_string(named.camera.size) +
         "; are these the intrinsics of images of another size?";
}

struct ColourCamera {
  NamedCamera named;
  SE3 depth_from_colour;
  bool is_depths = false;  ///< taken from the depth camera
};

ColourCamera colour_camera(const fs::path& folder, const CalibrationHints& hints, const NamedCamera& depth, const ImageSize& size) {
  const fs::path transform_file = folder / "depth-from-colour.txt";
  const bool has_transform = fs::exists(transform_file);
  ColourCamera result;
  if (has_transform) {
    result.depth_from_colour = parse_transform(read_text(transform_file, kMaxNumbersFileBytes), transform_file);
  } else if (hints.depth_from_colour.has_value()) {
    result.depth_from_colour = *hints.depth_from_colour;
  }
  if (hints.colour.has_value()) {
    result.named = {*hints.colour, hints.header, std::nullopt};
  } else if (const auto found = find_camera(folder, CameraKind::kColour, true)) {
    result.named = {found->content.camera, found->file.string(), std::nullopt};
  } else if (hints.may_be_seven_scenes && !has_transform && depth.camera.size == kVga && same(depth.camera.intrinsics, kSevenScenesDepth)) {
    return {{{kSevenScenesColour, {}, kVga}, "7-Scenes' own", std::nullopt}, seven_scenes_depth_from_colour(), false};
  } else {
    if (!same_shape(size, depth.camera.size)) {
      throw FileError(folder.string() + ": colour of " + to_string(size) + " and depth of " + to_string(depth.camera.size) +
                      " pixels, but no intrinsics of the colour camera; expected colour-intrinsics.txt");
    }
    result.named = {resized(depth.camera, size), depth.source, std::nullopt};
    result.is_depths = true;
  }
  fit(result.named, size);
  return result;
}

}  // namespace

SE3 parse_transform(std::string_view text, const fs::path& file) {
  constexpr double kMax_m = 1e6;  // beyond, single precision no longer resolves a decimetre
  const std::optional<RecordedPose> transform = pose_from_matrix(parse_numbers(text, 16, file, "4x4 pose"), file);
  if (!transform.has_value()) throw_file_error(file, "zeros", "a 4x4 pose");
  const Eigen::Vector3d& translation = transform->translation_m;
  if (translation.cwiseAbs().maxCoeff() > kMax_m) {
    throw_file_error(file, "a translation of " + numbers_text(translation.data(), 3), "at most 1e6 m");
  }
  return to_se3(*transform, Eigen::Vector3d::Zero());
}

RecordingCalibration find_calibration(const fs::path& folder, const CalibrationHints& hints, const ImageSize& depth_size,
                                      const ImageSize& colour_size, const SequenceOptions& options) {
  NamedCamera depth = depth_camera(folder, hints, depth_size, options);
  fit_depth(depth, depth_size, colour_size);
  const ColourCamera colour = colour_camera(folder, hints, depth, colour_size);
  const std::string source = depth.source + (colour.is_depths ? "" : "; colour: " + colour.named.source);
  return {depth.camera, colour.named.camera, colour.depth_from_colour, source, depth.depth_units_per_m, describe_off_centre(depth)};
}

}  // namespace foothold::io

namespace foothold {

RgbdCalibration read_calibration(const std::string& folder) {
  using namespace io;
  const std::filesystem::path place = folder;
  const std::filesystem::path depth_file = place / "camera-intrinsics.txt";
  if (!std::filesystem::exists(depth_file)) throw FileError(depth_file.string() + ": missing; expected the 3x3 matrix of the depth camera");
  const auto read = [](const std::filesystem::path& file) {
    return parse_camera(read_text(file, kMaxNumbersFileBytes), file).camera.intrinsics;
  };
  RgbdCalibration calibration;
  calibration.depth = read(depth_file);
  const bool has_colour = std::filesystem::exists(place / "colour-intrinsics.txt");
  const bool has_transform = std::filesystem::exists(place / "depth-from-colour.txt");
  if (!has_colour && !has_transform && same(calibration.depth, kSevenScenesDepth)) {
    return {calibration.depth, kSevenScenesColour, seven_scenes_depth_from_colour()};
  }
  calibration.colour = has_colour ? read(place / "colour-intrinsics.txt") : calibration.depth;
  if (has_transform) {
    calibration.depth_from_colour =
        parse_transform(read_text(place / "depth-from-colour.txt", kMaxNumbersFileBytes), place / "depth-from-colour.txt");
  }
  return calibration;
}

}  // namespace foothold
