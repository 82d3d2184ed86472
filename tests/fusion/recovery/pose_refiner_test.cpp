// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/pose_refiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "foothold/base/error.h"
#include "foothold/fusion/refining_relocaliser.h"
#include "fusion/room_recording.h"
#include "fusion/scene.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

constexpr int kLastMapped = 60;
constexpr int kMapStride = 4;
constexpr int kSeen = 30;  ///< a frame between those in the map
/// Alignment with a map of noisy depth and exact poses ends nearer than this; half a voxel.
constexpr float kFineM = 0.005F;
constexpr float kFineRad = 0.004F;

const TsdfVolume& office_map() {
  static const TsdfVolume volume = test::office().fused(Context(), 0, kLastMapped, kMapStride);
  return volume;
}

PoseEstimate proposal(const SE3& world_from_camera) { return {world_from_camera, 0.5F}; }

TEST_CASE("PoseRefiner: mends poses that are a hand's breadth off, and accepts them") {
  PoseRefiner refiner(office_map().context());
  Random random = test::test_random();
  const RgbdFrame& frame = test::office().frame(kSeen + 1);
  const SE3& truth = *frame.world_from_camera;
  for (int i = 0; i < 8; ++i) {
    const std::vector<PoseEstimate> proposals = {proposal(truth * test::random_motion(random, 0.05F, 0.05F))};
    const std::vector<RefinedPose> refined = refiner.refine(frame.view(), office_map(), proposals);
    REQUIRE(refined.size() == 1);
    REQUIRE(refined.front().accepted);
    REQUIRE(refined.front().probability >= refiner.acceptance_probability());
    REQUIRE(refined.front().candidate == 0);
    REQUIRE(translation_distance_m(refined.front().world_from_camera, truth) < kFineM);
    REQUIRE(rotation_distance_rad(refined.front().world_from_camera, truth) < kFineRad);
  }
}

TEST_CASE("PoseRefiner: finds the right candidate behind wrong ones, and refuses wrong ones alone") {
  PoseRefiner refiner(office_map().context());
  Random random = test::test_random();
  const RgbdFrame& frame = test::office().frame(kSeen + 1);
  const SE3& truth = *frame.world_from_camera;
  std::vector<PoseEstimate> wrong;
  for (int i = 0; i < 12; ++i) {
    SE3 pose = truth * test::random_motion(random, 0.8F, 0.8F);
    pose.translation += Eigen::Vector3f(i % 2 == 0 ? 0.5F : -0.5F, 0.0F, 0.0F);
    wrong.push_back(proposal(pose));
  }
  for (const RefinedPose& refused : refiner.refine(frame.view(), office_map(), wrong)) {
    // Alignment may still find the way home from a wrong start; what it does not find must not be accepted.
    REQUIRE((!refused.accepted || translation_distance_m(refused.world_from_camera, truth) < kFineM));
  }
  std::vector<PoseEstimate> with_right = wrong;
  with_right.push_back(proposal(truth * test::random_motion(random, 0.03F, 0.03F)));
  const std::vector<RefinedPose> refined = refiner.refine(frame.view(), office_map(), with_right);
  REQUIRE(refined.front().accepted);
  REQUIRE(translation_distance_m(refined.front().world_from_camera, truth) < kFineM);
  for (std::size_t i = 1; i < refined.size(); ++i) REQUIRE_FALSE(refined[i].accepted);
}

TEST_CASE("PoseRefiner: a pose that slid along the surfaces that hold it least is found again") {
  PoseRefinerSettings without;
  without.slide_reach_m = 0.0F;
  PoseRefiner staying(office_map().context(), without);
  PoseRefiner sliding(office_map().context());
  for (const int index : {kSeen + 1, kSeen + 7}) {
    const RgbdFrame& frame = test::office().frame(index);
    const SE3& truth = *frame.world_from_camera;
    const Eigen::Vector3f loosest_world = sliding.refine_one(frame.view(), office_map(), truth).loosest_world;
    for (const float distance_m : {-0.6F, 0.6F}) {  // beyond what alignment mends
      SE3 slid = truth;
      slid.translation += distance_m * loosest_world;
      const std::vector<PoseEstimate> proposals = {proposal(slid)};
      REQUIRE_FALSE(staying.refine(frame.view(), office_map(), proposals).front().accepted);
      const std::vector<RefinedPose> refined = sliding.refine(frame.view(), office_map(), proposals);
      REQUIRE(refined.front().accepted);
      REQUIRE(refined.front().candidate == 0);
      REQUIRE(translation_distance_m(refined.front().world_from_camera, truth) < kFineM);
    }
  }
}

/// Gives every view a probability of 0.1 and accepts from 0.2.
ClassifierModel undecided() {
  ClassifierModel model = default_acceptance_classifier();
  for (ClassifierModel::Feature& feature : model.features) std::fill(std::begin(feature.weights), std::end(feature.weights), 0.0F);
  model.bias = 0.0F;
  model.probability_scale = 1.0F;
  model.probability_offset = std::log(1.0F / 9.0F);
  model.good_threshold = std::log(1.0F / 4.0F) - model.probability_offset;
  return model;
}

TEST_CASE("PoseRefiner: the relocaliser's confidence multiplies the odds, up to a limit, where refinement stayed near its proposal") {
  PoseRefiner refiner(office_map().context(), {}, office_map().settings().depth_range(), undecided());
  const RgbdFrame& frame = test::office().frame(kSeen + 1);
  const auto refine = [&](float offset_m, float confidence) {
    SE3 pose = *frame.world_from_camera;
    pose.translation.x() += offset_m;
    return refiner.refine(frame.view(), office_map(), std::vector<PoseEstimate>{{pose, confidence}}).front();
  };
  const auto odds = [&](float confidence) {
    const float probability = refine(0.02F, confidence).probability;
    return probability / (1.0F - probability);
  };
  REQUIRE(odds(0.5F) == Approx(1.0F / 9.0F));
  REQUIRE(odds(0.8F) == Approx(4.0F / 9.0F));
  REQUIRE(odds(1.0F) == Approx(kMaxTrust / (1.0F - kMaxTrust) / 9.0F));
  for (const float in_doubt : {0.1F, std::numeric_limits<float>::quiet_NaN()}) REQUIRE(odds(in_doubt) == odds(0.5F));
  REQUIRE_FALSE(refine(0.02F, 0.5F).accepted);
  REQUIRE(refine(0.02F, 0.8F).accepted);
  REQUIRE_FALSE(refine(0.13F, 1.0F).accepted);  // what became of the pose is not what the relocaliser is sure of
}

TEST_CASE("PoseRefiner: of equal steps, what the wear on them says counts, not how much of the map is in view") {
  test::RoomRecording learnt("synthetic:stairs?frames=120");
  test::RoomRecording seen("synthetic:stairs?trajectory=test&frames=120");
  const TsdfVolume volume = learnt.fused(Context(), 0, 120, 4);
  PoseRefiner refiner(volume.context());
  const RgbdFrame& frame = seen.frame(kSeen);
  const SE3& truth = *frame.world_from_camera;
  const Eigen::Vector3f step_world(0.0F, 0.17F, 0.28F);
  SE3 above = truth;
  above.translation += step_world;
  SE3 below = truth;
  below.translation -= step_world;
  // From a step higher, more of the frame falls on the map than from the truth, and by itself that pose would be believed.
  const RefinedPose one_above = refiner.refine_one(frame.view(), volume, above);
  REQUIRE(one_above.accepted);
  REQUIRE(translation_distance_m(one_above.world_from_camera, truth) > 0.2F);
  REQUIRE(one_above.agreement.overlap > refiner.refine_one(frame.view(), volume, truth).agreement.overlap);
  const std::vector<RefinedPose> refined =
      refiner.refine(frame.view(), volume, std::vector<PoseEstimate>{proposal(above), proposal(truth), proposal(below)});
  REQUIRE(refined.front().accepted);
  REQUIRE(refined.front().candidate == 1);
  REQUIRE(translation_distance_m(refined.front().world_from_camera, truth) < kFineM);

  const std::vector<RefinedPose> wrong = refiner.refine(frame.view(), volume, std::vector<PoseEstimate>{proposal(above), proposal(below)});
  REQUIRE_FALSE(wrong.front().accepted);  // one is as good as the other
}

TEST_CASE("PoseRefiner: accepts nothing for a frame of another room, a covered lens or no depth") {
  PoseRefiner refiner(office_map().context());
  std::vector<PoseEstimate> proposals;
  for (int i = 0; i < kLastMapped; i += 8) proposals.push_back(proposal(test::office().pose(i)));
  test::RoomRecording elsewhere("synthetic:lounge?frames=40");
  for (const int i : {0, 30}) {
    for (const float confidence : {0.5F, 1.0F}) {
      for (PoseEstimate& proposal : proposals) proposal.confidence = confidence;
      for (const RefinedPose& refined : refiner.refine(elsewhere.frame(i).view(), office_map(), proposals)) REQUIRE_FALSE(refined.accepted);
    }
  }
  RgbdFrame covered = test::office().frame(kSeen);
  for (const float depth_m : {0.3F, 0.0F}) {
    for (std::size_t i = 0; i < covered.depth.size(); ++i) covered.depth.data()[i] = depth_m;
    for (const RefinedPose& refined : refiner.refine(covered.view(), office_map(), proposals)) REQUIRE_FALSE(refined.accepted);
  }
}

TEST_CASE("PoseRefiner: accepts nothing where the map is empty, or without proposals") {
  const TsdfVolume empty(Context(), {});
  PoseRefiner refiner(empty.context());
  const RgbdFrame& frame = test::office().frame(kSeen);
  for (const RefinedPose& refined : refiner.refine(frame.view(), empty, std::vector<PoseEstimate>{proposal(*frame.world_from_camera)}))
    REQUIRE_FALSE(refined.accepted);
  REQUIRE(refiner.refine(frame.view(), office_map(), std::vector<PoseEstimate>{}).empty());
}

TEST_CASE("PoseRefiner: of an image too small to be reduced nothing is expected") {
  PoseRefiner refiner(office_map().context());
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 480}, {640, 7}}) {
    RgbdFrame small = test::office().frame(kSeen);
    small.depth = Image<float>(width, height);
    small.colour = Image<Rgb8>(width, height);
    REQUIRE(refiner.refine(small.view(), office_map(), std::vector<PoseEstimate>{proposal(*small.world_from_camera)}).empty());
  }
}

TEST_CASE("PoseRefiner: what becomes of a pose does not depend on those that are refined with it") {
  PoseRefiner refiner(office_map().context());
  const RgbdFrame& frame = test::office().frame(kSeen + 1);
  Random random = test::test_random();
  std::vector<PoseEstimate> proposals;
  for (int i = 0; i < 6; ++i) proposals.push_back(proposal(test::office().pose(8 * i) * test::random_motion(random, 0.05F, 0.05F)));
  const std::vector<RefinedPose> together = refiner.refine(frame.view(), office_map(), proposals);
  REQUIRE_FALSE(together.empty());
  for (const RefinedPose& refined : together) {
    const std::vector<PoseEstimate> alone = {proposals[static_cast<std::size_t>(refined.candidate)]};
    const std::vector<RefinedPose> expected = refiner.refine(frame.view(), office_map(), alone);
    REQUIRE(expected.size() == 1);
    REQUIRE(refined.score == expected.front().score);
    REQUIRE(refined.world_from_camera.rotation == expected.front().world_from_camera.rotation);
    REQUIRE(refined.world_from_camera.translation == expected.front().world_from_camera.translation);
  }
}

TEST_CASE("PoseRefiner: identical for any number of threads") {
  std::vector<RefinedPose> one;
  for (const int num_threads : {1, 2, 4}) {
    ContextOptions options;
    options.num_threads = num_threads;
    const Context context(options);
    const TsdfVolume volume = test::office().fused(context, 0, 40, 8);
    PoseRefiner refiner(context);
    const std::vector<PoseEstimate> proposals = {proposal(test::office().pose(10)), proposal(test::office().pose(35))};
    const std::vector<RefinedPose> refined = refiner.refine(test::office().frame(20).view(), volume, proposals);
    if (num_threads == 1) one = refined;
    REQUIRE(refined.size() == one.size());
    for (std::size_t i = 0; i < refined.size(); ++i) {
      REQUIRE(refined[i].score == one[i].score);
      REQUIRE(refined[i].world_from_camera.translation == one[i].world_from_camera.translation);
    }
  }
}

TEST_CASE("PoseRefinerSettings: defaults validate, and a divisor of 0 is refused") {
  PoseRefinerSettings settings;
  REQUIRE_NOTHROW(settings.validate());
  settings.coarse_divisor = 0;
  REQUIRE_THROWS_AS(settings.validate(), InvalidSettings);
}

/// Proposes what it is told to.
class FakeRelocaliser final : public Relocaliser {
 public:
  void train(const Frame&, const SE3&) override { ++num_trained; }
  std::vector<PoseEstimate> relocalise(const Frame&) override { return proposals; }
  void update() override { ++num_updates; }
  void reset() override { ++num_resets; }
  std::size_t state_bytes() const override { return 123; }
  float acceptance_threshold() const override { return 0.1F; }

  std::vector<PoseEstimate> proposals;
  int num_trained = 0;
  int num_updates = 0;
  int num_resets = 0;
};

TEST_CASE("RefiningRelocaliser: gives the one accepted pose or nothing, and leaves the rest to the wrapped one") {
  FakeRelocaliser inner;
  RefiningRelocaliser relocaliser(inner, office_map());
  const RgbdFrame& frame = test::office().frame(kSeen + 1);
  Random random = test::test_random();
  inner.proposals = {proposal(test::office().pose(0)), proposal(*frame.world_from_camera * test::random_motion(random, 0.03F, 0.03F))};
  const std::vector<PoseEstimate> found = relocaliser.relocalise(frame.view());
  REQUIRE(found.size() == 1);
  REQUIRE(found.front().confidence >= relocaliser.acceptance_threshold());
  REQUIRE(translation_distance_m(found.front().world_from_camera, *frame.world_from_camera) < kFineM);
  REQUIRE(relocaliser.last_refined().front().accepted);

  inner.proposals.clear();
  REQUIRE(relocaliser.relocalise(frame.view()).empty());
  REQUIRE(relocaliser.last_refined().empty());

  relocaliser.train(frame.view(), *frame.world_from_camera);
  relocaliser.update();
  relocaliser.reset();
  REQUIRE(inner.num_trained == 1);
  REQUIRE(inner.num_updates == 1);
  REQUIRE(inner.num_resets == 1);
  REQUIRE(relocaliser.state_bytes() == 123);
}

TEST_CASE("RefiningRelocaliser: as the paper has it, aligns the first proposal alone and leaves every confidence as it is") {
  FakeRelocaliser inner;
  RefiningRelocaliser relocaliser(inner, office_map(), {}, Refinement::kFirst);
  const RgbdFrame& frame = test::office().frame(kSeen + 1);
  Random random = test::test_random();
  const SE3 elsewhere = test::office().pose(0);
  const SE3 near_by = *frame.world_from_camera * test::random_motion(random, 0.03F, 0.03F);
  inner.proposals = {{near_by, 0.6F}, {elsewhere, 0.5F}};
  std::vector<PoseEstimate> found = relocaliser.relocalise(frame.view());
  REQUIRE(found.size() == 2);
  REQUIRE(translation_distance_m(found[0].world_from_camera, *frame.world_from_camera) < kFineM);
  REQUIRE(found[0].confidence == 0.6F);
  REQUIRE(found[1].world_from_camera.translation == elsewhere.translation);
  REQUIRE(found[1].confidence == 0.5F);
  REQUIRE(relocaliser.last_refined().size() == 1);
  REQUIRE(relocaliser.acceptance_threshold() == 0.1F);

  SE3 outside = elsewhere;  // where there is nothing to align with
  outside.translation.x() += 100.0F;
  inner.proposals = {{outside, 0.6F}};
  found = relocaliser.relocalise(frame.view());
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].world_from_camera.translation == outside.translation);

  inner.proposals.clear();
  REQUIRE(relocaliser.relocalise(frame.view()).empty());
  REQUIRE(relocaliser.last_refined().empty());
}

}  // namespace
}  // namespace foothold
