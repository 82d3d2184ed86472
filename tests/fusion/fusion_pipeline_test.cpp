// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/fusion_pipeline.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "fusion/room_recording.h"
#include "fusion/scene.h"
#include "support/catch.h"
#include "support/comma_locale.h"

namespace foothold {
namespace {

/// Knows the truth about a frame, and what it was taught.
class OracleRelocaliser final : public Relocaliser {
 public:
  void train(const Frame& frame, const SE3&) override { trained.push_back(frame.index); }
  std::vector<PoseEstimate> relocalise(const Frame&) override {
    ++num_asked;
    return answers;
  }
  void update() override {}
  void reset() override { trained.clear(); }
  std::size_t state_bytes() const override { return 0; }
  float acceptance_threshold() const override { return 0.1F; }

  std::vector<PoseEstimate> answers;
  std::vector<std::int64_t> trained;
  int num_asked = 0;
};

std::string bytes_of(const TsdfVolume& volume) {
  std::ostringstream stream;
  volume.save(stream);
  return stream.str();
}

RgbdFrame black_frame(int index) {
  RgbdFrame frame = test::office().frame(index);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    frame.depth.data()[i] = 0.0F;
    frame.colour.data()[i] = {};
  }
  return frame;
}

/// A pipeline that has followed the office's first frames.
constexpr int kNumFollowed = 24;
struct Followed {
  explicit Followed(const FusionSettings& settings = {}) : pipeline(Context(), settings, &oracle) {
    pipeline.start_at(test::office().pose(0));
    for (int i = 0; i < kNumFollowed; ++i) last = pipeline.process(test::office().frame(i).view());
  }
  FusionFrameResult process(int index) { return last = pipeline.process(test::office().frame(index).view()); }
  void answer(const SE3& pose) { oracle.answers = {{pose, 0.9F}}; }

  OracleRelocaliser oracle;
  FusionPipeline pipeline;
  FusionFrameResult last;
};

TEST_CASE("FusionPipeline: follows a camera, fusing and training on every frame") {
  Followed run;
  REQUIRE(run.last.state == RecoveryState::kTracking);
  REQUIRE(run.last.quality == TrackingQuality::kGood);
  REQUIRE(run.last.fused);
  REQUIRE(run.last.trained);
  REQUIRE(run.oracle.trained.size() == kNumFollowed);
  REQUIRE(run.oracle.num_asked == 0);
  REQUIRE(run.last.confidence > 0.5F);
  REQUIRE(translation_distance_m(*run.last.world_from_camera, test::office().pose(kNumFollowed - 1)) < 0.01F);  // a voxel
  REQUIRE(rotation_distance_rad(*run.last.world_from_camera, test::office().pose(kNumFollowed - 1)) < 0.01F);
}

TEST_CASE("FusionPipeline: while lost, neither the map nor the relocaliser changes by a bit") {
  Followed run;
  const std::string before = bytes_of(run.pipeline.volume());
  const std::size_t num_trained = run.oracle.trained.size();
  test::RoomRecording elsewhere("synthetic:lounge?frames=40");
  for (int i = 0; i < 12; ++i) {
    // The relocaliser is wrong all the while: it names places in the map.
    run.answer(test::office().pose(i));
    run.last = run.pipeline.process(i % 3 == 2 ? black_frame(i).view() : elsewhere.frame(3 * i).view());
    REQUIRE(run.last.state == RecoveryState::kLost);
    REQUIRE_FALSE(run.last.world_from_camera.has_value());
    REQUIRE(run.last.confidence == 0.0F);
    REQUIRE_FALSE(run.last.fused);
    REQUIRE_FALSE(run.last.trained);
    REQUIRE(run.last.relocaliser_asked == (i % 3 != 2));
  }
  REQUIRE(bytes_of(run.pipeline.volume()) == before);
  REQUIRE(run.oracle.trained.size() == num_trained);
}

/// The office's frame with the same depth everywhere.
RgbdFrame flat_frame(int index, float depth_m) {
  RgbdFrame frame = test::office().frame(index);
  std::fill_n(frame.depth.data(), frame.depth.size(), depth_m);
  return frame;
}

TEST_CASE("FusionPipeline: a frame without depth in range is a loss about which nobody is asked") {
  Followed run;
  run.answer(test::office().pose(kNumFollowed));
  for (const float depth_m : {0.0F, std::numeric_limits<float>::quiet_NaN(), 5.5F, 0.1F}) {
    run.last = run.pipeline.process(flat_frame(kNumFollowed, depth_m).view());
    CAPTURE(depth_m);
    REQUIRE(run.last.state == RecoveryState::kLost);
    REQUIRE_FALSE(run.last.relocaliser_asked);
  }
  REQUIRE(run.oracle.num_asked == 0);
  run.process(kNumFollowed);
  REQUIRE(run.oracle.num_asked == 1);
  REQUIRE(run.last.relocalised);
}

TEST_CASE("FusionPipeline: frames that do not start a map teach the relocaliser nothing") {
  OracleRelocaliser oracle;
  FusionPipeline pipeline(Context(), {}, &oracle);
  for (const float depth_m : {5.5F, 0.0F, 0.1F}) {
    const FusionFrameResult result = pipeline.process(flat_frame(0, depth_m).view());
    REQUIRE(result.state == RecoveryState::kLost);
    REQUIRE_FALSE(result.trained);
    REQUIRE_FALSE(result.fused);
  }
  REQUIRE(oracle.trained.empty());
  REQUIRE(pipeline.process(test::office().frame(0).view()).trained);
  REQUIRE(oracle.trained.size() == 1);
}

TEST_CASE("FusionPipeline: frames smaller than what is rendered of them count as lost ones, before and after the start") {
  OracleRelocaliser oracle;
  FusionPipeline pipeline(Context(), {}, &oracle);
  const auto process_small = [&] {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {3, 3}, {4, 4}, {640, 1}, {7, 480}}) {
      RgbdFrame small = test::office().frame(0);
      small.depth = Image<float>(width, height);
      small.colour = Image<Rgb8>(width, height);
      std::fill_n(small.depth.data(), small.depth.size(), 1.0F);
      const FusionFrameResult result = pipeline.process(small.view());
      CAPTURE(width, height);
      REQUIRE(result.state == RecoveryState::kLost);
      REQUIRE_FALSE(result.world_from_camera.has_value());
      REQUIRE_FALSE(result.relocaliser_asked);
    }
  };
  process_small();
  REQUIRE(pipeline.volume().num_blocks() == 0);
  pipeline.start_at(test::office().pose(0));
  for (int i = 0; i < kNumFollowed; ++i) pipeline.process(test::office().frame(i).view());
  REQUIRE(pipeline.state() == RecoveryState::kTracking);
  process_small();
  oracle.answers = {{test::office().pose(kNumFollowed), 0.9F}};
  REQUIRE(pipeline.process(test::office().frame(kNumFollowed).view()).relocalised);
}

TEST_CASE("FusionPipeline: a host's decimal commas change nothing") {
  FusionFrameResult with;
  {
    const test::CommaLocale commas;  // first: the classifiers are read once
    if (!commas.reached_c()) WARN("C's functions heed no decimal comma here: package locales is missing");
    with = Followed().last;
  }
  const FusionFrameResult without = Followed().last;
  REQUIRE(with.quality_score == without.quality_score);
  REQUIRE(with.confidence == without.confidence);
  REQUIRE(with.world_from_camera->translation == without.world_from_camera->translation);
}

TEST_CASE("FusionPipeline: recovers from a kidnap at once, and holds fusion back until tracking has settled") {
  Followed run;
  run.process(250);  // far away; the relocaliser knows nothing
  REQUIRE(run.last.state == RecoveryState::kLost);
  const std::string before = bytes_of(run.pipeline.volume());
  const int resumed = 10;
  run.answer(test::office().pose(resumed) * se3_exp((Tangent6() << 0.02F, -0.02F, 0.01F, 0.02F, 0.03F, -0.02F).finished()));
  run.process(resumed);
  REQUIRE(run.last.state == RecoveryState::kSettling);
  REQUIRE(run.last.relocalised);
  REQUIRE(translation_distance_m(*run.last.world_from_camera, test::office().pose(resumed)) < 0.01F);
  REQUIRE_FALSE(run.last.fused);
  const int hold = run.pipeline.settings().recovery.settle_frames;
  for (int i = 1; i <= hold; ++i) {
    run.answer(test::office().pose(resumed + i));
    run.process(resumed + i);
    CAPTURE(i, to_string(run.last.quality), run.last.quality_score, run.last.confidence, run.last.agreement.overlap,
            run.last.agreement.agreement);
    REQUIRE(run.last.state == RecoveryState::kSettling);
    REQUIRE_FALSE(run.last.fused);
    REQUIRE_FALSE(run.last.relocalised);
  }
  REQUIRE(bytes_of(run.pipeline.volume()) == before);
  for (int i = hold + 1; i < hold + 40 && run.last.state != RecoveryState::kTracking; ++i) {  // until views from new places confirm it
    REQUIRE_FALSE(run.last.fused);
    run.answer(test::office().pose(resumed + i));
    run.process(resumed + i);
  }
  REQUIRE(run.last.state == RecoveryState::kTracking);
  REQUIRE(run.last.fused);
  REQUIRE(run.last.trained);
  REQUIRE(bytes_of(run.pipeline.volume()) != before);
}

TEST_CASE("FusionPipeline: a blackout is a loss, and the last pose is tried again even without a relocaliser") {
  FusionPipeline pipeline(Context(), {}, nullptr);
  pipeline.start_at(test::office().pose(0));
  for (int i = 0; i < kNumFollowed; ++i) pipeline.process(test::office().frame(i).view());
  const std::string before = bytes_of(pipeline.volume());
  for (int i = 0; i < 3; ++i) REQUIRE(pipeline.process(black_frame(kNumFollowed).view()).state == RecoveryState::kLost);
  const FusionFrameResult result = pipeline.process(test::office().frame(kNumFollowed + 1).view());
  REQUIRE(result.state == RecoveryState::kSettling);
  REQUIRE_FALSE(result.relocaliser_asked);
  REQUIRE(translation_distance_m(*result.world_from_camera, test::office().pose(kNumFollowed + 1)) < 0.01F);
  REQUIRE(bytes_of(pipeline.volume()) == before);
}

TEST_CASE("FusionPipeline: a forced loss is one whatever the frame shows") {
  Followed run;
  run.answer(test::office().pose(kNumFollowed));
  run.pipeline.force_loss();
  run.process(kNumFollowed);
  REQUIRE(run.last.relocalised);
  REQUIRE(run.last.state == RecoveryState::kSettling);
  run.process(kNumFollowed + 1);
  REQUIRE_FALSE(run.last.relocalised);
}

TEST_CASE("FusionPipeline: a tracked pose that jumps is not believed: the relocaliser is asked, and views must confirm what it finds") {
  FusionSettings settings;
  settings.max_motion_m = 0.001F;
  OracleRelocaliser oracle;
  FusionPipeline pipeline(Context(), settings, &oracle);
  pipeline.start_at(test::office().pose(0));
  pipeline.process(test::office().frame(0).view());
  const RgbdFrame& next = test::office().frame(1);
  REQUIRE(translation_distance_m(*next.world_from_camera, test::office().pose(0)) > settings.max_motion_m);
  oracle.answers = {{*next.world_from_camera, 0.9F}};
  const FusionFrameResult result = pipeline.process(next.view());
  REQUIRE(oracle.num_asked == 1);
  REQUIRE(result.relocalised);
  REQUIRE(result.state == RecoveryState::kSettling);
  REQUIRE_FALSE(result.fused);
}

TEST_CASE("FusionPipeline: malformed frames count as lost ones, before and after the start") {
  OracleRelocaliser oracle;
  FusionPipeline pipeline(Context(), {}, &oracle);
  RgbdFrame malformed = test::office().frame(0);
  malformed.colour = Image<Rgb8>(8, 8);
  const RgbdFrame black = black_frame(0);
  for (const Frame& frame : {malformed.view(), Frame{}, black.view()}) {
    const FusionFrameResult result = pipeline.process(frame);
    REQUIRE(result.state == RecoveryState::kLost);
    REQUIRE_FALSE(result.world_from_camera.has_value());
    REQUIRE(pipeline.volume().num_blocks() == 0);
  }
  pipeline.start_at(test::office().pose(0));  // nothing has begun yet
  for (int i = 0; i < kNumFollowed; ++i) pipeline.process(test::office().frame(i).view());
  REQUIRE(pipeline.state() == RecoveryState::kTracking);
  const std::string before = bytes_of(pipeline.volume());
  for (const Frame& frame : {malformed.view(), Frame{}}) REQUIRE(pipeline.process(frame).state == RecoveryState::kLost);
  oracle.answers = {{test::office().pose(kNumFollowed), 0.9F}};
  REQUIRE(pipeline.process(test::office().frame(kNumFollowed).view()).state == RecoveryState::kSettling);
  REQUIRE(bytes_of(pipeline.volume()) == before);
}

TEST_CASE("FusionPipeline: bursts of depth noise are neither fused nor believed, and the next clean frame is followed") {
  Followed run;
  const std::string before = bytes_of(run.pipeline.volume());
  Random random(1, 0);
  for (int i = 0; i < 5; ++i) {
    RgbdFrame noisy = test::office().frame(kNumFollowed + i);
    for (std::size_t p = 0; p < noisy.depth.size(); ++p) noisy.depth.data()[p] = 0.5F + 3.5F * random.uniform();
    run.answer(test::office().pose(i));  // the relocaliser is taken in
    run.last = run.pipeline.process(noisy.view());
    REQUIRE(run.last.quality != TrackingQuality::kGood);
    REQUIRE_FALSE(run.last.fused);
  }
  REQUIRE(bytes_of(run.pipeline.volume()) == before);
  const int clean = kNumFollowed + 5;
  run.answer(test::office().pose(clean));
  run.process(clean);
  REQUIRE(run.last.world_from_camera.has_value());
  REQUIRE(translation_distance_m(*run.last.world_from_camera, test::office().pose(clean)) < 0.01F);
}

TEST_CASE("FusionPipeline: a frozen camera stands still") {
  Followed run;
  const SE3 stopped = *run.last.world_from_camera;
  for (int i = 0; i < 15; ++i) {
    run.process(kNumFollowed - 1);
    REQUIRE(run.last.state == RecoveryState::kTracking);
    REQUIRE(translation_distance_m(*run.last.world_from_camera, stopped) < 0.005F);
  }
}

/// A frame with every second pixel of every second row.
RgbdFrame halved(const RgbdFrame& frame) {
  RgbdFrame half = frame;
  half.depth = Image<float>(frame.depth.width() / 2, frame.depth.height() / 2);
  half.colour = Image<Rgb8>(frame.colour.width() / 2, frame.colour.height() / 2);
  for (int v = 0; v < half.depth.height(); ++v) {
    for (int u = 0; u < half.depth.width(); ++u) {
      half.depth(u, v) = frame.depth(2 * u, 2 * v);
      half.colour(u, v) = frame.colour(2 * u, 2 * v);
    }
  }
  half.calibration.depth = frame.calibration.depth.scaled(0.5F);
  half.calibration.colour = frame.calibration.colour.scaled(0.5F);
  return half;
}

TEST_CASE("FusionPipeline: a frame of another size gets the right pose or none, as do those behind it") {
  Followed run;
  for (int i = kNumFollowed; i < kNumFollowed + 6; ++i) {
    run.answer(test::office().pose(i));
    run.last = run.pipeline.process(i % 3 == 0 ? halved(test::office().frame(i)).view() : test::office().frame(i).view());
    if (run.last.world_from_camera.has_value()) {
      REQUIRE(translation_distance_m(*run.last.world_from_camera, test::office().pose(i)) < 0.015F);
    }
  }
  REQUIRE(run.last.world_from_camera.has_value());
}

TEST_CASE("FusionPipeline: a copy goes on by itself with another relocaliser") {
  Followed run;
  OracleRelocaliser other;
  FusionPipeline copy(run.pipeline, &other);
  const std::string before = bytes_of(run.pipeline.volume());
  const FusionFrameResult result = copy.process(test::office().frame(kNumFollowed).view());
  REQUIRE(result.fused);
  REQUIRE(other.trained.size() == 1);
  REQUIRE(run.oracle.trained.size() == kNumFollowed);
  REQUIRE(bytes_of(run.pipeline.volume()) == before);
  run.process(kNumFollowed);
  REQUIRE(bytes_of(run.pipeline.volume()) == bytes_of(copy.volume()));
  REQUIRE(run.last.world_from_camera->translation == result.world_from_camera->translation);
}

TEST_CASE("FusionPipeline: reset() forgets map, pose and state") {
  Followed run;
  run.process(250);
  run.pipeline.reset();
  REQUIRE(run.pipeline.volume().num_blocks() == 0);
  REQUIRE(run.pipeline.state() == RecoveryState::kTracking);
  REQUIRE(run.oracle.trained.empty());
  run.process(0);
  REQUIRE(run.last.state == RecoveryState::kTracking);
  REQUIRE(run.last.world_from_camera->translation.norm() == 0.0F);
}

TEST_CASE("FusionSettings: defaults validate, and nested settings are checked") {
  FusionSettings settings;
  REQUIRE_NOTHROW(settings.validate());
  settings.recovery.max_poor_frames = 0;
  REQUIRE_THROWS_AS(settings.validate(), InvalidSettings);
  REQUIRE_THROWS_AS(FusionPipeline(Context(), settings, nullptr), InvalidSettings);
}

TEST_CASE("FusionSettings: the range of depth is stated once, and everything heeds it") {
  const std::vector<SettingDescription> described = describe_settings(FusionSettings{});
  const auto num_named = std::count_if(described.begin(), described.end(),
                                       [](const SettingDescription& setting) { return setting.path.find("depth_m") != std::string::npos; });
  REQUIRE(num_named == 2);  // the nearest and the farthest
  REQUIRE(described.size() <= 24);
  const RgbdFrame& frame = test::office().frame(0);
  std::vector<float> depths_m(frame.depth.data(), frame.depth.data() + frame.depth.size());
  const auto farther = depths_m.begin() + static_cast<std::ptrdiff_t>(depths_m.size() / 10 * 9);
  std::nth_element(depths_m.begin(), farther, depths_m.end());
  FusionSettings settings;
  settings.volume.max_depth_m = *farther;  // a tenth is out of range
  FusionPipeline pipeline(Context(), settings, nullptr);
  pipeline.process(frame.view());
  const FusionFrameResult result = pipeline.process(frame.view());
  int num_in_range = 0;
  int num_measured = 0;
  for (int v = 2; v < frame.depth.height(); v += 4) {
    for (int u = 2; u < frame.depth.width(); u += 4) {
      num_in_range += settings.volume.depth_range().holds(frame.depth(u, v)) ? 1 : 0;
      num_measured += frame.depth(u, v) > 0.0F ? 1 : 0;
    }
  }
  REQUIRE(num_in_range < num_measured);
  REQUIRE(result.agreement.num_valid == num_in_range);
}

}  // namespace
}  // namespace foothold
