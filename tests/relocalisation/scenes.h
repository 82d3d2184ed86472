// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A small rendered room and relocalisers to match, for the tests of this folder.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "foothold/synthetic/synthetic_sequence.h"

namespace foothold::test {

inline Context context_of(int num_threads) {
  ContextOptions options;
  options.num_threads = num_threads;
  return Context(options);
}

/// 40 frames of the office, at a quarter of the usual number of pixels; rendered once.
inline const std::vector<RgbdFrame>& office() {
  static const std::vector<RgbdFrame> frames = [] {
    const auto sequence = make_synthetic_sequence(parse_synthetic_spec("synthetic:office?frames=160&width=320&height=240"), context_of(1));
    std::vector<RgbdFrame> result;
    for (int i = 0; i < sequence->num_frames(); i += 4) result.push_back(sequence->load(i));
    return result;
  }();
  return frames;
}

/// Frames that are trained with, and those between them.
inline bool is_training_frame(std::size_t i) { return i % 2 == 0; }

/// A forest that 20 small frames can fill.
inline Forest small_forest(std::uint64_t seed = 42) {
  RandomForestSettings settings;
  settings.depth = 9;
  settings.seed = seed;
  return make_random_forest(settings);
}

inline ForestRelocaliserSettings small_settings() {
  ForestRelocaliserSettings settings;
  settings.features.downscale = 2;
  settings.reservoirs.grid_spacing_px = 4;
  return settings;
}

inline ForestRelocaliser untrained(int num_threads = 1) {
  return ForestRelocaliser(context_of(num_threads), small_forest(), small_settings());
}

inline void train_on(ForestRelocaliser& relocaliser, std::size_t num_frames) {
  for (std::size_t i = 0; i < num_frames; ++i) {
    if (is_training_frame(i)) relocaliser.train(office()[i].view(), *office()[i].world_from_camera);
  }
}

/// Trained on every other frame of the office; trained once and copied.
inline ForestRelocaliser trained() {
  static const ForestRelocaliser relocaliser = [] {
    ForestRelocaliser result = untrained();
    train_on(result, office().size());
    return result;
  }();
  return relocaliser;
}

inline std::string saved(const ForestRelocaliser& relocaliser) {
  std::ostringstream stream;
  relocaliser.save(stream);
  return stream.str();
}

inline bool bit_equal(const std::vector<PoseEstimate>& a, const std::vector<PoseEstimate>& b) {
  bool equal = a.size() == b.size();
  for (std::size_t i = 0; equal && i < a.size(); ++i) {
    equal = a[i].confidence == b[i].confidence && a[i].world_from_camera.rotation == b[i].world_from_camera.rotation &&
            a[i].world_from_camera.translation == b[i].world_from_camera.translation;
  }
  return equal;
}

}  // namespace foothold::test
