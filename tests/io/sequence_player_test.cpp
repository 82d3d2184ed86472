// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/sequence_player.h"

#include <atomic>
#include <chrono>

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// A recording in memory that counts how far it was read and breaks at one frame.
class CountingSequence : public Sequence {
 public:
  explicit CountingSequence(int num_frames, int broken = -1) : num_frames_(num_frames), broken_(broken) {}
  std::string name() const override { return "counting"; }
  int num_frames() const override { return num_frames_; }
  RgbdFrame load(int index) const override {
    ++num_loads;
    if (index == broken_) throw FileError("frame " + std::to_string(index) + " is broken");
    RgbdFrame frame;
    frame.index = index;
    return frame;
  }

  mutable std::atomic<int> num_loads{0};

 private:
  int num_frames_;
  int broken_;
};

/// Waits until a count stops growing: the decoder has filled its queue.
int settled(const std::atomic<int>& count) {
  for (int last = -1; last != count;) {
    last = count;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return count;
}

}  // namespace

TEST_CASE("SequencePlayer: delivers the chosen frames in the order given, then ends for good") {
  const std::vector<int> indices{3, 0, 0, 9, 5};
  SequencePlayer player(std::make_shared<CountingSequence>(10), indices, 2);
  RgbdFrame frame;
  for (const int index : indices) {
    REQUIRE(player.read(frame) == ReadStatus::kFrame);
    CHECK(frame.index == index);
  }
  CHECK(player.read(frame) == ReadStatus::kEnd);
  CHECK(player.read(frame) == ReadStatus::kEnd);
}

TEST_CASE("SequencePlayer: no frames at all end at once") {
  SequencePlayer player(std::make_shared<CountingSequence>(0), {});
  RgbdFrame frame;
  CHECK(player.read(frame) == ReadStatus::kEnd);
}

TEST_CASE("SequencePlayer: decodes ahead, but not further than asked") {
  const auto sequence = std::make_shared<CountingSequence>(100);
  SequencePlayer player(sequence, frame_indices(*sequence), 3);
  CHECK(settled(sequence->num_loads) == 3);
  RgbdFrame frame;
  CHECK(player.read(frame) == ReadStatus::kFrame);
  CHECK(settled(sequence->num_loads) == 4);
}

TEST_CASE("SequencePlayer: what the decoder throws arrives after the frames before it, and stays") {
  const auto sequence = std::make_shared<CountingSequence>(10, 2);
  SequencePlayer player(sequence, frame_indices(*sequence), 8);
  settled(sequence->num_loads);
  RgbdFrame frame;
  CHECK(player.read(frame) == ReadStatus::kFrame);
  CHECK(player.read(frame) == ReadStatus::kFrame);
  CHECK(frame.index == 1);
  CHECK_THROWS_WITH(player.read(frame), "frame 2 is broken");
  CHECK_THROWS_AS(player.read(frame), FileError);
  CHECK(sequence->num_loads == 3);
}

TEST_CASE("SequencePlayer: may be destroyed at any time") {
  for (int num_reads = 0; num_reads < 20; ++num_reads) {
    const auto sequence = std::make_shared<CountingSequence>(10, 8);
    SequencePlayer player(sequence, frame_indices(*sequence), 2);
    RgbdFrame frame;
    for (int i = 0; i < std::min(num_reads, 8); ++i) CHECK(player.read(frame) == ReadStatus::kFrame);
  }
}

TEST_CASE("SequencePlayer: refuses indices outside the recording") {
  CHECK_THROWS_AS(SequencePlayer(std::make_shared<CountingSequence>(3), {0, 3}), ContractViolation);
  CHECK_THROWS_AS(SequencePlayer(std::make_shared<CountingSequence>(3), {0}, 0), ContractViolation);
  CHECK_THROWS_AS(SequencePlayer(nullptr, {}), ContractViolation);
}

TEST_CASE("frame_indices: every stride-th frame") {
  const CountingSequence sequence(7);
  CHECK(frame_indices(sequence).size() == 7);
  CHECK(frame_indices(sequence, 3) == std::vector<int>{0, 3, 6});
}

}  // namespace foothold
