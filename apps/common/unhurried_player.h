// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Frames of a recording without a thread beside the reader's, for timing.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "foothold/api/frame_source.h"

namespace foothold::apps {

/// Decodes each frame when it is read, in the reader's thread.
class UnhurriedPlayer : public FrameSource {
 public:
  UnhurriedPlayer(std::shared_ptr<const Sequence> sequence, std::vector<int> indices)
      : sequence_(std::move(sequence)), indices_(std::move(indices)) {}
  ReadStatus read(RgbdFrame& frame) override {
    if (next_ == indices_.size()) return ReadStatus::kEnd;
    frame = sequence_->load(indices_[next_++]);
    return ReadStatus::kFrame;
  }

 private:
  std::shared_ptr<const Sequence> sequence_;
  std::vector<int> indices_;
  std::size_t next_ = 0;
};

}  // namespace foothold::apps
