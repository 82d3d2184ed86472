// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furnishing.h"

#include <algorithm>
#include <cmath>

namespace foothold::synthetic_detail {
namespace {

using Eigen::Vector3f;

/// Things this near are taken to touch [m].
constexpr float kTouch_m = 0.03F;
/// Boxes may reach this far into each other: what they hold is round, and rugs are thin [m].
constexpr float kOverlap_m = 0.01F;
/// Nothing taller than the camera less this comes nearer than that to where it usually is [m].
constexpr float kBelowEye_m = 0.25F;
constexpr float kBesideEye_m = 0.6F;

bool holds(const Extent& extent, const Vector3f& point) {
  return (point.head<2>().array() >= extent.min().head<2>().array()).all() &&
         (point.head<2>().array() <= extent.max().head<2>().array()).all();
}

bool contains(const std::vector<std::size_t>& list, std::size_t value) { return std::find(list.begin(), list.end(), value) != list.end(); }

}  // namespace

Extent extent_of(const Primitive& primitive) {
  Vector3f half = primitive.half_size_m;
  if (primitive.shape == Shape::kRectangle) half.z() = 0.0F;
  if (primitive.shape == Shape::kSphere) half.setConstant(half.x());
  if (primitive.shape == Shape::kCylinder) half.y() = half.x();
  const Vector3f reach = primitive.world_from_local.rotation.cwiseAbs() * half;
  const Vector3f& centre = primitive.world_from_local.translation;
  return {centre - reach, centre + reach};
}

Furnishing::Furnishing(const Room& room) : room_(room), gone_(room.primitives.size(), false) {
  for (const Primitive& primitive : room_.primitives) extents_.push_back(extent_of(primitive));
  pieces_.resize(static_cast<std::size_t>(room_.num_pieces));
  for (std::size_t i = 0; i < room_.primitives.size(); ++i) {
    const std::int32_t piece = room_.primitives[i].piece;
    if (piece != Primitive::kFixture) pieces_[static_cast<std::size_t>(piece)].primitives.push_back(i);
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].primitives.empty()) continue;
    used_.push_back(i);
    measure(pieces_[i]);
  }
  for (const std::size_t i : used_) pieces_[i].support = support_of(pieces_[i]);
}

void Furnishing::measure(Piece& piece) const {
  piece.extent = Extent();
  for (const std::size_t i : piece.primitives) piece.extent.extend(extents_[i]);
}

std::optional<std::size_t> Furnishing::support_of(const Piece& piece) const {
  const Vector3f centre = piece.extent.center();
  const float bottom = piece.extent.min().z();
  if (bottom < kTouch_m) return std::nullopt;
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    const bool own = contains(piece.primitives, i);
    if (!own && std::fabs(extents_[i].max().z() - bottom) < kTouch_m && holds(extents_[i], centre)) return i;
  }
  return std::nullopt;
}

std::vector<std::size_t> Furnishing::group(std::size_t index) const {
  std::vector<std::size_t> result = {index};
  for (std::size_t next = 0; next < result.size(); ++next) {
    for (const std::size_t other : used_) {
      const std::optional<std::size_t>& support = pieces_[other].support;
      if (support.has_value() && contains(pieces_[result[next]].primitives, *support) && !contains(result, other)) result.push_back(other);
    }
  }
  return result;
}

Extent Furnishing::extent_of_group(const std::vector<std::size_t>& group) const {
  Extent result;
  for (const std::size_t piece : group) result.extend(pieces_[piece].extent);
  return result;
}

bool Furnishing::has_space(const Extent& extent, const std::vector<std::size_t>& ignored_pieces) const {
  const Vector3f margin = Vector3f::Constant(kOverlap_m);
  if (((extent.min() + margin).array() < room_.low_world.array()).any()) return false;
  if (((extent.max() - margin).array() > room_.high_world.array()).any()) return false;
  const Vector3f beside(kBesideEye_m, kBesideEye_m, kBelowEye_m);
  const Extent camera(room_.eye_low_world - beside, room_.eye_high_world + beside);
  if (camera.intersects(extent)) return false;
  const Extent inner(extent.min() + margin, (extent.max() - margin).cwiseMax(extent.min() + margin));
  for (std::size_t i = 0; i < extents_.size(); ++i) {
    const std::int32_t piece = room_.primitives[i].piece;
    const bool ignored = piece != Primitive::kFixture && contains(ignored_pieces, static_cast<std::size_t>(piece));
    if (!gone_[i] && !ignored && extents_[i].intersects(inner)) return false;
  }
  return true;
}

void Furnishing::move(const std::vector<std::size_t>& group, const SE3& new_from_old) {
  for (const std::size_t index : group) {
    for (const std::size_t i : pieces_[index].primitives) {
      SE3& world_from_local = room_.primitives[i].world_from_local;
      world_from_local = new_from_old * world_from_local;
      world_from_local.rotation = nearest_rotation(world_from_local.rotation);
      extents_[i] = extent_of(room_.primitives[i]);
    }
    measure(pieces_[index]);
  }
}

void Furnishing::remove(const std::vector<std::size_t>& group) {
  for (const std::size_t index : group) {
    for (const std::size_t i : pieces_[index].primitives) gone_[i] = true;
  }
}

void Furnishing::add(const std::vector<Primitive>& primitives) {
  Piece piece;
  for (Primitive primitive : primitives) {
    primitive.piece = room_.num_pieces;
    piece.primitives.push_back(room_.primitives.size());
    room_.primitives.push_back(primitive);
    extents_.push_back(extent_of(primitive));
    gone_.push_back(false);
  }
  ++room_.num_pieces;
  measure(piece);
  pieces_.push_back(piece);
}

Room Furnishing::finished() const {
  Room result = room_;
  result.primitives.clear();
  for (std::size_t i = 0; i < room_.primitives.size(); ++i) {
    if (!gone_[i]) result.primitives.push_back(room_.primitives[i]);
  }
  return result;
}

}  // namespace foothold::synthetic_detail
