// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "reconstruct_live/recording_thread.h"

#include <vector>

#include "foothold/io/sequence.h"
#include "io_fixtures.h"
#include "reconstruct_live/recording_reader.h"
#include "support/catch.h"

namespace foothold::live {
namespace {

using namespace test;
using Catch::Matchers::Contains;

/// A frame that takes a while to write, and whose first pixel tells its number.
RgbdFrame large_frame(int i) {
  RgbdFrame frame;
  frame.depth = Image<float>(640, 480, 1.0F);
  frame.colour = Image<Rgb8>(640, 480);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) frame.colour(u, v).g = static_cast<std::uint8_t>(u * v + i);
  }
  frame.colour(0, 0).r = static_cast<std::uint8_t>(i);
  frame.calibration.depth = frame.calibration.colour = {525.0F, 525.0F, 319.5F, 239.5F};
  frame.index = i;
  frame.timestamp_s = 0.01 * i;
  frame.world_from_camera = SE3{};
  return frame;
}

}  // namespace

TEST_CASE("RecordingThread: what finds the queue full is dropped and counted, and the rest is recorded in order, without poses") {
  const TempFolder temp;
  std::vector<int> accepted;
  constexpr int kNumFrames = 40;
  int num_written = 0;
  {
    RecordingThread recording(temp / "take", 2);
    for (int i = 0; i < kNumFrames; ++i) {
      if (recording.add(large_frame(i))) accepted.push_back(i);
      CHECK(recording.progress().num_waiting <= 2);
    }
    recording.finish();
    const RecordingThread::Progress progress = recording.progress();
    CHECK(progress.num_waiting == 0);
    CHECK(progress.num_dropped == kNumFrames - static_cast<int>(accepted.size()));
    CHECK(progress.error.empty());
    num_written = progress.num_written;
    CHECK_FALSE(recording.add(large_frame(0)));
  }
  const auto sequence = open_sequence(temp / "take", Context());
  REQUIRE(sequence->num_frames() == num_written);
  REQUIRE(accepted.size() == static_cast<std::size_t>(num_written));
  for (int i = 0; i < num_written; ++i) {
    const RgbdFrame frame = sequence->load(i);
    CHECK(frame.colour(0, 0).r == accepted[static_cast<std::size_t>(i)]);
    CHECK_FALSE(frame.world_from_camera.has_value());
  }
}

TEST_CASE("RecordingThread: a disk that fails ends the recording, with the reason, and nothing else") {
  const TempFolder temp;
  RecordingThread recording(temp / "take");
  REQUIRE(recording.add(large_frame(0)));
  while (recording.progress().num_written == 0) std::this_thread::yield();
  std::filesystem::remove_all(temp / "take");
  while (recording.progress().error.empty()) recording.add(large_frame(1));
  CHECK_FALSE(recording.add(large_frame(2)));
  CHECK_THAT(recording.progress().error, Contains(temp / "take"));
  CHECK_THAT(error_of([&] { recording.finish(); }), Contains(temp / "take"));
}

namespace {

/// Delivers so many small frames, a time-out between them, and then an end or a failure.
class ListSource : public FrameSource {
 public:
  ListSource(int num_frames, bool fails) : num_frames_(num_frames), fails_(fails) {}
  ReadStatus read(RgbdFrame& frame) override {
    if (num_calls_++ % 2 == 1) return ReadStatus::kTimedOut;
    if (num_calls_ / 2 < num_frames_) {
      frame = small_frame(num_calls_ / 2);
      return ReadStatus::kFrame;
    }
    if (fails_) throw DeviceError("the camera is broken");
    return ReadStatus::kEnd;
  }

 private:
  int num_frames_;
  bool fails_;
  int num_calls_ = 0;
};

/// Reads until the reader has nothing more. @return The last frame's index.
std::int64_t read_to_the_end(RecordingReader& reader) {
  RgbdFrame frame;
  std::int64_t last = -1;
  for (ReadStatus status = ReadStatus::kTimedOut; status != ReadStatus::kEnd; status = reader.read(frame)) {
    if (status == ReadStatus::kFrame) last = frame.index;
  }
  return last;
}

}  // namespace

TEST_CASE("RecordingReader: every frame is recorded, whether anybody looks on or not, up to the limit") {
  const TempFolder temp;
  const int limit = GENERATE(0, 7);
  RecordingThread recording(temp / "take");
  ListSource source(20, false);
  {
    RecordingReader reader(source, recording, limit);
    CHECK(read_to_the_end(reader) == 19);
    CHECK(reader.num_taken() == (limit == 0 ? 20 : limit));
  }
  recording.finish();
  CHECK(recording.progress().num_dropped == 0);
  CHECK(open_sequence(temp / "take", Context())->num_frames() == (limit == 0 ? 20 : limit));
}

TEST_CASE("RecordingReader: hands on the failure of its source, after its frames") {
  const TempFolder temp;
  RecordingThread recording(temp / "take");
  ListSource source(3, true);
  RecordingReader reader(source, recording, 0);
  CHECK_THAT(error_of<DeviceError>([&] { read_to_the_end(reader); }), Contains("the camera is broken"));
  CHECK(reader.num_taken() == 3);
}

}  // namespace foothold::live
