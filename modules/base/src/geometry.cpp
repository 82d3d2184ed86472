// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/angle.h"
#include "foothold/base/se3.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>

#include "foothold/base/camera.h"
#include "foothold/base/settings.h"

namespace foothold {

Tangent6 se3_log(const SE3& transform) {
  const Eigen::AngleAxisd angle_axis(transform.rotation.cast<double>());
  const double theta = angle_axis.angle();
  const Eigen::Vector3d omega = theta * angle_axis.axis();
  // V^-1 = I - w/2 + c w^2 with c = (1 - (theta/2) cot(theta/2)) / theta^2, whose limit is 1/12.
  const double c = theta < 1e-6 ? 1.0 / 12.0 : (1.0 - 0.5 * theta / std::tan(0.5 * theta)) / (theta * theta);
  Eigen::Matrix3d w;
  w << 0.0, -omega.z(), omega.y(), omega.z(), 0.0, -omega.x(), -omega.y(), omega.x(), 0.0;
  const Eigen::Vector3d t = transform.translation.cast<double>();
  const Eigen::Vector3d v = t - 0.5 * (w * t) + c * (w * (w * t));
  Tangent6 tangent;
  tangent << omega.cast<float>(), v.cast<float>();
  return tangent;
}

Eigen::Matrix3f nearest_rotation(const Eigen::Matrix3f& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix.cast<double>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  return (u * svd.matrixV().transpose()).cast<float>();
}

bool is_rigid(const SE3& transform, float tolerance) {
  if (!transform.rotation.allFinite() || !transform.translation.allFinite()) return false;
  const Eigen::Matrix3f error = transform.rotation.transpose() * transform.rotation - Eigen::Matrix3f::Identity();
  return error.cwiseAbs().maxCoeff() <= tolerance && transform.rotation.determinant() > 0.0F;
}

std::string describe_pose_error(const SE3& pose, const std::string& name) {
  if (is_rigid(pose)) return {};
  if (!pose.rotation.allFinite()) return name + "'s rotation is not finite";
  if (!pose.translation.allFinite()) return name + "'s translation is not finite";
  const float determinant = pose.rotation.determinant();
  if (determinant < 0.0F) return name + "'s rotation mirrors: its determinant is " + detail::to_text(determinant) + ", expected 1";
  const Eigen::Vector3f scales = pose.rotation.colwise().norm();
  if ((scales.array() - 1.0F).abs().maxCoeff() > 0.5F * kRigidTolerance) {
    return name + "'s rotation scales: its columns have lengths " + detail::to_text(scales.x()) + ", " + detail::to_text(scales.y()) +
           " and " + detail::to_text(scales.z()) + ", expected 1";
  }
  return name + "'s rotation shears: its columns are not at right angles to each other";
}

float rotation_distance_rad(const SE3& a, const SE3& b) {
  // ||Ra - Rb||_F = 2 sqrt(2) sin(theta / 2)
  const double norm = (a.rotation.cast<double>() - b.rotation.cast<double>()).norm();
  return static_cast<float>(2.0 * std::asin(std::min(1.0, norm / (2.0 * std::sqrt(2.0)))));
}

float translation_distance_m(const SE3& a, const SE3& b) { return (a.translation - b.translation).norm(); }

bool is_near(const SE3& a, const SE3& b, float distance_m, float angle_deg) {
  return translation_distance_m(a, b) < distance_m && rotation_distance_rad(a, b) * static_cast<float>(kDegPerRad) < angle_deg;
}

bool is_valid(const Intrinsics& k) {
  return std::isfinite(k.fx) && std::isfinite(k.fy) && std::isfinite(k.cx) && std::isfinite(k.cy) && k.fx > 0.0F && k.fy > 0.0F;
}

}  // namespace foothold
