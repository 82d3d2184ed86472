// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A room as furniture that can be moved: what stands on what, and where there is space.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

using Extent = Eigen::AlignedBox3f;

/// The box around a primitive, its sides along the world's axes.
Extent extent_of(const Primitive& primitive);

/// A piece of furniture.
struct Piece {
  std::vector<std::size_t> primitives;
  Extent extent;
  /// The primitive that it stands or lies on; empty for what stands on the floor or hangs.
  std::optional<std::size_t> support;
};

class Furnishing {
 public:
  explicit Furnishing(const Room& room);

  /// Numbers of the pieces that have primitives.
  const std::vector<std::size_t>& pieces() const { return used_; }
  const Piece& piece(std::size_t index) const { return pieces_[index]; }
  /// A piece and all that stands on it.
  std::vector<std::size_t> group(std::size_t index) const;
  /// The box around pieces.
  Extent extent_of_group(const std::vector<std::size_t>& group) const;

  /// True if a box has space: inside the walls, out of the camera's way, and clear of all primitives but those of the pieces named.
  bool has_space(const Extent& extent, const std::vector<std::size_t>& ignored_pieces) const;

  /// Moves pieces by a transform of the world.
  void move(const std::vector<std::size_t>& group, const SE3& new_from_old);
  /// Takes pieces out of the way; their primitives are gone from finished().
  void remove(const std::vector<std::size_t>& group);
  /// Adds the primitives as a new piece.
  void add(const std::vector<Primitive>& primitives);

  const Room& room() const { return room_; }
  Room finished() const;

 private:
  void measure(Piece& piece) const;
  std::optional<std::size_t> support_of(const Piece& piece) const;

  Room room_;
  std::vector<Extent> extents_;  ///< of the primitives
  std::vector<bool> gone_;       ///< by primitive
  std::vector<Piece> pieces_;
  std::vector<std::size_t> used_;
};

}  // namespace foothold::synthetic_detail
