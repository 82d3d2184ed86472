// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/novelty.h"

#include <cmath>
#include <utility>

#include "fakes.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/train_test.h"
#include "support/catch.h"
#include "support/random_motion.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

SE3 random_pose(Random& random) { return test::random_motion(random, 0.4F, 0.4F); }

/// The definition, bin by bin.
std::size_t naive_bin(const SE3& tested, const std::vector<SE3>& trained) {
  for (std::size_t bin = 0; bin < 10; ++bin) {
    const double metres = 0.05 * static_cast<double>(bin + 1);
    const double degrees = 5.0 * static_cast<double>(bin + 1);
    for (const SE3& pose : trained) {
      if ((tested.translation - pose.translation).norm() <= metres && rotation_distance_rad(tested, pose) * 57.29577951 <= degrees)
        return bin;
    }
  }
  return 10;
}

TEST_CASE("novelty_bin_of: is the first bin within both of whose limits some training pose lies") {
  Random random = test::test_random();
  int num_used[11] = {};
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<SE3> trained;
    for (std::uint32_t i = 0; i < 1 + random.below(8); ++i) trained.push_back(random_pose(random));
    const SE3 tested = random_pose(random);
    const std::size_t bin = novelty_bin_of(tested, trained);
    REQUIRE(bin == naive_bin(tested, trained));
    ++num_used[bin];
  }
  REQUIRE(num_used[5] > 0);
  REQUIRE(num_used[10] > 0);
}

TEST_CASE("novelty_bin_of: near in place but turned away is as novel as its worse half, and one pose must satisfy both") {
  SE3 turned = se3_exp((Tangent6() << 0, 0.3F, 0, 0, 0, 0).finished());  // 17.2 deg
  REQUIRE(novelty_bin_of(SE3{}, std::vector<SE3>{turned}) == 3);
  SE3 distant;
  distant.translation.x() = 0.42F;
  REQUIRE(novelty_bin_of(SE3{}, std::vector<SE3>{turned, distant}) == 3);
  REQUIRE(novelty_bin_of(SE3{}, std::vector<SE3>{distant}) == 8);
  REQUIRE(novelty_bin_of(SE3{}, Span<const SE3>()) == 10);
}

TEST_CASE("novelty_bins: hold every test once, with its outcome") {
  test::Oracle oracle;
  oracle.answers = {{0.0F, 1.0F}, {1.0F, 1.0F}};
  // Frames are 2 cm apart: training ends at frame 9, so test frame 9 + k is 2k cm away.
  const RunLog log = run_train_test(oracle, {test::make_input(0, 10)}, {test::make_input(10, 50)}, 0);
  const std::vector<NoveltyBin> bins = novelty_bins(log);
  REQUIRE(bins.size() == 11);
  REQUIRE(bins.front().key() == "5cm_5deg");
  REQUIRE(bins.back().key() == "rest");
  REQUIRE(bins[0].num_frames == 2);    // 2, 4 cm
  REQUIRE(bins[1].num_frames == 3);    // 6, 8, 10 cm
  REQUIRE(bins[10].num_frames == 15);  // 52 .. 80 cm
  int num_frames = 0;
  int num_found = 0;
  for (const NoveltyBin& bin : bins) {
    num_frames += bin.num_frames;
    num_found += bin.num_found;
  }
  REQUIRE(num_frames == 40);
  REQUIRE(num_found == 20);
}

/// Bins with the given numbers of frames and found frames, the last one the rest.
std::vector<NoveltyBin> bins_of(const std::vector<std::pair<int, int>>& counts) {
  std::vector<NoveltyBin> bins(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    bins[i].num_frames = counts[i].first;
    bins[i].num_found = counts[i].second;
    bins[i].is_rest = i + 1 == counts.size();
  }
  return bins;
}

TEST_CASE("merge_novelty_bins: adds frames and successes bin by bin, with intervals of the sums") {
  const std::vector<NoveltyBin> sum = merge_novelty_bins({bins_of({{4, 1}, {0, 0}, {3, 3}}), bins_of({{6, 4}, {2, 1}, {0, 0}})});
  REQUIRE(sum.size() == 3);
  REQUIRE(sum[0].num_frames == 10);
  REQUIRE(sum[0].num_found == 5);
  REQUIRE(sum[1].num_frames == 2);
  REQUIRE(sum[2].num_found == 3);
  const Interval expected = wilson_interval(5, 10);
  REQUIRE(sum[0].recall_95.low == expected.low);
  REQUIRE(sum[0].recall_95.high == expected.high);
  REQUIRE_THROWS_AS(merge_novelty_bins({}), ContractViolation);
  REQUIRE_THROWS_AS(merge_novelty_bins({bins_of({{1, 0}}), bins_of({{1, 0}, {1, 0}})}), ContractViolation);
}

TEST_CASE("novelty_area: is the mean recall of limited bins that hold frames") {
  REQUIRE(novelty_area(bins_of({{4, 4}, {2, 1}, {10, 0}})) == 0.75);
  REQUIRE(novelty_area(bins_of({{4, 1}, {0, 0}, {10, 10}})) == 0.25);
  REQUIRE(std::isnan(novelty_area(bins_of({{0, 0}, {5, 5}}))));
}

}  // namespace
}  // namespace foothold
