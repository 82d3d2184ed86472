// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a place knows already: how often each small piece of surface was learnt, and from where. Not in the paper, whose reservoirs forget
/// by chance instead: here what adds nothing is never learnt, so that memory grows with what was seen and not with time.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "examples/training_examples.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"

namespace foothold {

class CheckedReader;
class CheckedWriter;

/// Counts examples by piece of surface (a cube of the scene) and viewpoint (direction and distance of the camera from it).
///
/// Determinism: what is kept depends on the frames and their order, never on threads or device.
class LearntViews {
 public:
  explicit LearntViews(const Memory& memory);

  /// Keeps the examples that have depth and show what was not learnt often enough from there, in their order, and counts them.
  /// @pre The examples have surface keys.
  /// @param camera_scene  position of the camera in the frame of the examples' points [m].
  /// @param examples_per_view  how often is enough; 0 if it never is, and nothing is counted. [0, 255]
  void keep_new(const Context& context, const Eigen::Vector3f& camera_scene, int examples_per_view, TrainingExamples& examples);

  /// Hands over the points of all examples that keep_new() was last offered, known or not, for an array to work in.
  void swap_offered(Array<ReservoirPoint>& points) {
    points.resize(unfiltered_.points.size());  // now, so that no later frame allocates
    unfiltered_.points.swap(points);
  }

  /// Of the examples that keep_new() was last offered, those that lie beyond the place's reach.
  std::size_t num_beyond_reach() const { return num_beyond_reach_; }

  std::size_t state_bytes() const { return slots_.size() * sizeof(std::uint64_t); }

  void save(CheckedWriter& writer) const;
  /// @throws FileError if the table contradicts itself.
  void load(const Context& context, CheckedReader& reader);

 private:
  void make_room(const Context& context, std::size_t num_new);
  void set_num_slots(const Context& context, std::size_t num_slots);

  Array<std::uint64_t> slots_;     ///< a hash table, see learnt_views_kernels.h; a power of two, or empty
  std::uint64_t num_entries_ = 0;  ///< slots in use
  std::size_t num_beyond_reach_ = 0;
  Array<std::uint32_t> totals_;  ///< examples that the last frame kept, slots in use, and its examples beyond reach
  // Scratch of keep_new().
  Array<std::uint64_t> sort_buffer_;
  Array<std::uint32_t> kept_;
  Array<std::uint32_t> counts_;
  Array<std::uint32_t> kept_before_;
  TrainingExamples unfiltered_;
};

}  // namespace foothold
