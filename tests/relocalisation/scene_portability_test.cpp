// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Leaves and reservoirs are the same on every processor.
#include <cstdint>
#include <string>

#include "foothold/base/checksum.h"
#include "foothold/base/random.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

/// What x86-64 and 64-bit Arm save. Another number is right where learning or the form of a saved scene changed on purpose, then on both.
constexpr std::uint64_t kLearntScene = 0x2cfaee7cbe639ebe;

/// A frame of slanted plates of random depths and colours. Each number is exact or rounded once, so that it is the same everywhere, too.
RgbdFrame frame_of_plates(Random& random) {
  constexpr int plate_px = 20;
  RgbdFrame frame;
  frame.depth = Image<float>(kWidth, kHeight);
  frame.colour = Image<Rgb8>(kWidth, kHeight);
  frame.calibration.depth = frame.calibration.colour = {128.0F, 128.0F, 80.0F, 60.0F};
  for (int v0 = 0; v0 < kHeight; v0 += plate_px) {
    for (int u0 = 0; u0 < kWidth; u0 += plate_px) {
      const float depth_m = random.uniform(1.0F, 3.0F);
      const auto brightness = static_cast<std::uint8_t>(random.below(200));
      for (int v = v0; v < v0 + plate_px; ++v) {
        for (int u = u0; u < u0 + plate_px; ++u) {
          frame.depth(u, v) = depth_m + static_cast<float>(u - u0 + 2 * (v - v0)) / 256.0F;
          frame.colour(u, v) = {brightness, static_cast<std::uint8_t>(brightness + v - v0), static_cast<std::uint8_t>(random.below(256))};
        }
      }
    }
  }
  return frame;
}

TEST_CASE("ForestRelocaliser: what it learns of a frame is the same on every processor, bit by bit") {
  ForestRelocaliser relocaliser = test::untrained();
  Random random(1, 0);
  SE3 world_from_camera;
  world_from_camera.rotation << 0.6F, -0.8F, 0.0F, 0.8F, 0.6F, 0.0F, 0.0F, 0.0F, 1.0F;
  for (int i = 0; i < 20; ++i) {
    world_from_camera.translation = Eigen::Vector3f(0.25F, 0.5F, 0.125F) * static_cast<float>(i);
    relocaliser.train(frame_of_plates(random).view(), world_from_camera);
  }
  const std::string scene = test::saved(relocaliser);
  REQUIRE(fnv1a(kFnvBasis, scene.data(), scene.size()) == kLearntScene);
}

}  // namespace
}  // namespace foothold
