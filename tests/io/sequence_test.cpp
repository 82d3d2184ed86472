// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/sequence.h"

#include "io_fixtures.h"
#include "support/catch.h"

namespace foothold {

using namespace test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("parse_frame_range: either side may be left out") {
  CHECK(parse_frame_range("3:10").begin == 3);
  CHECK(parse_frame_range("3:10").end == 10);
  CHECK(parse_frame_range("3:").end == FrameRange::kToTheEnd);
  CHECK(parse_frame_range(":10").begin == 0);
  CHECK(parse_frame_range(":").end == FrameRange::kToTheEnd);
}

TEST_CASE("parse_frame_range: anything else is refused, quoting it") {
  const std::string text =
      GENERATE(as<std::string>{}, "", "5", "a:b", "1:2:3", "-1:5", "5:5", "7:3", "1.5:3", " 1:3", "99999999999:", "1:x");
  CHECK_THAT(error_of<InvalidSettings>([&] { parse_frame_range(text); }), Contains("'" + text + "'") && Contains("A:B"));
}

TEST_CASE("open_sequence: a part of a recording keeps the indices of the whole") {
  const TempFolder temp;
  const std::string folder = temp / "me@home";  // an '@' of its own
  write_small_recording(folder, 5);
  CHECK(open_sequence(folder, Context())->num_frames() == 5);
  const auto part = open_sequence(folder + "@1:4", Context());
  CHECK(part->num_frames() == 3);
  CHECK(part->name() == "me@home@1:4");
  CHECK(part->load(0).index == 1);
  CHECK(part->load(2).colour(0, 0).b == 3);
  CHECK(open_sequence(folder + "@3:", Context())->num_frames() == 2);
  CHECK(open_sequence(folder + "@:2", Context())->num_frames() == 2);
}

TEST_CASE("open_sequence: a range outside the recording is refused, naming its length") {
  const TempFolder temp;
  write_small_recording(temp.path(), 5);
  for (const std::string range : {"0:6", "5:", "7:9"}) {
    CHECK_THAT(error_of<InvalidSettings>([&] { open_sequence(temp.path() + "@" + range, Context()); }), Contains("5 frames"));
  }
  CHECK_THAT(error_of<InvalidSettings>([&] { open_sequence(temp.path() + "@4:2", Context()); }), Contains("'4:2'"));
  CHECK_THAT(error_of<InvalidSettings>([&] { open_sequence("", Context()); }), Contains("empty name"));
}

TEST_CASE("open_sequence: renders a synthetic room, or a part of it") {
  const auto part = open_sequence("synthetic:office?frames=10&width=64&height=48@4:6", Context());
  REQUIRE(part->num_frames() == 2);
  const RgbdFrame frame = part->load(1);
  CHECK(describe_frame_error(frame.view()).empty());
  CHECK(frame.index == 5);
  CHECK(frame.depth.width() == 64);
  CHECK(frame.world_from_camera.has_value());
  CHECK_THAT(error_of<InvalidSettings>([] { open_sequence("synthetic:offcie", Context()); }), Contains("offcie") && Contains("office"));
}

TEST_CASE("read_split: lists the sequences of a scene") {
  const TempFolder temp;
  for (const std::string name : {"seq-01", "seq-03", "seq-12"}) fs::create_directory(temp / name);
  write_text(temp / "TrainSplit.txt", "sequence1\r\nsequence12\r\n");
  write_text(temp / "TestSplit.txt", "sequence3\n");
  CHECK(read_split(temp.path(), "train") == std::vector<std::string>{temp / "seq-01", temp / "seq-12"});
  CHECK(read_split(temp.path(), "test") == std::vector<std::string>{temp / "seq-03"});
  CHECK_THAT(error_of<InvalidSettings>([&] { read_split(temp.path(), "validation"); }),
             Contains("'validation'") && Contains("train or test"));
}

TEST_CASE("read_split: says what is wrong with a scene folder") {
  const TempFolder temp;
  const auto error = [&] { return error_of([&] { read_split(temp.path(), "train"); }); };
  CHECK_THAT(error(), Contains(temp / "TrainSplit.txt") && Contains("folder of a 7-Scenes scene"));
  CHECK_THAT(error_of([&] { read_split(temp / "absent", "train"); }), Contains(temp / "absent") && Contains("no such folder"));
  write_text(temp / "frame-000000.depth.png", "");
  CHECK_THAT(error(), Contains("one of its sequences"));
  write_text(temp / "TrainSplit.txt", "");
  CHECK_THAT(error(), Contains(temp / "TrainSplit.txt") && Contains("no sequence"));
  write_text(temp / "TrainSplit.txt", "sequence1\n");
  CHECK_THAT(error(), Contains(temp / "seq-01") && Contains("lists it"));
  for (const std::string line : {"seq-01", "sequence", "sequence0", "sequence1x", "sequence 1", "sequence-1"}) {
    write_text(temp / "TrainSplit.txt", line + "\n");
    CHECK_THAT(error(), Contains(temp / "TrainSplit.txt") && Contains("line 1") && Contains("sequenceN"));
  }
}

}  // namespace foothold
