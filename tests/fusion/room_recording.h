// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A walk through a rendered room, rendered once for all tests of a process: rendering takes longer than what is tested.
#pragma once

#include <map>
#include <memory>

#include "foothold/fusion/tsdf_volume.h"
#include "foothold/synthetic/synthetic_sequence.h"

namespace foothold::test {

class RoomRecording {
 public:
  explicit RoomRecording(const char* spec) : sequence_(make_synthetic_sequence(parse_synthetic_spec(spec), Context())) {}

  const RgbdFrame& frame(int index) {
    const auto found = frames_.find(index);
    return found != frames_.end() ? found->second : frames_.emplace(index, sequence_->load(index)).first->second;
  }
  const SE3& pose(int index) { return *frame(index).world_from_camera; }

  /// A map of the frames [begin, end), every `stride`-th, fused with their true poses.
  TsdfVolume fused(const Context& context, int begin, int end, int stride) {
    TsdfVolume volume(context, {});
    for (int i = begin; i < end; i += stride) volume.integrate(frame(i).view(), pose(i));
    return volume;
  }

 private:
  std::unique_ptr<Sequence> sequence_;
  std::map<int, RgbdFrame> frames_;
};

/// A room with repeated desks.
inline RoomRecording& office() {
  static RoomRecording recording("synthetic:office?frames=300");
  return recording;
}

}  // namespace foothold::test
