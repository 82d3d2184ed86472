// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scenes by which trust is measured: what is learnt of them, and other views of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "memory_input.h"
#include "places.h"

namespace foothold::benchmark {

/// A scene in memory.
struct TrustSubject {
  std::string name;
  FrameList training;
  FrameList own;  ///< views of the scene that are not learnt
  /// Views of the scene after its furniture was changed: what was done, and the views.
  std::vector<std::pair<std::string, FrameList>> changed;
  bool repeats_itself = false;  ///< equal desks, steps or doors
  bool is_many_places = false;  ///< rooms that are alike, all of them learnt; nothing but `own` is asked
};

/// How much there is of everything.
struct TrustAmounts {
  int num_rooms = 24;       ///< the named rooms first, then training rooms that no shipped forest has seen
  int num_own = 60;         ///< views of each scene that are not learnt
  int num_strangers = 400;  ///< views of other scenes asked of each map
  int num_spoilt = 16;      ///< views of each kind that is spoilt or changed
  int first_room = -1;      ///< if not negative, training rooms from this one on instead
  RoomViews views;
};

/// Renders the rooms, and reads the recordings, of which at most `amounts.num_own` evenly chosen views are tested.
/// @throws Interrupted, FileError
std::vector<TrustSubject> load_subjects(const TrustAmounts& amounts, const std::vector<Scene>& recordings, int num_threads);

/// At most `count` frames, evenly chosen.
FrameList some_frames(const FrameList& frames, int count);

}  // namespace foothold::benchmark
