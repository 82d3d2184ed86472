// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_split.h"

#include <Eigen/Dense>
#include <numeric>
#include <vector>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

// Sums of squares in single precision over 256 examples, against an oracle in double precision.
constexpr double kScoreTolerance = 1e-4;

/// Examples with a few features of noise, in one scene unless stated.
struct SplitFixture {
  ForestExamples examples;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint8_t> unparted;
  ForestTrainingSettings settings;

  SplitFixture(std::size_t num_examples, std::size_t num_features, Random& random, bool paired = false) {
    examples.num_features = num_features;
    examples.paired = paired;
    examples.values.resize(num_examples * examples.row_size());
    for (std::int16_t& value : examples.values) value = static_cast<std::int16_t>(random.below(2001)) - 1000;
    for (std::size_t i = 0; i < num_examples; ++i)
      examples.points_world.emplace_back(random.uniform(-1.0F, 1.0F), random.uniform(-2.0F, 2.0F), random.uniform(0.0F, 3.0F));
    examples.scene_begins = {0, num_examples};
    indices.resize(num_examples);
    std::iota(indices.begin(), indices.end(), 0U);
    unparted.assign(paired ? num_examples : 0, 1);
  }

  NodeExamples node() const { return {examples, indices, unparted, 5}; }
  std::int16_t& value(std::size_t example, std::size_t feature) { return examples.values[example * examples.row_size() + feature]; }
  ScoredSplit best(int num_candidates = kSplitGroup) const {
    const NodeVariance variance = node_variance(node(), settings);
    ScoredSplit best;
    for (int first = 0; first < num_candidates; first += kSplitGroup) {
      const ScoredSplit split = best_split(node(), variance, settings, first, std::min(kSplitGroup, num_candidates - first));
      if (split.score > best.score) best = split;
    }
    return best;
  }
};

/// log|covariance + floor| over points of one scene; naive.
double naive_variance(const std::vector<Eigen::Vector3d>& points, double floor_m) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points) mean += point / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity() * floor_m * floor_m;
  for (const auto& point : points) covariance += (point - mean) * (point - mean).transpose() / static_cast<double>(points.size());
  return std::log(covariance.determinant());
}

/// The paper's information gain; naive.
double naive_gain(const SplitFixture& fixture, const ForestSplit& split) {
  std::vector<Eigen::Vector3d> all;
  std::vector<Eigen::Vector3d> sides[2];
  for (const std::uint32_t example : fixture.indices) {
    const Eigen::Vector3d point = fixture.examples.points_world[example].cast<double>();
    all.push_back(point);
    sides[fixture.examples.row(example)[split.feature] >= split.threshold ? 1 : 0].push_back(point);
  }
  const auto floor_m = static_cast<double>(fixture.settings.covariance_floor_m);
  double gain = naive_variance(all, floor_m);
  for (const auto& side : sides) {
    if (!side.empty()) gain -= static_cast<double>(side.size()) / static_cast<double>(all.size()) * naive_variance(side, floor_m);
  }
  return gain;
}

}  // namespace

TEST_CASE("best_split: its score is the paper's information gain, and the largest of the candidates'") {
  Random random = test::test_random();
  SplitFixture fixture(700, 6, random);
  for (std::size_t i = 0; i < 700; ++i) fixture.value(i, 2) = static_cast<std::int16_t>(300.0F * fixture.examples.points_world[i].y());
  const NodeVariance variance = node_variance(fixture.node(), fixture.settings);
  double largest = 0.0;
  for (int c = 0; c < kSplitGroup; ++c) {
    const ScoredSplit single = best_split(fixture.node(), variance, fixture.settings, c, 1);
    if (single.score <= 0.0) continue;
    CHECK(single.score == Approx(naive_gain(fixture, single.split)).margin(kScoreTolerance));
    largest = std::max(largest, single.score);
  }
  CHECK(fixture.best().score == largest);
}

TEST_CASE("best_split: finds the feature that separates two clusters purely") {
  Random random = test::test_random();
  SplitFixture fixture(2000, 32, random);
  for (std::size_t i = 0; i < 2000; ++i) {
    const bool right = random.below(2) == 1;
    fixture.value(i, 19) = static_cast<std::int16_t>(right ? 500 : 0);
    fixture.examples.points_world[i] = Eigen::Vector3f(right ? 4.0F : 0.0F, 0.0F, 0.0F) + 0.1F * fixture.examples.points_world[i];
  }
  const ScoredSplit best = fixture.best(512);
  CHECK(best.split.feature == 19);
  for (std::size_t i = 0; i < 2000; ++i) {
    const bool goes_right = fixture.value(i, 19) >= best.split.threshold;
    CHECK(goes_right == (fixture.examples.points_world[i].x() > 2.0F));
  }
  CHECK(best.score > 1.0);
}

TEST_CASE("best_split: moving a scene to other coordinates changes nothing") {
  Random random = test::test_random();
  SplitFixture fixture(900, 16, random);
  fixture.examples.scene_begins = {0, 300, 900};
  const ScoredSplit before = fixture.best(64);
  const NodeVariance variance_before = node_variance(fixture.node(), fixture.settings);
  for (std::size_t i = 300; i < 900; ++i) fixture.examples.points_world[i] += Eigen::Vector3f(64.0F, -32.0F, 16.0F);
  const ScoredSplit after = fixture.best(64);
  CHECK(after.split.feature == before.split.feature);
  CHECK(after.split.threshold == before.split.threshold);
  CHECK(after.score == Approx(before.score).margin(kScoreTolerance));
  CHECK(node_variance(fixture.node(), fixture.settings).log_determinant == Approx(variance_before.log_determinant).margin(kScoreTolerance));
}

TEST_CASE("best_split: keeps the smallest numbers of examples on each side") {
  Random random = test::test_random();
  SplitFixture fixture(1000, 8, random);
  fixture.settings.min_child_fraction = 0.4F;
  const ScoredSplit best = fixture.best(512);
  REQUIRE(best.score > 0.0);
  int num_right = 0;
  for (std::size_t i = 0; i < 1000; ++i) num_right += fixture.value(i, best.split.feature) >= best.split.threshold ? 1 : 0;
  CHECK(num_right >= 400);
  CHECK(num_right <= 600);
  fixture.settings.min_child_fraction = 0.0F;
  fixture.settings.min_leaf_examples = 501;
  CHECK(fixture.best(512).score == 0.0);
}

TEST_CASE("best_split: equal examples cannot be split") {
  Random random = test::test_random();
  SplitFixture fixture(50, 4, random);
  std::fill(fixture.examples.values.begin(), fixture.examples.values.end(), std::int16_t{3});
  CHECK(fixture.best(128).score == 0.0);
}

TEST_CASE("best_split: points in one place give no reason to split") {
  Random random = test::test_random();
  SplitFixture fixture(50, 4, random);
  std::fill(fixture.examples.points_world.begin(), fixture.examples.points_world.end(), Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  CHECK(fixture.best(128).score < kScoreTolerance);
}

TEST_CASE("best_split: asked for agreement, takes the feature on which two views of a point agree, split in the middle") {
  Random random = test::test_random();
  SplitFixture fixture(3000, 10, random, true);
  fixture.settings.variance_weight = 0.0F;
  fixture.settings.agreement_weight = 1.0F;
  for (std::size_t i = 0; i < 3000; ++i) fixture.value(i, 10 + 6) = fixture.value(i, 6);
  const ScoredSplit best = fixture.best(2048);
  CHECK(best.split.feature == 6);
  CHECK(std::abs(best.split.threshold) < 100);
  CHECK(best.score == Approx(std::log(2.0)).margin(0.01));
  SECTION("pairs that parted before do not count") {
    std::fill(fixture.unparted.begin(), fixture.unparted.end(), std::uint8_t{0});
    CHECK(fixture.best(2048).score == 0.0);
  }
}

}  // namespace foothold
