// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "fusion/scene.h"

#include <algorithm>
#include <cmath>

namespace foothold::test {

double Scene::depth_m(const Intrinsics& intrinsics, const SE3& world_from_camera, int u, int v) const {
  const Eigen::Vector3d direction_camera((u - double{intrinsics.cx}) / double{intrinsics.fx},
                                         (v - double{intrinsics.cy}) / double{intrinsics.fy}, 1.0);
  const Eigen::Vector3d direction = world_from_camera.rotation.cast<double>() * direction_camera;  // unit length along the optical axis
  const Eigen::Vector3d origin = world_from_camera.translation.cast<double>();
  double nearest = 1e9;
  const Eigen::Vector3d to_centre = origin - sphere_centre_world;
  const double a = direction.squaredNorm();
  const double b = direction.dot(to_centre);
  const double discriminant = b * b - a * (to_centre.squaredNorm() - sphere_radius_m * sphere_radius_m);
  if (discriminant > 0.0) {
    const double z = (-b - std::sqrt(discriminant)) / a;
    if (z > 0.0) nearest = z;
  }
  for (int axis = 0; has_room && axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-12) continue;
    const double plane = direction[axis] > 0.0 ? half_size_m[axis] : -half_size_m[axis];
    nearest = std::min(nearest, (plane - origin[axis]) / direction[axis]);
  }
  return nearest < 1e8 ? nearest : 0.0;
}

double Scene::distance_m(const Eigen::Vector3d& point_world) const {
  double distance = std::abs((point_world - sphere_centre_world).norm() - sphere_radius_m);
  for (int axis = 0; has_room && axis < 3; ++axis) distance = std::min(distance, std::abs(half_size_m[axis] - std::abs(point_world[axis])));
  return distance;
}

Context make_context(int num_threads) {
  ContextOptions options;
  options.num_threads = num_threads;
  return Context(options);
}

RgbdFrame render(const Scene& scene, const SE3& world_from_camera, int width, int height) {
  RgbdFrame frame;
  const float focal = 0.5F * static_cast<float>(width);
  frame.calibration.depth = {focal, focal, 0.5F * static_cast<float>(width - 1), 0.5F * static_cast<float>(height - 1)};
  frame.calibration.colour = frame.calibration.depth;
  frame.depth = Image<float>(width, height);
  frame.colour = Image<Rgb8>(width, height);
  frame.world_from_camera = world_from_camera;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double z = scene.depth_m(frame.calibration.depth, world_from_camera, u, v);
      frame.depth(u, v) = static_cast<float>(z);
      const Eigen::Vector3f point =
          world_from_camera * frame.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), static_cast<float>(z));
      const auto channel = [](float x) { return static_cast<std::uint8_t>(std::clamp(128.0F + 60.0F * x, 1.0F, 255.0F)); };
      if (z > 0.0) frame.colour(u, v) = {channel(point.x()), channel(point.y()), channel(point.z())};
    }
  }
  return frame;
}

SE3 look_at(const Eigen::Vector3f& position, const Eigen::Vector3f& target) {
  const Eigen::Vector3f z = (target - position).normalized();
  const Eigen::Vector3f x = Eigen::Vector3f::UnitY().cross(z).normalized();  // y is down
  SE3 pose;
  pose.rotation.col(0) = x;
  pose.rotation.col(1) = z.cross(x);
  pose.rotation.col(2) = z;
  pose.translation = position;
  return pose;
}

SE3 pose_on_arc(float t) {
  const float angle = 0.5F * (t - 0.5F);
  return look_at({1.0F * std::sin(angle), -0.2F + 0.2F * t, -0.9F}, {0.1F, 0.2F, 0.8F});
}

TsdfVolume fused_arc(const Context& context, const Scene& scene, int num_frames, const TsdfSettings& settings) {
  TsdfVolume volume(context, settings);
  for (int i = 0; i < num_frames; ++i) {
    const SE3 pose = pose_on_arc(static_cast<float>(i) / static_cast<float>(std::max(1, num_frames - 1)));
    const RgbdFrame frame = render(scene, pose);
    volume.integrate(frame.view(), pose);
  }
  return volume;
}

RenderCamera camera_of(const RgbdFrame& frame) {
  return {frame.calibration.depth, frame.depth.width(), frame.depth.height(), *frame.world_from_camera};
}

}  // namespace foothold::test
