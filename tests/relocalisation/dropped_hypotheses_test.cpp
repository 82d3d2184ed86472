// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <vector>

#include "foothold/base/trace.h"
#include "pose/hypothesis_kernels.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

SE3 turned_and_moved(float angle_rad, float distance_m) {
  Tangent6 twist = Tangent6::Zero();
  twist[1] = angle_rad;
  SE3 pose = se3_exp(twist);
  pose.translation.x() += distance_m;
  return pose;
}

TEST_CASE("DropRepeats: of hypotheses that are near in place and in rotation, the first alone does not fail") {
  constexpr float kDistanceM = 0.1F;
  constexpr float kAngleRad = 0.1F;
  std::vector<SE3> poses = {turned_and_moved(0.0F, 0.0F),  turned_and_moved(0.0F, 0.09F), turned_and_moved(0.0F, 0.11F),
                            turned_and_moved(0.09F, 0.0F), turned_and_moved(0.2F, 0.0F),  turned_and_moved(0.2F, 0.01F)};
  std::vector<float> energies(poses.size(), 1.0F);
  std::vector<std::uint64_t> order = {1, 0, 2, 3, 4, 5};  // hypothesis 1 is the better of the first two
  const DropRepeats body{{poses.data(), energies.data(), order.data()}, kDistanceM, kAngleRad};
  for (std::size_t slot = 0; slot < order.size(); ++slot) body(slot);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (energies[i] < kFailedEnergy) left.push_back(i);
  }
  // 2 is near 1, and 3 near 0, which has failed itself; 4 is turned too far from all before it, and 5 near 4.
  CHECK(left == std::vector<std::size_t>{1, 4});
}

TEST_CASE("GiveUpHopeless: gives up if hardly any sample that the best hypothesis was scored by is near a mode") {
  constexpr float kTruncation = 3.0F;
  std::vector<SE3> poses(2);
  std::vector<std::uint64_t> order = {1, 0};  // hypothesis 1 is the best
  const auto gives_up = [&](std::uint32_t num_pixels, float mean_energy) {
    std::vector<float> energies = {kFailedEnergy, mean_energy * static_cast<float>(std::min(num_pixels, std::uint32_t{kCullSamples}))};
    CorrespondencePoolView pool;
    pool.num_pixels = &num_pixels;
    std::int32_t given_up = 7;
    GiveUpHopeless{pool, kTruncation, {poses.data(), energies.data(), order.data()}, &given_up}(0);
    return given_up;
  };
  for (const std::uint32_t num_pixels : {40U, 500U, 4000U}) {  // as many as there are, or kCullSamples
    INFO(num_pixels);
    CHECK(gives_up(num_pixels, 2.9F) == 0);
    CHECK(gives_up(num_pixels, 2.99F) == 1);
  }
}

int count_stages(const Trace& trace, const char* stage) {
  const auto found = trace.stages().find(stage);
  return found == trace.stages().end() ? 0 : static_cast<int>(found->second.size());
}

/// Whether a view's best hypothesis was refined, wherever and however it was looked for.
bool is_refined(const Frame& frame) {
  Trace trace;
  ContextOptions options;
  options.num_threads = 1;
  options.trace = &trace;
  ForestRelocaliser relocaliser(Context(options), test::small_forest(), test::small_settings());
  test::train_on(relocaliser, test::office().size());
  relocaliser.relocalise(frame);
  REQUIRE(count_stages(trace, "relocalise/trial") + count_stages(trace, "relocalise/hypotheses") > 0);
  return count_stages(trace, "relocalise/refine") > 0;
}

TEST_CASE("ForestRelocaliser: views of an unknown room are given up before they are refined, views of the room are not") {
  const auto elsewhere =
      make_synthetic_sequence(parse_synthetic_spec("synthetic:training-101?frames=5&width=320&height=240"), test::context_of(1));
  int num_refined = 0;
  for (int i = 0; i < elsewhere->num_frames(); ++i) num_refined += is_refined(elsewhere->load(i).view()) ? 1 : 0;
  CHECK(num_refined <= 1);
  for (std::size_t i = 1; i < test::office().size(); i += 10) CHECK(is_refined(test::office()[i].view()));
}

}  // namespace
}  // namespace foothold
