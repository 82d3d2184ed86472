// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trajectory_map.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace foothold::benchmark {

std::vector<cv::Point2d> seen_from_above(const std::vector<TestRecord>& tests) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const TestRecord& test : tests) {
    up -= test.world_from_camera_true.rotation.col(1).cast<double>();  // camera y points down
    mean += test.world_from_camera_true.translation.cast<double>() / static_cast<double>(tests.size());
  }
  up = up.norm() > 1e-6 ? up.normalized() : Eigen::Vector3d(Eigen::Vector3d::UnitZ());

  const Eigen::Matrix3d onto_plane = Eigen::Matrix3d::Identity() - up * up.transpose();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const TestRecord& test : tests) {
    const Eigen::Vector3d offset = onto_plane * (test.world_from_camera_true.translation.cast<double>() - mean);
    spread += offset * offset.transpose();
  }
  const Eigen::Vector3d along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  const Eigen::Vector3d across = along.cross(up);
  std::vector<cv::Point2d> points;
  for (const TestRecord& test : tests) {
    const Eigen::Vector3d offset = test.world_from_camera_true.translation.cast<double>() - mean;
    points.push_back({along.dot(offset), across.dot(offset)});
  }
  return points;
}

}  // namespace foothold::benchmark
