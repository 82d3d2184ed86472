// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Poses as files have them: in double precision, for recordings may lie far from their origin, and in conventions of their own.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "foothold/base/se3.h"

namespace foothold::io {

struct RecordedPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< orthonormal to within kRotationTolerance
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
};

/// True for exactly the identity, as loggers write it that know no pose.
inline bool is_identity(const RecordedPose& pose) { return pose.rotation.isIdentity(0.0) && pose.translation_m.isZero(0.0); }

/// By how much an entry of R^T R may differ from the identity before a matrix no longer counts as a rotation. The rotations of 7-Scenes
/// are orthonormal to 1e-4.
inline constexpr double kRotationTolerance = 1e-2;
/// Positions further than this from the origin are no positions of cameras on Earth.
inline constexpr double kMaxDistance_m = 1e8;

/// Makes a pose of 16 numbers, a 4x4 matrix row by row, or of the 12 of its first three rows. A 4x4 matrix whose last row holds the
/// translation was written column by column, and is read so.
/// @return Empty where tracking was lost, as recorders mark it: by a number that is not finite, or by zeros alone.
/// @throws FileError unless it is a rotation to within kRotationTolerance, a position within kMaxDistance_m, and a last row of 0 0 0 1.
std::optional<RecordedPose> pose_from_matrix(const std::vector<double>& numbers, const std::filesystem::path& file);

/// Parses a pose file: pose_from_matrix() of its numbers; an empty file marks lost tracking, too.
std::optional<RecordedPose> parse_pose(std::string_view text, const std::filesystem::path& file);

/// Makes a pose of a position and a quaternion (x, y, z, w).
/// @return Empty where tracking was lost: a number is not finite, or the quaternion is zero.
/// @throws FileError unless the quaternion's length is 1 to within 1e-2. @param where  such as "line 3", for messages.
std::optional<RecordedPose> pose_from_quaternion(const std::array<double, 7>& numbers, const std::filesystem::path& file,
                                                 const std::string& where);

/// A pose relative to an origin, in single precision, its rotation exactly orthonormal.
SE3 to_se3(const RecordedPose& pose, const Eigen::Vector3d& origin_m);

/// How the poses of a recording are to be understood.
struct PoseConvention {
  bool w_first = false;   ///< quaternions are w x y z where x y z w is expected
  bool inverse = false;   ///< camera_from_world
  bool mirror_y = false;  ///< world and camera have y the other way round
  enum class Axes { kVision, kOpenGl, kRos } axes = Axes::kVision;
  double metres_per_unit = 1.0;  ///< of positions

  bool operator==(const PoseConvention& other) const;
  bool operator!=(const PoseConvention& other) const { return !(*this == other); }
};

/// The words that parse_pose_convention() knows, with what they mean, for --help and messages.
std::string pose_convention_help();
/// Parses words separated by commas, such as "inverse,opengl"; empty or "as-is" for Foothold's own. @throws InvalidSettings
PoseConvention parse_pose_convention(const std::string& text);
/// The words that give a convention; "as-is" for Foothold's own.
std::string to_string(const PoseConvention& convention);

/// The pose world_from_camera in Foothold's convention.
RecordedPose apply(const PoseConvention& convention, const RecordedPose& pose);

}  // namespace foothold::io
