// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser that learns beside the host's work.
#pragma once

#include <cstdint>
#include <vector>

#include "foothold/api/relocaliser_decorator.h"
#include "foothold/base/background_queue.h"

namespace foothold {

/// Has another relocaliser learn while the host goes on: train() copies a frame and returns, update() returns at once, and both are done on
/// another thread of the context, in their order. Every other call waits until they are done, as does the next train(). So the wrapped
/// relocaliser is called by one thread at a time, in the order in which its host asks, and all results are those that it would give by
/// itself.
///
/// What training throws, train(), relocalise() or another call that follows throws, in place of doing its own work; what the last training
/// throws is told to the context's log if no call follows. Malformed frames and poses are refused at once.
///
/// Where BackgroundQueue::is_beside() is false, and for frames in CUDA memory, every call is handed on as it is.
class BackgroundRelocaliser : public RelocaliserDecorator {
 public:
  /// @pre `inner` outlives this object, works on the context, and is used through this object or behind wait() alone.
  BackgroundRelocaliser(const Context& context, Relocaliser& inner) : RelocaliserDecorator(inner), queue_(context) {}

  /// Copies the frame: its images are free when the call returns.
  void train(const Frame& frame, const SE3& world_from_camera) override;
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override;
  void reset() override;
  std::size_t state_bytes() const override;
  float acceptance_threshold() const override;

  /// Returns once everything is learnt. @throws What training threw, once.
  void wait() const { queue_.wait(); }

 private:
  /// The frame, looking at a copy of its images that lasts until the next.
  Frame copy(const Frame& frame);

  std::vector<float> depth_m_;        // of the frame that is being learnt
  std::vector<std::uint8_t> colour_;  // likewise
  mutable BackgroundQueue queue_;     // last: what it does uses the rest
};

}  // namespace foothold
