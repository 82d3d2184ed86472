// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A walk through a small kitchen, and reconstructions of it that take little time.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "foothold/reconstruction/reconstruction.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "support/catch.h"

namespace foothold::test {

inline Context threads(int num_threads) {
  ContextOptions options;
  options.num_threads = num_threads;
  return Context(options);
}
inline Context two_threads() { return threads(2); }

inline ReconstructionSettings small_settings() {
  ReconstructionSettings settings;
  settings.fusion.volume.voxel_size_m = 0.02F;
  settings.fusion.volume.truncation_m = 0.08F;
  settings.forest.reservoirs.capacity = 64;
  return settings;
}

inline Forest small_forest(std::uint64_t seed = 42) {
  RandomForestSettings settings;
  settings.depth = 9;
  settings.seed = seed;
  return make_random_forest(settings);
}

/// The walk, rendered once.
inline const std::vector<RgbdFrame>& kitchen() {
  static const std::vector<RgbdFrame> frames = [] {
    const auto sequence = make_synthetic_sequence(parse_synthetic_spec("synthetic:kitchen?frames=60&width=320&height=240"), two_threads());
    std::vector<RgbdFrame> result;
    for (int i = 0; i < sequence->num_frames(); ++i) result.push_back(sequence->load(i));
    return result;
  }();
  return frames;
}

/// The true pose of a frame in the world of a reconstruction that began with the first.
inline SE3 true_pose(const RgbdFrame& frame) { return kitchen().front().world_from_camera->inverse() * *frame.world_from_camera; }

inline void walk(Reconstruction& reconstruction, int num_frames) {
  for (int i = 0; i < num_frames; ++i) {
    const FusionFrameResult result = reconstruction.process(kitchen()[static_cast<std::size_t>(i)].view());
    INFO("frame " << i);
    REQUIRE(result.world_from_camera.has_value());
  }
}

inline std::string bytes_of(const Reconstruction& reconstruction) {
  std::ostringstream stream;
  reconstruction.pipeline().save(stream);
  return stream.str();
}

}  // namespace foothold::test
