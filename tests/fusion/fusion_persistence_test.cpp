// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Reconstructions that are saved and go on in another process.
#include <sstream>
#include <string>

#include "foothold/base/checked_stream.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "fusion/scene.h"
#include "support/catch.h"
#include "support/mend_checksums.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using Catch::Matchers::Contains;
using test::Scene;

/// Knows the pose of every frame, shifted a little, as a relocaliser that has seen the scene would.
class KnowingRelocaliser : public Relocaliser {
 public:
  explicit KnowingRelocaliser(const SE3& world_from_camera) : place(world_from_camera) {}
  void train(const Frame&, const SE3&) override { ++num_trained; }
  std::vector<PoseEstimate> relocalise(const Frame&) override {
    PoseEstimate estimate{place, 0.9F};
    estimate.world_from_camera.translation += Eigen::Vector3f(0.02F, -0.01F, 0.01F);
    return {estimate};
  }
  void update() override {}
  void reset() override {}
  std::size_t state_bytes() const override { return 0; }
  float acceptance_threshold() const override { return 0.5F; }

  SE3 place;
  int num_trained = 0;
};

FusionSettings coarse_settings() {
  FusionSettings settings;
  settings.volume.voxel_size_m = 0.02F;
  settings.volume.truncation_m = 0.08F;
  return settings;
}

/// A pipeline that has seen the scene from along the arc.
FusionPipeline arc_pipeline(const Context& context, const FusionSettings& settings, int num_frames = 5) {
  FusionPipeline pipeline(context, settings, nullptr);
  pipeline.start_at(test::pose_on_arc(0.0F));
  for (int i = 0; i < num_frames; ++i) {
    const RgbdFrame frame = test::render(Scene{}, test::pose_on_arc(0.02F * static_cast<float>(i)));
    REQUIRE(pipeline.process(frame.view()).world_from_camera.has_value());
  }
  return pipeline;
}

std::string bytes_of(const FusionPipeline& pipeline) {
  std::ostringstream stream;
  pipeline.save(stream);
  return stream.str();
}

std::string refusal(FusionPipeline& pipeline, const std::string& bytes) {
  std::istringstream stream(bytes);
  try {
    pipeline.load(stream);
  } catch (const FileError& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST_CASE("FusionPipeline: a loaded reconstruction is lost, and goes on once the relocaliser finds the camera") {
  const Context context;
  const std::string saved = bytes_of(arc_pipeline(context, coarse_settings()));
  const SE3 place = test::pose_on_arc(0.1F);
  KnowingRelocaliser relocaliser(place);
  FusionPipeline loaded(context, coarse_settings(), &relocaliser);
  std::istringstream stream(saved);
  loaded.load(stream);
  CHECK(loaded.state() == RecoveryState::kLost);
  CHECK(bytes_of(loaded) == saved);

  const RgbdFrame frame = test::render(Scene{}, place);
  FusionFrameResult result = loaded.process(frame.view());
  REQUIRE(result.relocalised);
  REQUIRE(result.world_from_camera.has_value());
  constexpr float kVoxel_m = 0.02F;
  CHECK(translation_distance_m(*result.world_from_camera, place) < kVoxel_m);
  for (int i = 1; i < 40 && result.state != RecoveryState::kTracking; ++i) {  // the camera moves on, which confirms the pose
    const SE3 next = test::pose_on_arc(0.1F + 0.015F * static_cast<float>(i));
    relocaliser.place = next;
    result = loaded.process(test::render(Scene{}, next).view());
  }
  CHECK(result.state == RecoveryState::kTracking);
  CHECK(relocaliser.num_trained > 0);
}

TEST_CASE("FusionPipeline: a reconstruction without frames is loaded as such") {
  const Context context;
  FusionPipeline empty(context, coarse_settings(), nullptr);
  FusionPipeline pipeline = arc_pipeline(context, coarse_settings());
  REQUIRE(refusal(pipeline, bytes_of(empty)) == "(accepted)");
  CHECK(pipeline.state() == RecoveryState::kTracking);
  CHECK(pipeline.volume().num_blocks() == 0);
  const RgbdFrame frame = test::render(Scene{}, test::pose_on_arc(0.0F));
  CHECK(pipeline.process(frame.view()).fused);
}

TEST_CASE("FusionPipeline: a map made with other settings is refused with the setting's name and both values") {
  const Context context;
  FusionSettings other = coarse_settings();
  other.volume.voxel_size_m = 0.025F;
  const std::string saved = bytes_of(arc_pipeline(context, other, 1));
  FusionPipeline pipeline = arc_pipeline(context, coarse_settings(), 1);
  const std::string before = bytes_of(pipeline);
  CHECK_THAT(refusal(pipeline, saved), Contains("voxel_size_m = 0.025, expected 0.02"));
  CHECK(bytes_of(pipeline) == before);
  CHECK(pipeline.state() == RecoveryState::kTracking);
}

TEST_CASE("FusionPipeline: damaged reconstructions are refused and the former one stays") {
  const Context context;
  FusionPipeline pipeline = arc_pipeline(context, coarse_settings(), 2);
  const std::string before = bytes_of(pipeline);
  const std::string good = bytes_of(arc_pipeline(context, coarse_settings(), 1));
  const auto check_refused = [&](const std::string& bytes) {
    CHECK(refusal(pipeline, bytes) != "(accepted)");
    REQUIRE(bytes_of(pipeline) == before);
  };
  check_refused("");
  CHECK_THAT(refusal(pipeline, std::string(200, 'x')), Contains("not a reconstruction of Foothold"));
  std::string other_version = good;
  other_version[8] = 9;
  CHECK_THAT(refusal(pipeline, other_version), Contains("a reconstruction of version 9, expected version 2"));
  Random random = test::test_random();
  for (std::size_t place = 0; place < checked_size(49); ++place) {  // the head
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ static_cast<char>(1U << random.below(8)));
    check_refused(bad);
  }
  for (int i = 0; i < 10; ++i) check_refused(good.substr(0, random.below(static_cast<std::uint32_t>(good.size()))));
}

TEST_CASE("FusionPipeline: load throws FileError alone, though the stream's exceptions are on") {
  const Context context;
  FusionPipeline pipeline = arc_pipeline(context, coarse_settings(), 1);
  const std::string good = bytes_of(pipeline);
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 2) {
    std::istringstream stream(good.substr(0, length));
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    REQUIRE_THROWS_AS(pipeline.load(stream), FileError);
  }
}

TEST_CASE("FusionPipeline: a map in a reconstruction that has not begun, and two blocks of one place, are refused") {
  const Context context;
  FusionPipeline pipeline = arc_pipeline(context, coarse_settings(), 1);
  constexpr std::size_t kStarted = 16;
  std::string bad = bytes_of(pipeline);
  REQUIRE(bad[kStarted] == 1);
  bad[kStarted] = 0;
  CHECK_THAT(refusal(pipeline, test::with_right_checksums(bad)), Contains("has not begun, but has a map of"));

  const std::size_t map = checked_size(49);
  constexpr std::size_t kKeys = 16 + 32;
  bad = bytes_of(pipeline);
  bad.replace(map + kKeys + 8, 8, bad.substr(map + kKeys, 8));
  std::size_t place = map;
  test::mend_checksums(bad, place);
  REQUIRE(place == bad.size());
  CHECK_THAT(refusal(pipeline, bad), Contains("map: has two blocks of key"));
}

}  // namespace
}  // namespace foothold
