// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/keyframe_relocaliser.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "foothold/base/error.h"
#include "foothold/base/settings.h"
#include "keyframe/fern_encoder.h"
#include "relocalisation/relief.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/logged_warnings.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::random_relief;

/// Frames of constant colour with their poses.
struct Fixture {
  explicit Fixture(const KeyframeRelocaliserSettings& settings = {}) : relocaliser(Context(ContextOptions{}), settings) {}

  Frame frame(const Image<float>& depth) {
    colour = Image<Rgb8>(depth.width(), depth.height());
    Frame result;
    result.depth = depth.view();
    result.colour = colour_view(colour);
    result.calibration.depth = result.calibration.colour = {585.0F, 585.0F, 320.0F, 240.0F};
    return result;
  }
  static SE3 pose(float x_m) {
    SE3 result;
    result.translation.x() = x_m;
    return result;
  }

  /// Learns random reliefs, relief i from pose(i).
  std::vector<Image<float>> train_reliefs(Random& random, int count) {
    std::vector<Image<float>> reliefs;
    for (int i = 0; i < count; ++i) {
      reliefs.push_back(random_relief(random, 640, 480));
      relocaliser.train(frame(reliefs.back()), pose(static_cast<float>(i)));
    }
    return reliefs;
  }

  Image<Rgb8> colour;
  KeyframeRelocaliser relocaliser;
};

TEST_CASE("KeyframeRelocaliser: proposes the pose of the most similar keyframe") {
  Random random = test::test_random();
  Fixture fixture;
  const std::vector<Image<float>> reliefs = fixture.train_reliefs(random, 8);
  REQUIRE(fixture.relocaliser.num_keyframes() == 8);
  for (int i = 0; i < 8; ++i) {
    Image<float> noisy = reliefs[static_cast<std::size_t>(i)];
    for (std::size_t k = 0; k < noisy.size(); ++k) noisy.data()[k] *= random.uniform(0.97F, 1.03F);
    const auto estimates = fixture.relocaliser.relocalise(fixture.frame(noisy));
    REQUIRE(estimates.size() == 1);
    REQUIRE(estimates[0].world_from_camera.translation.x() == static_cast<float>(i));
    REQUIRE(estimates[0].confidence >= fixture.relocaliser.acceptance_threshold());
  }
  const auto stranger = fixture.relocaliser.relocalise(fixture.frame(random_relief(random, 640, 480)));
  REQUIRE(stranger.size() == 1);
  REQUIRE(stranger[0].confidence < fixture.relocaliser.acceptance_threshold());
}

TEST_CASE("KeyframeRelocaliser: keeps a frame only if no keyframe resembles it") {
  Random random = test::test_random();
  Fixture fixture;
  const Image<float> relief = random_relief(random, 640, 480);
  fixture.relocaliser.train(fixture.frame(relief), Fixture::pose(1.0F));
  fixture.relocaliser.train(fixture.frame(relief), Fixture::pose(2.0F));
  REQUIRE(fixture.relocaliser.num_keyframes() == 1);

  KeyframeRelocaliserSettings settings;
  settings.harvest_dissimilarity = 0.0F;
  settings.max_keyframes = 3;
  Fixture greedy(settings);
  for (int i = 0; i < 5; ++i) greedy.relocaliser.train(greedy.frame(relief), Fixture::pose(static_cast<float>(i)));
  REQUIRE(greedy.relocaliser.num_keyframes() == 3);
}

TEST_CASE("KeyframeRelocaliser: warns once that there is no room for a keyframe, and names the setting") {
  Random random = test::test_random();
  test::LoggedWarnings log;
  KeyframeRelocaliserSettings settings;
  settings.max_keyframes = 1;
  Fixture fixture;
  KeyframeRelocaliser relocaliser(log.context(), settings);
  const Image<float> relief = random_relief(random, 640, 480);
  relocaliser.train(fixture.frame(relief), SE3{});
  relocaliser.train(fixture.frame(relief), SE3{});
  REQUIRE(log.warnings.empty());  // the same again would be no keyframe
  for (int i = 0; i < 2; ++i) relocaliser.train(fixture.frame(random_relief(random, 640, 480)), SE3{});
  REQUIRE(log.warnings.size() == 1);
  REQUIRE(test::contains(log.warnings[0], "max_keyframes = 1 are there"));
  REQUIRE(relocaliser.num_keyframes() == 1);
}

TEST_CASE("KeyframeRelocaliser: orders further candidates by similarity") {
  Random random = test::test_random();
  KeyframeRelocaliserSettings settings;
  settings.num_candidates = 3;
  Fixture fixture(settings);
  const Image<float> relief = random_relief(random, 640, 480);
  for (const float offset_m : {0.9F, 0.0F, 0.5F, 1.4F}) {
    Image<float> further = relief;
    for (std::size_t i = 0; i < further.size(); ++i) further.data()[i] += offset_m;
    fixture.relocaliser.train(fixture.frame(further), Fixture::pose(offset_m));
  }
  const auto estimates = fixture.relocaliser.relocalise(fixture.frame(relief));
  REQUIRE(estimates.size() == 3);
  REQUIRE(estimates[0].world_from_camera.translation.x() == 0.0F);
  REQUIRE(estimates[1].world_from_camera.translation.x() == 0.5F);
  REQUIRE(estimates[2].world_from_camera.translation.x() == 0.9F);
  REQUIRE(estimates[0].confidence > estimates[1].confidence);
  REQUIRE(estimates[1].confidence > estimates[2].confidence);
}

TEST_CASE("KeyframeRelocaliser: knows nothing before training, and nothing from blank depth") {
  Random random = test::test_random();
  Fixture fixture;
  const Image<float> relief = random_relief(random, 640, 480);
  REQUIRE(fixture.relocaliser.relocalise(fixture.frame(relief)).empty());
  for (const float hole : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Image<float> blank(640, 480, hole);
    fixture.relocaliser.train(fixture.frame(blank), SE3{});
    REQUIRE(fixture.relocaliser.num_keyframes() == 0);
    REQUIRE(fixture.relocaliser.state_bytes() == 0);
  }
  fixture.relocaliser.train(fixture.frame(relief), SE3{});
  REQUIRE(fixture.relocaliser.relocalise(fixture.frame(Image<float>(640, 480, 0.0F))).empty());
}

TEST_CASE("KeyframeRelocaliser: reset forgets the scene and its memory") {
  Random random = test::test_random();
  Fixture fixture;
  const Image<float> relief = random_relief(random, 640, 480);
  fixture.relocaliser.train(fixture.frame(relief), SE3{});
  REQUIRE(fixture.relocaliser.state_bytes() >= 256 + sizeof(SE3));
  fixture.relocaliser.reset();
  REQUIRE(fixture.relocaliser.state_bytes() == 0);
  REQUIRE(fixture.relocaliser.relocalise(fixture.frame(relief)).empty());
}

TEST_CASE("KeyframeRelocaliser: a copy goes its own way") {
  Random random = test::test_random();
  Fixture fixture;
  fixture.relocaliser.train(fixture.frame(random_relief(random, 640, 480)), SE3{});
  KeyframeRelocaliser copy = fixture.relocaliser;
  copy.train(fixture.frame(random_relief(random, 640, 480)), SE3{});
  REQUIRE(copy.num_keyframes() == 2);
  REQUIRE(fixture.relocaliser.num_keyframes() == 1);
  fixture.relocaliser = copy;
  REQUIRE(fixture.relocaliser.num_keyframes() == 2);
}

TEST_CASE("KeyframeRelocaliser: a saved scene reads back alike") {
  Random random = test::test_random();
  Fixture fixture;
  const std::vector<Image<float>> reliefs = fixture.train_reliefs(random, 5);
  std::stringstream stream;
  fixture.relocaliser.save(stream);
  Fixture restored;
  restored.relocaliser.load(stream);
  REQUIRE(restored.relocaliser.num_keyframes() == 5);
  for (const Image<float>& relief : reliefs) {
    const auto before = fixture.relocaliser.relocalise(fixture.frame(relief));
    const auto after = restored.relocaliser.relocalise(restored.frame(relief));
    REQUIRE(before[0].world_from_camera.translation == after[0].world_from_camera.translation);
    REQUIRE(before[0].confidence == after[0].confidence);
  }
}

TEST_CASE("KeyframeRelocaliser: refuses a damaged scene and keeps its own") {
  Random random = test::test_random();
  Fixture fixture;
  fixture.relocaliser.train(fixture.frame(random_relief(random, 640, 480)), SE3{});
  std::stringstream stream;
  fixture.relocaliser.save(stream);
  const std::string good = stream.str();
  for (std::size_t position = 0; position < good.size(); ++position) {
    std::string flipped = good;
    flipped[position] = static_cast<char>(flipped[position] ^ 0x40);
    std::istringstream damaged(flipped);
    REQUIRE_THROWS_AS(fixture.relocaliser.load(damaged), FileError);
    std::istringstream truncated(good.substr(0, position));
    REQUIRE_THROWS_AS(fixture.relocaliser.load(truncated), FileError);
    REQUIRE(fixture.relocaliser.num_keyframes() == 1);
  }
}

TEST_CASE("KeyframeRelocaliser: refuses a scene of other ferns, and a stream that cannot be written") {
  KeyframeRelocaliserSettings settings;
  settings.seed = 7;
  Fixture other(settings);
  std::stringstream stream;
  other.relocaliser.save(stream);
  Fixture fixture;
  const std::string message = test::error_message<FileError>([&] { fixture.relocaliser.load(stream); });
  REQUIRE(test::contains(message, "seed 7"));
  REQUIRE(test::contains(message, "seed 42"));
  std::ostringstream closed;
  closed.setstate(std::ios::badbit);
  REQUIRE_THROWS_AS(fixture.relocaliser.save(closed), FileError);
}

TEST_CASE("KeyframeRelocaliserSettings: the defaults are the published ones, and bad values are refused") {
  const KeyframeRelocaliserSettings settings;
  REQUIRE_NOTHROW(settings.validate());
  REQUIRE(settings.num_ferns == 500);
  REQUIRE(settings.encoded_width_px == 40);
  REQUIRE(settings.smoothing_sigma_px == 2.5F);
  REQUIRE(settings.harvest_dissimilarity == 0.2F);
  REQUIRE(settings.num_candidates == 1);
  KeyframeRelocaliserSettings bad;
  bad.num_ferns = 0;
  REQUIRE_THROWS_AS(Fixture(bad), InvalidSettings);
  bad = {};
  bad.min_threshold_m = bad.max_threshold_m;
  REQUIRE_THROWS_AS(bad.validate(), InvalidSettings);
}

TEST_CASE("KeyframeRelocaliser: rejects callers' mistakes") {
  Fixture fixture;
  const Image<float> depth(640, 480, 1.0F);
  Frame frame = fixture.frame(depth);
  SE3 sheared;
  sheared.rotation(0, 1) = 0.1F;
  REQUIRE_THROWS_AS(fixture.relocaliser.train(frame, sheared), ContractViolation);
  frame.colour.width = 320;
  REQUIRE_THROWS_AS(fixture.relocaliser.relocalise(frame), ContractViolation);
}

}  // namespace
}  // namespace foothold
