// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Puts primitives into a room, each in the frame of the piece of furniture that it belongs to.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

/// What the six faces of a room are covered with.
struct ShellMaterials {
  Material floor;
  Material ceiling;
  Material north;  ///< the wall at +y
  Material south;
  Material east;  ///< the wall at +x
  Material west;
};

/// The seed of a primitive whose pattern is its own: the number of primitives before it decides.
constexpr std::uint32_t kOwnPattern = 0xffffffffU;

/// A frame within a room. Furniture stands on z = 0, faces -y and has its middle at x = 0, its back at y = 0, so that it goes to a wall as
/// it is.
class RoomBuilder {
 public:
  explicit RoomBuilder(Room& room) : room_(&room) {}

  /// A frame at a place of this one [m], turned about z [deg, counter-clockwise from above].
  RoomBuilder at(float x, float y, float z, float yaw_deg = 0.0F) const;
  /// This frame turned about its x axis [deg]; positive angles lower what faces -y.
  RoomBuilder pitched(float pitch_deg) const;
  /// This frame turned about its y axis [deg].
  RoomBuilder rolled(float roll_deg) const;
  /// The frame of furniture on a wall, `along` metres from its middle to the right as seen from the room.
  RoomBuilder against_north(float along) const;
  RoomBuilder against_south(float along) const;
  RoomBuilder against_east(float along) const;
  RoomBuilder against_west(float along) const;

  /// This frame for a piece of furniture of its own: what is put into it can be moved or taken away.
  RoomBuilder piece() const;

  void box(const Eigen::Vector3f& centre, const Eigen::Vector3f& size, const Material& material, std::uint32_t seed = kOwnPattern) const;
  /// An upright cylinder on a place.
  void cylinder(const Eigen::Vector3f& base, float radius, float height, const Material& material, std::uint32_t seed = kOwnPattern) const;
  /// A round bar between two places.
  void rod(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius, const Material& material,
           std::uint32_t seed = kOwnPattern) const;
  void sphere(const Eigen::Vector3f& centre, float radius, const Material& material, std::uint32_t seed = kOwnPattern) const;
  /// An upright patch that faces -y.
  void picture(const Eigen::Vector3f& centre, float width, float height, const Material& material, std::uint32_t seed = kOwnPattern) const;
  /// A patch that faces up.
  void sheet(const Eigen::Vector3f& centre, float width, float depth, const Material& material, std::uint32_t seed = kOwnPattern) const;
  /// Floor, ceiling and walls of a room whose middle is here, and the room's extent.
  void shell(float width, float depth, float height, const ShellMaterials& materials) const;
  /// Something worth pointing a camera at.
  void target(const Eigen::Vector3f& place) const;
  void light(const Eigen::Vector3f& place, const Eigen::Vector3f& intensity) const;

  Room& room() const { return *room_; }

 private:
  void add(Shape shape, const SE3& frame_from_local, const Eigen::Vector3f& half_size, const Material& material, std::uint32_t seed) const;

  Room* room_;
  SE3 world_from_frame_;
  std::int32_t piece_ = Primitive::kFixture;
};

}  // namespace foothold::synthetic_detail
