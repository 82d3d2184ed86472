// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Cameras as calibration files describe them: intrinsics, lens distortion, image size.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "foothold/base/camera.h"
#include "image_header.h"

namespace foothold::io {

/// How a lens bends what a pinhole would see, in OpenCV's terms.
struct Distortion {
  enum class Model {
    kBrownConrady,   ///< k1 k2 p1 p2 k3 k4 k5 k6. Reference: [Brown1966], with OpenCV's rational terms
    kKannalaBrandt,  ///< k1 k2 k3 k4, of fisheye lenses. Reference: [Kannala2006]
  };
  Model model = Model::kBrownConrady;
  std::array<double, 8> coefficients{};

  /// True if there is anything to correct.
  bool any() const;
};

struct CameraModel {
  Intrinsics intrinsics;
  Distortion distortion;
  ImageSize size;  ///< of the images it was calibrated with; empty where the file does not tell
};

enum class CameraKind { kDepth, kColour };

struct CameraFile {
  CameraModel camera;
  std::optional<double> depth_units_per_m;  ///< where the file tells
  bool has_both = false;                    ///< it tells of a depth and of a colour camera, by their names
};

/// Depth units per metre, of what may be metres per unit: no depth camera counts longer units than metres.
inline double depth_units_per_m(double value) { return value > 0.0 && value < 1.0 ? 1.0 / value : value; }

/// Parses intrinsics as people write them down: a 3x3, 3x4 or 4x4 matrix; fx fy cx cy, alone, with 4, 5 or 8 coefficients of distortion
/// behind, or with width and height; or keys with numbers as in Open3D's and NICE-SLAM's JSON, OpenCV's and ROS's YAML, and BundleFusion's
/// info.txt. @param kind  whose numbers to take, where the file has both cameras', under names with "depth" and "color" or "rgb".
/// @throws FileError
CameraFile parse_camera(std::string_view text, const std::filesystem::path& file, CameraKind kind = CameraKind::kDepth);

/// The same camera with images of another size. @pre The camera's size is not empty.
CameraModel resized(const CameraModel& camera, const ImageSize& size);

/// Why a camera cannot have taken images of a size, such as "a principal point at 647 484"; empty if it can.
std::string describe_impossible(const Intrinsics& intrinsics, const ImageSize& size);

/// Such as "585 585 320 240".
std::string to_string(const Intrinsics& intrinsics);
/// Such as "Brown-Conrady 0.2624 -0.9531 -0.0054 0.0026 1.1633"; "none" without any.
std::string to_string(const Distortion& distortion);

}  // namespace foothold::io
