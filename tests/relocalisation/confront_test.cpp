// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "pose/confront_kernels.h"

#include <vector>

#include "foothold/base/exec/cpu_executor.h"
#include "relocalisation/averaged_camera.h"
#include "support/catch.h"

namespace foothold {
namespace {

using namespace test;

constexpr float kWallM = 2.0F;
constexpr int kBoxDepth_mm = 1500;

/// What a camera sees at the scene's origin: a grey wall, and a box before its middle if there is one.
std::vector<FeaturePixel> seen(bool with_box) {
  std::vector<FeaturePixel> pixels(static_cast<std::size_t>(kWidth * kHeight));
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      FeaturePixel& pixel = pixels[static_cast<std::size_t>(v * kWidth + u)];
      const bool is_box = with_box && std::abs(u - kWidth / 2) < kWidth / 4 && std::abs(v - kHeight / 2) < kHeight / 4;
      pixel.channels[0] = static_cast<std::int16_t>(is_box ? kBoxDepth_mm : static_cast<int>(1000.0F * kWallM));
      for (int k = 1; k < 4; ++k) pixel.channels[k] = 100;
    }
  }
  return pixels;
}

/// The same, remembered: the wall goes on far beyond the view.
std::vector<RememberedPoint> remembered(const std::vector<FeaturePixel>& pixels) {
  std::vector<RememberedPoint> points;
  for (int v = -kHeight; v < 2 * kHeight; v += 2) {
    for (int u = -kWidth; u < 2 * kWidth; u += 2) {
      const bool is_inside = u >= 0 && v >= 0 && u < kWidth && v < kHeight;
      const float z_m = is_inside ? static_cast<float>(pixels[static_cast<std::size_t>(v * kWidth + u)].depth_mm()) * 1e-3F : kWallM;
      const Eigen::Vector3f p =
          z_m * Eigen::Vector3f((static_cast<float>(u) - kCamera.cx) / kCamera.fx, (static_cast<float>(v) - kCamera.cy) / kCamera.fy, 1.0F);
      points.push_back({{p.x(), p.y(), p.z()}, {100, 100, 100}, 1});
    }
  }
  return points;
}

/// The agreements of the six shifted poses: two along each axis.
std::vector<float> shifted_agreements(bool with_box, float own_agreement = 1.0F) {
  const std::vector<FeaturePixel> pixels = seen(with_box);
  const std::vector<RememberedPoint> points = remembered(pixels);
  SE3 scene_from_camera;
  float energy = 0.0F;
  std::uint64_t order = 0;
  SceneAgreement own{};
  own.agreeing_fraction = own_agreement;
  std::vector<float> shifted(kNumShifts, -2.0F);
  const ConfrontShifted<CpuExecutor> body{{pixels.data(), kWidth, kHeight, 1.0F}, kCamera, points.data(), static_cast<int>(points.size()),
                                          {&scene_from_camera, &energy, &order},  &own,    shifted.data()};
  for (std::size_t shift = 0; shift < shifted.size(); ++shift) body(CpuTeam{}, shift);
  return shifted;
}

TEST_CASE("ConfrontShifted: nothing is asked of a pose that is hopeless itself") {
  CHECK(shifted_agreements(true, 0.1F) == std::vector<float>(kNumShifts, 1.0F));
}

TEST_CASE("ConfrontShifted: a plain wall explains a camera that was moved along it, and none that was moved towards it") {
  const std::vector<float> shifted = shifted_agreements(false);
  for (int i = 0; i < 4; ++i) CHECK(shifted[static_cast<std::size_t>(i)] > 0.9F);
  CHECK(shifted[4] < 0.0F);  // nearer: the camera would see through the wall
  CHECK(shifted[5] < 0.1F);  // further: the wall would be hidden
}

TEST_CASE("ConfrontShifted: a box before the wall speaks against a camera that was moved along it") {
  const std::vector<float> with_box = shifted_agreements(true);
  const std::vector<float> without = shifted_agreements(false);
  for (std::size_t i = 0; i < 4; ++i) CHECK(with_box[i] < without[i] - 0.1F);
}

struct Candidate {
  float x_m;
  SceneEvidence evidence;
  float energy;
};

/// What FindRivals finds among candidates, the first of which is the best, and these agreements of shifted poses.
SceneAgreement rivals_of(const std::vector<Candidate>& candidates, std::vector<float> shifted) {
  std::vector<SE3> poses(candidates.size());
  std::vector<float> energies;
  std::vector<std::uint64_t> order;
  std::vector<SceneEvidence> evidence;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    poses[i].translation.x() = candidates[i].x_m;
    energies.push_back(candidates[i].energy);
    order.push_back(i);
    evidence.push_back(candidates[i].evidence);
  }
  SceneAgreement agreement{};
  FindRivals<CpuExecutor>{{poses.data(), energies.data(), order.data()}, evidence.data(), candidates.size(), shifted.data(), &agreement}(
      CpuTeam{}, 0);
  return agreement;
}

TEST_CASE("FindRivals: the best candidate elsewhere counts, and neither one nearby nor one that has failed") {
  const SceneEvidence all_agrees{1000.0F, 0.0F, 1000.0F};
  const SceneEvidence half_agrees{1000.0F, 100.0F, 500.0F};
  const std::vector<float> shifted = {0.1F, 0.7F, -0.5F, 0.2F, 0.0F, 0.3F};
  const SceneAgreement found = rivals_of(
      {{0.0F, all_agrees, 1.0F}, {0.1F, all_agrees, 1.0F}, {3.0F, all_agrees, kFailedEnergy}, {1.0F, half_agrees, 1.0F}}, shifted);
  REQUIRE(found.rival_agreement == Approx(half_agrees.alike_fraction() - half_agrees.contradicted_fraction()));
  REQUIRE(found.shifted_agreement == 0.7F);
  REQUIRE(rivals_of({{0.0F, all_agrees, 1.0F}, {0.1F, all_agrees, 1.0F}}, shifted).rival_agreement == -1.0F);
}

}  // namespace
}  // namespace foothold
