// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "shading.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "texture.h"

namespace foothold::synthetic_detail {
namespace {

using Eigen::Vector3f;

/// A place on a surface: its normal in the primitive's frame and its coordinates on the face.
struct Surface {
  Vector3f normal_local;
  SurfacePoint point;
};

Surface box_surface(const Primitive& primitive, const Vector3f& p) {
  const Vector3f& h = primitive.half_size_m;
  int axis = 0;
  (p.cwiseAbs() - h).maxCoeff(&axis);
  const int u_axis = axis == 0 ? 1 : 0;
  const int v_axis = axis == 2 ? 1 : 2;
  Surface surface{Vector3f::Zero(), {p[u_axis], p[v_axis], h[u_axis], h[v_axis], primitive.seed + static_cast<std::uint32_t>(axis), 0.0F}};
  surface.normal_local[axis] = p[axis] < 0.0F ? -1.0F : 1.0F;
  return surface;
}

Surface cylinder_surface(const Primitive& primitive, const Vector3f& p) {
  const float r = primitive.half_size_m.x();
  const float h = primitive.half_size_m.z();
  if (std::fabs(p.z()) - h > p.head<2>().norm() - r)
    return {{0.0F, 0.0F, p.z() < 0.0F ? -1.0F : 1.0F}, {p.x(), p.y(), r, r, primitive.seed, 0.0F}};
  return {{p.x() / r, p.y() / r, 0.0F}, {std::atan2(p.y(), p.x()) * r, p.z(), 3.1415927F * r, h, primitive.seed, 0.0F}};
}

Surface surface_of(const Primitive& primitive, const Vector3f& p) {
  const Vector3f& h = primitive.half_size_m;
  switch (primitive.shape) {
    case Shape::kRectangle:
      return {{0.0F, 0.0F, 1.0F}, {p.x(), p.y(), h.x(), h.y(), primitive.seed, 0.0F}};
    case Shape::kBox:
      return box_surface(primitive, p);
    case Shape::kSphere:
      return {p / h.x(), {std::atan2(p.y(), p.x()) * h.x(), p.z(), 3.1415927F * h.x(), h.x(), primitive.seed, 0.0F}};
    case Shape::kCylinder:
      return cylinder_surface(primitive, p);
  }
  return {};
}

/// Light that reaches less into the corners of the room: one factor per pair of walls.
float corner_darkening(const Room& room, const Vector3f& point_world) {
  constexpr float kReach2 = 0.2F * 0.2F;  // [m^2]
  constexpr float kDepth = 0.3F;          // darkening in the very corner
  float light = 1.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float d = std::min(point_world[axis] - room.low_world[axis], room.high_world[axis] - point_world[axis]);
    light *= 1.0F - kDepth * kReach2 / (kReach2 + d * d);
  }
  return light / (1.0F - kDepth);  // a wall is near itself
}

std::uint8_t to_grey_level(float value) {
  // Linear up to 0.8, then bending towards white, as a camera's response does.
  const float bent = value < 0.8F ? value : 1.0F - 0.04F / (value - 0.6F);
  return static_cast<std::uint8_t>(std::clamp(bent, 0.0F, 1.0F) * 255.0F + 0.5F);
}

}  // namespace

Shade Shading::operator()(std::int32_t primitive_index, float x, float y, float t) const {
  const Primitive& primitive = room_.primitives[static_cast<std::size_t>(primitive_index)];
  const Vector3f ray_camera(x, y, 1.0F);
  const Vector3f ray_world = world_from_camera_.rotation * ray_camera;
  const Vector3f point_world = world_from_camera_.translation + ray_world * t;
  const SE3& pose = primitive.world_from_local;
  Surface surface = surface_of(primitive, pose.rotation.transpose() * (point_world - pose.translation));
  Vector3f normal = pose.rotation * surface.normal_local;
  const float ray_length = ray_camera.norm();
  const float cosine = normal.dot(ray_world) / ray_length;
  if (cosine > 0.0F) normal = -normal;

  if (primitive.material.texture == Texture::kWood && surface.point.half_v > surface.point.half_u) {
    std::swap(surface.point.u, surface.point.v);  // grain runs along the longer side
    std::swap(surface.point.half_u, surface.point.half_v);
  }
  surface.point.footprint_m = t * pixel_size_ / std::max(std::fabs(cosine), 0.1F);
  const Vector3f albedo = texture_colour(primitive.material, surface.point);

  Vector3f light = room_.ambient;
  for (const PointLight& lamp : room_.lights) {
    const Vector3f towards = lamp.position_world - point_world;
    const float distance2 = towards.squaredNorm();
    const float facing = normal.dot(towards);
    if (facing > 0.0F) light += lamp.intensity * (facing / (std::sqrt(distance2) * (0.5F + distance2)));
  }
  light *= corner_darkening(room_, point_world);
  const Vector3f colour = albedo.cwiseProduct(light);
  return {{to_grey_level(colour.x()), to_grey_level(colour.y()), to_grey_level(colour.z())}, std::fabs(cosine)};
}

}  // namespace foothold::synthetic_detail
