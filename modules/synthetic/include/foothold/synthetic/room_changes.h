// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Rooms as they are found another day, and rooms that look like another.
#pragma once

#include <cstdint>

#include "foothold/base/settings.h"
#include "foothold/synthetic/room.h"

namespace foothold {

/// How a room differs from the one that its name stands for. Shares are of its pieces of furniture, things on them included.
struct RoomChanges {
  /// Share that stands, lies or hangs elsewhere: a quarter of a metre to a metre or so away, much of it turned.
  float moved = 0.0F;
  /// Share that is taken away.
  float removed = 0.0F;
  /// New pieces, as a share of those that there were.
  float added = 0.0F;
  /// Left and right exchanged: another place that looks alike. Patterns are not mirrored.
  bool mirrored = false;
  /// Decides what is changed, and how.
  std::uint64_t change_seed = 0;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&RoomChanges::moved, "moved", "Share of the furniture that stands elsewhere.", Range{0, 1});
    v(&RoomChanges::removed, "removed", "Share of the furniture that is gone.", Range{0, 1});
    v(&RoomChanges::added, "added", "New pieces, as a share of the furniture.", Range{0, 1});
    v(&RoomChanges::mirrored, "mirrored", "Exchanges left and right.");
    v(&RoomChanges::change_seed, "change_seed", "Decides what is changed, and how.", Range{0, 18446744073709551615.0});
  }
};

/// The room after the changes. Walls, fitted cupboards, doors and windows stay, and the camera's space stays free of tall things; where
/// the room offers no other place, a piece stays where it is. Removing or moving a piece takes along what stands on it.
///
/// Determinism: a function of its arguments.
Room changed_room(const Room& room, const RoomChanges& changes);

/// The pose of the camera that sees the mirrored room as the given one sees the room, but for left and right.
SE3 mirrored_pose(const SE3& world_from_camera);

}  // namespace foothold
