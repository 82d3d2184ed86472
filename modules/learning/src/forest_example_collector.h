// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// From recordings to training examples.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/base/random.h"
#include "foothold/learning/forest_training.h"
#include "foothold/relocalisation/feature_image.h"
#include "forest_examples.h"

namespace foothold {

/// Draws the features that all trees share: uniform directions, uniform lengths.
std::vector<ForestFeature> draw_training_features(const ForestTrainingSettings& settings);

/// Reads the frames of a scene and samples examples from them.
class ForestExampleCollector {
 public:
  /// @param examples_per_frame  Pixels that each frame and each of its rolled copies contributes; fewer only where depth is missing.
  ForestExampleCollector(const Context& context, const ForestTrainingSettings& settings, const std::vector<ForestFeature>& features,
                         int examples_per_frame)
      : context_(context), settings_(settings), features_(features), examples_per_frame_(examples_per_frame) {}

  /// Appends the examples of one scene.
  /// @param scene       Number of the scene, which names its random choices.
  /// @param frame_done  Called after each frame; collecting stops when it returns false.
  /// @return False if it was stopped; the examples are then as before.
  bool collect(const Sequence& sequence, std::size_t scene, const std::function<bool()>& frame_done, ForestExamples& examples);

 private:
  /// A view that later examples may be paired with.
  struct SeenView {
    std::vector<FeaturePixel> pixels;
    FeatureImageView image;  // of the pixels above
    Intrinsics intrinsics;   // of the feature image
    SE3 camera_from_world;
  };
  struct Pixel {
    int u = -1;  // in the frame; -1 for none
    int v = -1;
  };

  void add_frame(const RgbdFrame& frame, std::uint64_t frame_key, ForestExamples& examples);
  Pixel sample_pixel(const RgbdFrame& frame, const FeatureImageView& image, Random random) const;
  void evaluate(const FeatureImageView& image, int u, int v, std::int16_t* values) const;
  bool evaluate_in_other_view(const Eigen::Vector3f& point_world, Random random, std::int16_t* values) const;
  void remember_view(const RgbdFrame& frame, const FeatureImageView& image);

  const Context& context_;
  const ForestTrainingSettings& settings_;
  const std::vector<ForestFeature>& features_;
  int examples_per_frame_;
  std::vector<SeenView> seen_views_;
  std::size_t num_views_ = 0;
};

}  // namespace foothold
