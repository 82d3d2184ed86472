// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Plays a recording, decoding ahead in a thread of its own.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "foothold/api/frame_source.h"

namespace foothold {

/// Delivers chosen frames of a recording in the order given, at most `lookahead` of them decoded in advance.
///
/// Destroy it at any time: the frame being decoded is finished, the rest is dropped. read() serves one thread.
class SequencePlayer : public FrameSource {
 public:
  /// @pre The sequence is not null, every index is valid for it, and lookahead > 0.
  SequencePlayer(std::shared_ptr<const Sequence> sequence, std::vector<int> indices, int lookahead = 4);
  ~SequencePlayer() override;
  SequencePlayer(const SequencePlayer&) = delete;
  SequencePlayer& operator=(const SequencePlayer&) = delete;

  /// Delivers the next frame, waiting as long as its decoding takes: kFrame or kEnd, never kTimedOut.
  /// @throws what Sequence::load() threw, after the frames before it were delivered, and again on every later call.
  ReadStatus read(RgbdFrame& frame) override;

 private:
  void decode_all();

  const std::shared_ptr<const Sequence> sequence_;
  const std::vector<int> indices_;
  const std::size_t lookahead_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<RgbdFrame> ready_;  // guarded by mutex_, as are the three below
  std::exception_ptr failure_;
  bool finished_ = false;
  bool stop_ = false;
  std::thread decoder_;
};

/// Every `stride`-th frame of a recording, for a player. @pre stride > 0
std::vector<int> frame_indices(const Sequence& sequence, int stride = 1);

}  // namespace foothold
