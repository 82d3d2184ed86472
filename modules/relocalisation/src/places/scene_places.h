// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The scene's memory, place by place: no room takes memory from another, and a hypothesis never mixes two rooms. Not in the paper, whose
/// leaves share one memory among all that was ever seen.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "foothold/base/context.h"
#include "foothold/relocalisation/settings.h"
#include "places/place.h"

namespace foothold {

class CheckedReader;
class CheckedWriter;

/// All places of a scene.
///
/// Determinism: where places begin depends on the cameras learnt and their order alone.
class ScenePlaces {
 public:
  ScenePlaces(const Context& context, int num_leaves, const ForestRelocaliserSettings& settings)
      : context_(context), num_leaves_(num_leaves), settings_(settings) {}

  /// The index of the place that learns from a camera: the nearest whose first camera is within reach, or a new one.
  std::size_t learning(const Eigen::Vector3f& camera_world);

  /// Takes back a place that was made for a frame which taught nothing.
  void drop_unused(std::size_t place);

  bool empty() const { return places_.empty(); }
  std::size_t size() const { return places_.size(); }
  Place& operator[](std::size_t i) { return places_[i]; }
  std::size_t state_bytes() const;
  /// The same, but every place but this one counts as when it was last asked for or loaded. Cheap however many there are.
  std::size_t count_bytes(std::size_t place);
  /// Thins the place that takes the most memory, of those that have detail to give up. @return False if none has.
  bool thin_largest();
  void clear() { places_.clear(); }

  void save(CheckedWriter& writer) const;
  /// @param num_frames  that were learnt. @throws FileError if the scene ends early or contradicts itself.
  void load(CheckedReader& reader, std::uint64_t num_frames);

 private:
  Place make_place(const Eigen::Vector3f& origin_world) const;

  Context context_;
  int num_leaves_;
  ForestRelocaliserSettings settings_;
  std::vector<Place> places_;
};

}  // namespace foothold
