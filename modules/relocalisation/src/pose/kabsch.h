// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The rigid transform through three point pairs. Reference: [Kabsch1976]; [Cavallari2017] Sec. 2.2.3.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "foothold/base/se3.h"

namespace foothold {

FOOTHOLD_HD inline Eigen::Vector3f cross_product(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// A right-handed frame on a triangle: first axis along an edge, third along the normal.
struct TriangleFrame {
  Eigen::Matrix3f axes;  ///< columns
  bool valid = false;    ///< false if the corners are nearly on a line

  FOOTHOLD_HD explicit TriangleFrame(const Eigen::Vector3f* p) {
    constexpr float kSmallestHeightM = 0.02F;
    const Eigen::Vector3f edge = p[1] - p[0];
    const Eigen::Vector3f normal = cross_product(edge, p[2] - p[0]);
    const float length = edge.norm();
    const float twice_area = normal.norm();
    if (!(length > 0.0F) || !(twice_area > kSmallestHeightM * length)) return;
    axes.col(0) = edge / length;
    axes.col(2) = normal / twice_area;
    axes.col(1) = cross_product(axes.col(2), axes.col(0));
    valid = true;
  }
};

/// Fits target = R source + t to three pairs in the least-squares sense, in closed form.
///
/// The centred triangles lie in planes, so the cross-covariance has rank two: its third singular vectors are the triangles' normals, and
/// the rest is a rotation in the plane. This is Kabsch's solution whenever the triangles have the same orientation, as nearly congruent
/// ones do.
///
/// @return False if either triangle is degenerate; `target_from_source` is then unchanged.
FOOTHOLD_HD inline bool fit_rigid_to_triple(const Eigen::Vector3f* source, const Eigen::Vector3f* target, SE3& target_from_source) {
  const TriangleFrame source_frame(source);
  const TriangleFrame target_frame(target);
  if (!source_frame.valid || !target_frame.valid) return false;
  const Eigen::Vector3f source_mean = (source[0] + source[1] + source[2]) * (1.0F / 3.0F);
  const Eigen::Vector3f target_mean = (target[0] + target[1] + target[2]) * (1.0F / 3.0F);
  float cosine = 0.0F;
  float sine = 0.0F;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f s = source[i] - source_mean;
    const Eigen::Vector3f t = target[i] - target_mean;
    const float su = source_frame.axes.col(0).dot(s);
    const float sv = source_frame.axes.col(1).dot(s);
    const float tu = target_frame.axes.col(0).dot(t);
    const float tv = target_frame.axes.col(1).dot(t);
    cosine += su * tu + sv * tv;
    sine += su * tv - sv * tu;
  }
  const float norm = std::sqrt(cosine * cosine + sine * sine);
  if (!(norm > 0.0F)) return false;
  cosine /= norm;
  sine /= norm;
  Eigen::Matrix3f turned;  // the source frame rotated in its plane
  turned.col(0) = cosine * target_frame.axes.col(0) + sine * target_frame.axes.col(1);
  turned.col(1) = cosine * target_frame.axes.col(1) - sine * target_frame.axes.col(0);
  turned.col(2) = target_frame.axes.col(2);
  target_from_source.rotation = turned * source_frame.axes.transpose();
  target_from_source.translation = target_mean - target_from_source.rotation * source_mean;
  return true;
}

}  // namespace foothold
