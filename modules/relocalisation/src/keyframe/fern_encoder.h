// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// From a depth image to a short binary code that is alike for alike views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "foothold/base/image.h"
#include "foothold/base/span.h"
#include "foothold/relocalisation/keyframe_relocaliser.h"

namespace foothold {

/// Bits that a fern contributes to a code: one per test. A code holds 16 ferns per 64-bit word.
inline constexpr int kTestsPerFern = 4;

/// Halves a depth image: each pixel becomes the mean of the valid ones among four, 0 if there are none. An odd last row or column is
/// dropped.
/// @pre out has width / 2 times height / 2 elements.
void halve_depth(ImageView<const float> depth, std::vector<float>& column_sums, float* out);

/// Smooths a depth image with a Gaussian normalised over valid pixels. Holes are filled where its window (+-2 sigma) holds a measurement.
/// @param weights_x  scratch
void smooth_depth(int width, int height, Span<const float> kernel, Span<float> depth, std::vector<float>& scratch);

/// Number of ferns whose bits differ between two codes of equal length.
int count_different_ferns(const std::uint64_t* a, const std::uint64_t* b, std::size_t num_words);

/// Encodes depth images by random ferns. Not thread-safe: it reuses its buffers.
class FernEncoder {
 public:
  /// @pre settings.validate() passes.
  explicit FernEncoder(const KeyframeRelocaliserSettings& settings);

  std::size_t num_words() const { return num_words_; }
  /// Writes the code of a depth image in host memory. @return False if too little of it is valid; the code is then unspecified.
  bool encode(ImageView<const float> depth, Span<std::uint64_t> code);

 private:
  /// A comparison of the depth at a place, as a fraction of width and height so that it suits every image size, with a threshold.
  struct Test {
    float x = 0.0F;
    float y = 0.0F;
    float threshold_m = 0.0F;
  };

  void place_tests(int width, int height);

  float min_valid_fraction_;
  int encoded_width_;
  std::size_t num_words_;
  std::vector<Test> tests_;
  std::vector<float> kernel_;
  std::vector<std::size_t> pixels_;  ///< of each test in an encoded image of placed_width_ x placed_height_
  int placed_width_ = 0;
  int placed_height_ = 0;
  std::vector<float> pyramid_[2];
  std::vector<float> scratch_;
};

}  // namespace foothold
