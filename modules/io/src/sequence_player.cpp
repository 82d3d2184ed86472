// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/sequence_player.h"

#include <algorithm>

#include "foothold/base/contract.h"

namespace foothold {

SequencePlayer::SequencePlayer(std::shared_ptr<const Sequence> sequence, std::vector<int> indices, int lookahead)
    : sequence_(std::move(sequence)), indices_(std::move(indices)), lookahead_(static_cast<std::size_t>(lookahead)) {
  FOOTHOLD_EXPECTS(sequence_ != nullptr && lookahead > 0);
  FOOTHOLD_EXPECTS(std::all_of(indices_.begin(), indices_.end(), [n = sequence_->num_frames()](int i) { return i >= 0 && i < n; }));
  decoder_ = std::thread([this] { decode_all(); });
}

SequencePlayer::~SequencePlayer() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  decoder_.join();
}

ReadStatus SequencePlayer::read(RgbdFrame& frame) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty() || finished_; });
  if (ready_.empty()) {
    if (failure_) std::rethrow_exception(failure_);
    return ReadStatus::kEnd;
  }
  frame = std::move(ready_.front());
  ready_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return ReadStatus::kFrame;
}

void SequencePlayer::decode_all() {
  std::exception_ptr failure;
  try {
    for (const int index : indices_) {
      {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this] { return stop_ || ready_.size() < lookahead_; });
        if (stop_) return;
      }
      RgbdFrame frame = sequence_->load(index);
      const std::lock_guard<std::mutex> lock(mutex_);
      ready_.push_back(std::move(frame));
      changed_.notify_all();
    }
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  failure_ = failure;
  finished_ = true;
  changed_.notify_all();
}

std::vector<int> frame_indices(const Sequence& sequence, int stride) {
  FOOTHOLD_EXPECTS(stride > 0);
  std::vector<int> indices;
  for (int i = 0; i < sequence.num_frames(); i += stride) indices.push_back(i);
  return indices;
}

}  // namespace foothold
