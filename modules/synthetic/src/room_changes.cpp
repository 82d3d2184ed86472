// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/room_changes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "furnishing.h"
#include "furniture.h"

namespace foothold {
namespace {

using namespace synthetic_detail;
using Eigen::Vector2f;
using Eigen::Vector3f;

/// Places that are tried for a piece before it stays where it is.
constexpr int kMostTries = 40;
constexpr float kShortestShift_m = 0.25F;
constexpr float kLongestShift_m = 1.2F;
constexpr float kLargestFurnitureTurn_rad = 1.57F;
/// What is this near to a wall belongs there [m].
constexpr float kAtWall_m = 0.12F;
/// Things are put on surfaces of at least this half size [m], between these heights [m].
constexpr float kSmallestSurface_m = 0.15F;
constexpr float kLowestSurface_m = 0.35F;
constexpr float kHighestSurface_m = 1.4F;

SE3 yaw_about(const Vector3f& centre, float angle, const Vector3f& shift) {
  const Eigen::Matrix3f rotation = Eigen::AngleAxisf(angle, Vector3f::UnitZ()).toRotationMatrix();
  return {rotation, centre - rotation * centre + shift};
}

/// The box around a turned box.
Extent moved_extent(const Extent& extent, const SE3& new_from_old) {
  const Vector3f half = new_from_old.rotation.cwiseAbs() * (0.5F * extent.sizes());
  const Vector3f centre = new_from_old * Vector3f(extent.center());
  return {centre - half, centre + half};
}

class Rearrangement {
 public:
  Rearrangement(const Room& room, const RoomChanges& changes)
      : furnishing_(room), changes_(changes), choices_(derive_seed(changes.change_seed, 0x6368616e)) {
    order_ = furnishing_.pieces();
    for (std::size_t i = order_.size(); i > 1; --i)
      std::swap(order_[i - 1], order_[static_cast<std::size_t>(choices_.below(static_cast<int>(i)))]);
  }

  Room run() {
    take(changes_.removed, [&](const std::vector<std::size_t>& group) {
      furnishing_.remove(group);
      return true;
    });
    take(changes_.moved, [&](const std::vector<std::size_t>& group) { return move(group); });
    const int num_added = count_of(changes_.added);
    for (int i = 0; i < num_added; ++i) add();
    return furnishing_.finished();
  }

 private:
  int count_of(float share) const { return static_cast<int>(std::lround(share * static_cast<float>(furnishing_.pieces().size()))); }

  /// Applies an action to untouched groups of pieces in random order until a share of all pieces is reached.
  template <class Action>
  void take(float share, const Action& action) {
    int left = count_of(share);
    for (const std::size_t piece : order_) {
      const std::vector<std::size_t> group = furnishing_.group(piece);
      const bool fresh = std::none_of(group.begin(), group.end(), [&](std::size_t each) { return is_touched(each); });
      if (!fresh || static_cast<int>(group.size()) > left || !action(group)) continue;
      left -= static_cast<int>(group.size());
      touched_.insert(touched_.end(), group.begin(), group.end());
    }
  }
  bool is_touched(std::size_t piece) const { return std::find(touched_.begin(), touched_.end(), piece) != touched_.end(); }

  bool move(const std::vector<std::size_t>& group) {
    const Extent extent = furnishing_.extent_of_group(group);
    const Piece& piece = furnishing_.piece(group.front());
    for (int i = 0; i < kMostTries; ++i) {
      const SE3 new_from_old = draw_move(piece, i);
      const Extent moved = moved_extent(extent, new_from_old);
      const Vector2f shift = (moved.center() - extent.center()).head<2>();
      if (shift.norm() < 0.5F * kShortestShift_m || !furnishing_.has_space(moved, group)) continue;
      furnishing_.move(group, new_from_old);
      return true;
    }
    return false;
  }

  /// Elsewhere on what it stands on, along the wall that it is at, or about the floor.
  SE3 draw_move(const Piece& piece, int attempt) {
    const Vector3f centre = piece.extent.center();
    const float turn = choices_.between(-kLargestFurnitureTurn_rad, kLargestFurnitureTurn_rad);
    if (piece.support.has_value()) {
      const Extent surface = extent_of(furnishing_.room().primitives[*piece.support]);
      return yaw_about(centre, turn, draw_on(surface) - Vector3f(centre.x(), centre.y(), 0.0F));
    }
    const std::optional<Vector3f> wall = wall_direction(piece.extent);
    const bool hangs = piece.extent.min().z() > 0.05F;
    if (wall.has_value() && (hangs || attempt % 2 == 0))
      return yaw_about(centre, 0.0F, *wall * choices_.between(-kLongestShift_m, kLongestShift_m));
    const float angle = choices_.between(0.0F, 6.2831853F);
    const float length = choices_.between(kShortestShift_m, kLongestShift_m);
    return yaw_about(centre, turn, {length * std::cos(angle), length * std::sin(angle), 0.0F});
  }

  /// A place over a surface; its z is 0.
  Vector3f draw_on(const Extent& surface) {
    const float x = choices_.between(surface.min().x(), surface.max().x());
    return {x, choices_.between(surface.min().y(), surface.max().y()), 0.0F};
  }

  /// The direction along the wall that a box touches.
  std::optional<Vector3f> wall_direction(const Extent& extent) const {
    const Room& room = furnishing_.room();
    const Vector3f low = extent.min() - room.low_world;
    const Vector3f high = room.high_world - extent.max();
    if (std::min(low.y(), high.y()) < kAtWall_m) return Vector3f::UnitX();
    if (std::min(low.x(), high.x()) < kAtWall_m) return Vector3f::UnitY();
    return std::nullopt;
  }

  void add() {
    const bool on_floor = choices_.chance(0.4F);
    for (int i = 0; i < kMostTries; ++i) {
      Room scratch;
      const float yaw_deg = choices_.between(0.0F, 360.0F);
      const RoomBuilder world(scratch);
      if (on_floor) {
        const Vector3f place = draw_on({furnishing_.room().low_world, furnishing_.room().high_world});
        stand_on_floor(world.at(place.x(), place.y(), 0.0F, yaw_deg));
      } else {
        const Extent surface = draw_surface();
        const Vector3f place = draw_on(surface);
        small_thing(world.at(place.x(), place.y(), surface.max().z(), yaw_deg), choices_);
      }
      Extent extent;
      for (Primitive& primitive : scratch.primitives) {
        primitive.seed += 0x10000U * static_cast<std::uint32_t>(furnishing_.room().num_pieces);  // patterns of its own
        extent.extend(extent_of(primitive));
      }
      if (!furnishing_.has_space(extent, {})) continue;
      furnishing_.add(scratch.primitives);
      return;
    }
  }

  void stand_on_floor(const RoomBuilder& b) {
    const Colour colour = choices_.colour();
    switch (choices_.below(6)) {
      case 0:
        return office_chair(b, fabric(colour), choices_.seed());
      case 1: {
        const Material timber = wood(choices_.timber());  // drawn first: the order of arguments is the compiler's
        return stool(b, choices_.between(0.4F, 0.6F), fabric(colour), timber);
      }
      case 2:
        return bin(b, colour);
      case 3:
        return plant(b, choices_.between(0.5F, 0.8F), colour, choices_);
      case 4: {
        const std::uint32_t seed = choices_.seed();
        return wooden_chair(b, wood(choices_.timber()), fabric(colour), seed);
      }
      default:
        return box_stack(b, 1 + choices_.below(2), choices_);
    }
  }

  /// A level surface that carries things; the floor if there is none.
  Extent draw_surface() {
    std::vector<Extent> surfaces;
    for (const Primitive& primitive : furnishing_.room().primitives) {
      if (primitive.shape != Shape::kBox || primitive.world_from_local.rotation(2, 2) < 0.99F) continue;
      const Extent extent = extent_of(primitive);
      const float top = extent.max().z();
      if (primitive.half_size_m.head<2>().minCoeff() >= kSmallestSurface_m && top > kLowestSurface_m && top < kHighestSurface_m)
        surfaces.push_back(extent);
    }
    if (surfaces.empty())
      return Extent(furnishing_.room().low_world, furnishing_.room().high_world.cwiseProduct(Vector3f(1.0F, 1.0F, 0.0F)));
    return surfaces[static_cast<std::size_t>(choices_.below(static_cast<int>(surfaces.size())))];
  }

  Furnishing furnishing_;
  RoomChanges changes_;
  Choices choices_;
  std::vector<std::size_t> order_;
  std::vector<std::size_t> touched_;
};

Vector3f mirrored_point(const Vector3f& point) { return {-point.x(), point.y(), point.z()}; }

Room mirrored_room(Room room) {
  for (Primitive& primitive : room.primitives) primitive.world_from_local = mirrored_pose(primitive.world_from_local);
  for (PointLight& light : room.lights) light.position_world = mirrored_point(light.position_world);
  for (Vector3f& target : room.targets_world) target = mirrored_point(target);
  for (const auto& [low, high] : {std::pair(&room.low_world, &room.high_world), std::pair(&room.eye_low_world, &room.eye_high_world)}) {
    const float low_x = low->x();
    low->x() = -high->x();
    high->x() = -low_x;
  }
  return room;
}

}  // namespace

SE3 mirrored_pose(const SE3& world_from_camera) {
  SE3 result = world_from_camera;
  result.rotation.row(0) *= -1.0F;  // the world's x
  result.rotation.col(0) *= -1.0F;  // and the camera's, so that it stays right-handed
  result.translation.x() *= -1.0F;
  return result;
}

Room changed_room(const Room& room, const RoomChanges& changes) {
  validate_settings(changes);
  const bool rearranged = changes.moved > 0.0F || changes.removed > 0.0F || changes.added > 0.0F;
  Room result = rearranged ? Rearrangement(room, changes).run() : room;
  return changes.mirrored ? mirrored_room(std::move(result)) : result;
}

}  // namespace foothold
