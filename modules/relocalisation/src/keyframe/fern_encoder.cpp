// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "keyframe/fern_encoder.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/camera.h"
#include "foothold/base/random.h"

namespace foothold {
namespace {

/// Stream of derive_seed() that places the tests.
constexpr std::uint64_t kTestStream = 0;
constexpr std::size_t kBitsPerWord = 64;

std::vector<float> gaussian_kernel(float sigma) {
  const int radius = static_cast<int>(std::ceil(2.0F * sigma));
  std::vector<float> kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(std::exp(-0.5F * static_cast<float>(i * i) / (sigma * sigma)));
  return kernel;
}

/// out[i] += weight * in[i], over a row.
void add_scaled(std::size_t count, float weight, const float* in, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += weight * in[i];
}

/// Convolves rows (stride 1) of a width x height image; `kernel` is symmetric and is cut off at the border.
void convolve_rows(int width, int height, Span<const float> kernel, const float* in, float* out) {
  const int radius = static_cast<int>(kernel.size()) / 2;
  for (int y = 0; y < height; ++y) {
    const float* in_row = in + static_cast<std::ptrdiff_t>(y) * width;
    float* out_row = out + static_cast<std::ptrdiff_t>(y) * width;
    std::fill_n(out_row, width, 0.0F);
    for (int k = -radius; k <= radius; ++k) {
      const int begin = std::max(0, -k);
      const int end = std::min(width, width - k);
      if (begin < end) add_scaled(static_cast<std::size_t>(end - begin), kernel[k + radius], in_row + begin + k, out_row + begin);
    }
  }
}

void convolve_columns(int width, int height, Span<const float> kernel, const float* in, float* out) {
  const int radius = static_cast<int>(kernel.size()) / 2;
  for (int y = 0; y < height; ++y) {
    float* out_row = out + static_cast<std::ptrdiff_t>(y) * width;
    std::fill_n(out_row, width, 0.0F);
    for (int k = std::max(-radius, -y); k <= std::min(radius, height - 1 - y); ++k) {
      add_scaled(static_cast<std::size_t>(width), kernel[k + radius], in + static_cast<std::ptrdiff_t>(y + k) * width, out_row);
    }
  }
}

}  // namespace

void halve_depth(ImageView<const float> depth, std::vector<float>& column_sums, float* out) {
  const auto width = static_cast<std::size_t>(depth.width);
  const std::size_t half_width = width / 2;
  column_sums.resize(2 * width);
  float* sums = column_sums.data();
  float* counts = column_sums.data() + width;
  for (int y = 0; y + 1 < depth.height; y += 2) {
    const float* upper = &depth(0, y);
    const float* lower = &depth(0, y + 1);
    for (std::size_t x = 0; x < width; ++x) {
      const bool has_upper = is_valid_depth(upper[x]);
      const bool has_lower = is_valid_depth(lower[x]);
      sums[x] = (has_upper ? upper[x] : 0.0F) + (has_lower ? lower[x] : 0.0F);
      counts[x] = (has_upper ? 1.0F : 0.0F) + (has_lower ? 1.0F : 0.0F);
    }
    for (std::size_t x = 0; x < half_width; ++x) {
      out[x] = (sums[2 * x] + sums[2 * x + 1]) / std::max(1.0F, counts[2 * x] + counts[2 * x + 1]);
    }
    out += half_width;
  }
}

void smooth_depth(int width, int height, Span<const float> kernel, Span<float> depth, std::vector<float>& scratch) {
  // A normalised convolution: blur the depth (holes are 0) and the mask of valid pixels, and divide.
  const std::size_t size = depth.size();
  scratch.resize(3 * size);
  float* mask = scratch.data();
  float* blurred_mask = mask + size;
  float* rows = blurred_mask + size;
  for (std::size_t i = 0; i < size; ++i) mask[i] = depth[i] > 0.0F ? 1.0F : 0.0F;
  convolve_rows(width, height, kernel, mask, rows);
  convolve_columns(width, height, kernel, rows, blurred_mask);
  convolve_rows(width, height, kernel, depth.data(), rows);
  convolve_columns(width, height, kernel, rows, depth.data());
  for (std::size_t i = 0; i < size; ++i) depth[i] = blurred_mask[i] > 0.0F ? depth[i] / blurred_mask[i] : 0.0F;
}

int count_different_ferns(const std::uint64_t* a, const std::uint64_t* b, std::size_t num_words) {
  constexpr std::uint64_t kLowestBits = 0x1111111111111111ULL;
  int count = 0;
  for (std::size_t i = 0; i < num_words; ++i) {
    std::uint64_t different = a[i] ^ b[i];
    different |= different >> 2U;
    different |= different >> 1U;
    count += __builtin_popcountll(different & kLowestBits);
  }
  return count;
}

FernEncoder::FernEncoder(const KeyframeRelocaliserSettings& settings)
    : min_valid_fraction_(settings.min_valid_fraction),
      encoded_width_(settings.encoded_width_px),
      kernel_(gaussian_kernel(settings.smoothing_sigma_px)) {
  Random random(settings.seed, kTestStream);
  tests_.resize(static_cast<std::size_t>(settings.num_ferns) * kTestsPerFern);
  for (Test& test : tests_) {
    test.x = random.uniform();
    test.y = random.uniform();
    test.threshold_m = random.uniform(settings.min_threshold_m, settings.max_threshold_m);
  }
  num_words_ = (tests_.size() + kBitsPerWord - 1) / kBitsPerWord;
}

void FernEncoder::place_tests(int width, int height) {
  if (width == placed_width_ && height == placed_height_) return;
  pixels_.clear();
  for (const Test& test : tests_) {
    const auto x = static_cast<std::size_t>(test.x * static_cast<float>(width));
    const auto y = static_cast<std::size_t>(test.y * static_cast<float>(height));
    pixels_.push_back(y * static_cast<std::size_t>(width) + x);
  }
  placed_width_ = width;
  placed_height_ = height;
}

bool FernEncoder::encode(ImageView<const float> depth, Span<std::uint64_t> code) {
  int level = 0;
  std::vector<float>* image = &pyramid_[0];
  const float widest = std::sqrt(2.0F) * static_cast<float>(encoded_width_);  // stop at the width nearest to the wanted one, as a ratio
  for (; static_cast<float>(depth.width) > widest && depth.height >= 2; ++level) {
    image = &pyramid_[level % 2];
    image->resize(static_cast<std::size_t>(depth.width / 2) * static_cast<std::size_t>(depth.height / 2));
    halve_depth(depth, scratch_, image->data());
    depth = {image->data(), depth.width / 2, depth.height / 2, MemoryKind::kHost};
  }
  if (level == 0) {
    image->resize(depth.size());
    std::transform(depth.data, depth.data + depth.size(), image->begin(), [](float d) { return is_valid_depth(d) ? d : 0.0F; });
  }
  const auto num_valid = std::count_if(image->begin(), image->end(), [](float d) { return d > 0.0F; });
  if (num_valid == 0 || static_cast<float>(num_valid) < min_valid_fraction_ * static_cast<float>(image->size())) return false;

  smooth_depth(depth.width, depth.height, kernel_, *image, scratch_);
  place_tests(depth.width, depth.height);
  std::fill(code.begin(), code.end(), std::uint64_t{0});
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    const bool further = (*image)[pixels_[i]] >= tests_[i].threshold_m;
    code[i / kBitsPerWord] |= static_cast<std::uint64_t>(further) << (i % kBitsPerWord);
  }
  return true;
}

}  // namespace foothold
