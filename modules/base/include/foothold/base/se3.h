// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Rigid transforms. Names read target_from_source, so that chains cancel: world_from_camera * camera_from_imu.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "foothold/base/platform.h"

namespace foothold {

/// A tangent vector of SE(3): rotation [rad] first, then translation [m].
using Tangent6 = Eigen::Matrix<float, 6, 1>;

/// A rigid transform x -> R x + t. Members are alignment-neutral: 48 bytes under every compiler.
struct SE3 {
  /// R, orthonormal with determinant 1
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();  ///< t [m]

  /// The transformed point, R x + t.
  FOOTHOLD_HD Eigen::Vector3f operator*(const Eigen::Vector3f& point) const { return rotation * point + translation; }
  /// The transform that applies `other` first.
  FOOTHOLD_HD SE3 operator*(const SE3& other) const { return {rotation * other.rotation, rotation * other.translation + translation}; }
  /// The transform that undoes this one.
  FOOTHOLD_HD SE3 inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};
static_assert(sizeof(SE3) == 48, "SE3 is passed to kernels by value");

/// The skew-symmetric matrix with skew(a) b = a x b.
FOOTHOLD_HD inline Eigen::Matrix3f skew(const Eigen::Vector3f& a) {
  Eigen::Matrix3f m;
  m << 0.0F, -a.z(), a.y(), a.z(), 0.0F, -a.x(), -a.y(), a.x(), 0.0F;
  return m;
}

/// The exponential map of SE(3): the transform reached by following a constant twist for unit time.
/// Reference: [Strasdat2012] Sec. 2.4.
FOOTHOLD_HD inline SE3 se3_exp(const Tangent6& tangent) {
  const Eigen::Vector3f omega = tangent.head<3>();
  const Eigen::Vector3f v = tangent.tail<3>();
  const float theta2 = omega.squaredNorm();
  float a = 1.0F - theta2 / 6.0F;           // sin(theta) / theta
  float b = 0.5F - theta2 / 24.0F;          // (1 - cos(theta)) / theta^2
  float c = 1.0F / 6.0F - theta2 / 120.0F;  // (1 - a) / theta^2
  if (theta2 > 1e-4F) {
    const float theta = std::sqrt(theta2);
    a = std::sin(theta) / theta;
    b = (1.0F - std::cos(theta)) / theta2;
    c = (1.0F - a) / theta2;
  }
  const Eigen::Matrix3f w = skew(omega);
  const Eigen::Matrix3f w2 = w * w;
  SE3 result;
  result.rotation = Eigen::Matrix3f::Identity() + a * w + b * w2;
  result.translation = v + b * (w * v) + c * (w2 * v);
  return result;
}

/// The logarithm of SE(3), inverse of se3_exp() for rotations below pi. Computed in double precision.
Tangent6 se3_log(const SE3& transform);

/// The rotation nearest to a matrix in the Frobenius norm, by SVD. @pre The matrix has positive determinant.
Eigen::Matrix3f nearest_rotation(const Eigen::Matrix3f& matrix);

/// What passes for a rotation wherever poses are given or read: files print few digits, and trackers multiply in single precision.
inline constexpr float kRigidTolerance = 1e-2F;

/// True if every entry is finite and rotation^T rotation differs from the identity by at most `tolerance` per entry, with positive
/// determinant.
bool is_rigid(const SE3& transform, float tolerance = kRigidTolerance);

/// What keeps a transform from being rigid, within kRigidTolerance: numbers that are not finite, a rotation that mirrors, scales or shears.
/// @param name  how the text calls it. @return Empty if it is rigid.
std::string describe_pose_error(const SE3& pose, const std::string& name = "the pose");

/// The angle between two orientations [rad], in [0, pi]; accurate for tiny angles, unlike acos of the trace.
float rotation_distance_rad(const SE3& a, const SE3& b);

/// The distance between two origins [m].
float translation_distance_m(const SE3& a, const SE3& b);

/// True if the origins are less than `distance_m` apart and the orientations less than `angle_deg`.
bool is_near(const SE3& a, const SE3& b, float distance_m, float angle_deg);

}  // namespace foothold
