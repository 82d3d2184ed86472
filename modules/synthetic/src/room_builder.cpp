// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "room_builder.h"

#include "foothold/base/angle.h"

#include <Eigen/Geometry>

namespace foothold::synthetic_detail {
namespace {

using Eigen::Vector3f;

Eigen::Matrix3f turn(float angle_deg, const Vector3f& axis) {
  const Eigen::Matrix3f rotation = Eigen::AngleAxisf(angle_deg * kRadPerDeg, axis).toRotationMatrix();
  return nearest_rotation(rotation);
}

/// Local x, y, z as columns.
Eigen::Matrix3f axes(const Vector3f& x, const Vector3f& y, const Vector3f& z) {
  Eigen::Matrix3f rotation;
  rotation << x, y, z;
  return rotation;
}

const Vector3f kX(1.0F, 0.0F, 0.0F);
const Vector3f kY(0.0F, 1.0F, 0.0F);
const Vector3f kZ(0.0F, 0.0F, 1.0F);

}  // namespace

RoomBuilder RoomBuilder::at(float x, float y, float z, float yaw_deg) const {
  RoomBuilder result = *this;
  result.world_from_frame_ = world_from_frame_ * SE3{turn(yaw_deg, kZ), {x, y, z}};
  return result;
}

RoomBuilder RoomBuilder::pitched(float pitch_deg) const {
  RoomBuilder result = *this;
  result.world_from_frame_ = world_from_frame_ * SE3{turn(pitch_deg, kX), Vector3f::Zero()};
  return result;
}

RoomBuilder RoomBuilder::rolled(float roll_deg) const {
  RoomBuilder result = *this;
  result.world_from_frame_ = world_from_frame_ * SE3{turn(roll_deg, kY), Vector3f::Zero()};
  return result;
}

RoomBuilder RoomBuilder::against_north(float along) const { return at(along, room_->high_world.y(), 0.0F, 0.0F); }
RoomBuilder RoomBuilder::against_south(float along) const { return at(-along, room_->low_world.y(), 0.0F, 180.0F); }
RoomBuilder RoomBuilder::against_east(float along) const { return at(room_->high_world.x(), -along, 0.0F, -90.0F); }
RoomBuilder RoomBuilder::against_west(float along) const { return at(room_->low_world.x(), along, 0.0F, 90.0F); }

RoomBuilder RoomBuilder::piece() const {
  RoomBuilder result = *this;
  result.piece_ = room_->num_pieces++;
  return result;
}

void RoomBuilder::box(const Vector3f& centre, const Vector3f& size, const Material& material, std::uint32_t seed) const {
  add(Shape::kBox, {Eigen::Matrix3f::Identity(), centre}, 0.5F * size, material, seed);
}

void RoomBuilder::cylinder(const Vector3f& base, float radius, float height, const Material& material, std::uint32_t seed) const {
  add(Shape::kCylinder, {Eigen::Matrix3f::Identity(), base + 0.5F * height * kZ}, {radius, radius, 0.5F * height}, material, seed);
}

void RoomBuilder::rod(const Vector3f& from, const Vector3f& to, float radius, const Material& material, std::uint32_t seed) const {
  const Vector3f z = (to - from).normalized();
  const Vector3f x = (std::fabs(z.z()) < 0.9F ? kZ : kX).cross(z).normalized();
  const SE3 frame_from_local{nearest_rotation(axes(x, z.cross(x), z)), 0.5F * (from + to)};
  add(Shape::kCylinder, frame_from_local, {radius, radius, 0.5F * (to - from).norm()}, material, seed);
}

void RoomBuilder::sphere(const Vector3f& centre, float radius, const Material& material, std::uint32_t seed) const {
  add(Shape::kSphere, {Eigen::Matrix3f::Identity(), centre}, Vector3f::Constant(radius), material, seed);
}

void RoomBuilder::picture(const Vector3f& centre, float width, float height, const Material& material, std::uint32_t seed) const {
  add(Shape::kRectangle, {axes(kX, kZ, -kY), centre}, {0.5F * width, 0.5F * height, 0.0F}, material, seed);
}

void RoomBuilder::sheet(const Vector3f& centre, float width, float depth, const Material& material, std::uint32_t seed) const {
  add(Shape::kRectangle, {Eigen::Matrix3f::Identity(), centre}, {0.5F * width, 0.5F * depth, 0.0F}, material, seed);
}

void RoomBuilder::shell(float width, float depth, float height, const ShellMaterials& materials) const {
  room_->low_world = world_from_frame_ * Vector3f(-0.5F * width, -0.5F * depth, 0.0F);
  room_->high_world = world_from_frame_ * Vector3f(0.5F * width, 0.5F * depth, height);
  const float z = 0.5F * height;
  sheet(Vector3f::Zero(), width, depth, materials.floor, 1);
  add(Shape::kRectangle, {axes(kX, -kY, -kZ), height * kZ}, {0.5F * width, 0.5F * depth, 0.0F}, materials.ceiling, 2);
  against_north(0.0F).picture({0.0F, 0.0F, z}, width, height, materials.north, 3);
  against_south(0.0F).picture({0.0F, 0.0F, z}, width, height, materials.south, 4);
  against_east(0.0F).picture({0.0F, 0.0F, z}, depth, height, materials.east, 5);
  against_west(0.0F).picture({0.0F, 0.0F, z}, depth, height, materials.west, 6);
}

void RoomBuilder::target(const Vector3f& place) const { room_->targets_world.push_back(world_from_frame_ * place); }

void RoomBuilder::light(const Vector3f& place, const Vector3f& intensity) const {
  room_->lights.push_back({world_from_frame_ * place, intensity});
}

void RoomBuilder::add(Shape shape, const SE3& frame_from_local, const Vector3f& half_size, const Material& material,
                      std::uint32_t seed) const {
  SE3 world_from_local = world_from_frame_ * frame_from_local;
  world_from_local.rotation = nearest_rotation(world_from_local.rotation);
  const auto own = static_cast<std::uint32_t>(1000U + 16U * room_->primitives.size());
  room_->primitives.push_back({shape, world_from_local, half_size, material, seed == kOwnPattern ? own : seed, piece_});
}

}  // namespace foothold::synthetic_detail
