// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/trajectory_error.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/trace.h"

namespace foothold {
namespace {

/// x -> R x + t in double precision.
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

std::vector<Eigen::Vector3d> positions_of(Span<const SE3> poses) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(poses.size());
  for (const SE3& pose : poses) positions.push_back(pose.translation.cast<double>());
  return positions;
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// The rigid transform of least squares from one set of points to another. Reference: [Umeyama1991] Eqs. 40-42 with scale 1.
RigidTransform align_points(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  const Eigen::Vector3d from_mean = mean_of(from);
  const Eigen::Vector3d to_mean = mean_of(to);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) covariance += (to[i] - to_mean) * (from[i] - from_mean).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handedness = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  RigidTransform transform;
  transform.rotation = svd.matrixU() * Eigen::Vector3d(1.0, 1.0, handedness).asDiagonal() * svd.matrixV().transpose();
  transform.translation = to_mean - transform.rotation * from_mean;
  return transform;
}

}  // namespace

AbsoluteTrajectoryError absolute_trajectory_error(Span<const SE3> estimated, Span<const SE3> truth, TrajectoryAlignment alignment) {
  FOOTHOLD_EXPECTS(estimated.size() == truth.size() && !truth.empty());
  const std::vector<Eigen::Vector3d> estimated_positions = positions_of(estimated);
  const std::vector<Eigen::Vector3d> true_positions = positions_of(truth);
  RigidTransform align;
  if (alignment == TrajectoryAlignment::kRigid) align = align_points(estimated_positions, true_positions);

  std::vector<double> distances_m;
  AbsoluteTrajectoryError error;
  for (std::size_t i = 0; i < true_positions.size(); ++i) {
    const double distance_m = (align.rotation * estimated_positions[i] + align.translation - true_positions[i]).norm();
    distances_m.push_back(distance_m);
    error.mean_m += distance_m;
    error.rmse_m += distance_m * distance_m;
    error.max_m = std::max(error.max_m, distance_m);
  }
  error.mean_m /= static_cast<double>(distances_m.size());
  error.rmse_m = std::sqrt(error.rmse_m / static_cast<double>(distances_m.size()));
  error.median_m = quantile(distances_m, 0.5);
  error.truth_from_estimate = {align.rotation.cast<float>(), align.translation.cast<float>()};
  return error;
}

RelativePoseError relative_pose_error(Span<const SE3> estimated, Span<const SE3> truth, int delta) {
  FOOTHOLD_EXPECTS(estimated.size() == truth.size() && delta > 0);
  RelativePoseError error;
  for (std::size_t first = 0; first + static_cast<std::size_t>(delta) < truth.size(); ++first) {
    const std::size_t last = first + static_cast<std::size_t>(delta);
    const SE3 estimated_motion = estimated[first].inverse() * estimated[last];
    const SE3 true_motion = truth[first].inverse() * truth[last];
    error.translation_rmse_m += std::pow(translation_distance_m(true_motion.inverse() * estimated_motion, SE3{}), 2.0);
    error.rotation_rmse_rad += std::pow(rotation_distance_rad(estimated_motion, true_motion), 2.0);
    ++error.num_pairs;
  }
  const double num_terms = std::max(1, error.num_pairs);
  error.translation_rmse_m = std::sqrt(error.translation_rmse_m / num_terms);
  error.rotation_rmse_rad = std::sqrt(error.rotation_rmse_rad / num_terms);
  return error;
}

}  // namespace foothold
