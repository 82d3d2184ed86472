// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "keyframe/fern_encoder.h"

#include <cmath>
#include <limits>
#include <vector>

#include "foothold/relocalisation/keyframe_relocaliser.h"
#include "relocalisation/relief.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::random_relief;

/// Single precision over sums of a few hundred terms.
constexpr float kPixelTolerance = 1e-4F;

TEST_CASE("halve_depth: is the mean of the valid pixels among four") {
  Random random = test::test_random();
  Image<float> depth(13, 7);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::uint32_t kind = random.below(4);
    const float holes[] = {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()};
    depth.data()[i] = kind < 3 ? holes[kind] : random.uniform(0.5F, 4.0F);
  }
  std::vector<float> scratch;
  std::vector<float> half(6 * 3);
  halve_depth(depth.view(), scratch, half.data());
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 6; ++u) {
      double sum = 0.0;
      int count = 0;
      for (int k = 0; k < 4; ++k) {
        const float d = depth(2 * u + k % 2, 2 * v + k / 2);
        if (d > 0.0F) sum += d, ++count;
      }
      const double expected = count == 0 ? 0.0 : sum / count;
      REQUIRE(half[static_cast<std::size_t>(v * 6 + u)] == Approx(expected).margin(kPixelTolerance));
    }
  }
}

TEST_CASE("smooth_depth: is a Gaussian mean of the valid pixels in its window") {
  Random random = test::test_random();
  constexpr int kWidth = 11;
  constexpr int kHeight = 8;
  const std::vector<float> kernel = {0.2F, 0.7F, 1.0F, 0.7F, 0.2F};
  Image<float> depth(kWidth, kHeight);
  for (std::size_t i = 0; i < depth.size(); ++i) depth.data()[i] = random.below(3) == 0 ? random.uniform(0.5F, 4.0F) : 0.0F;
  std::vector<float> smoothed(depth.data(), depth.data() + depth.size());
  std::vector<float> scratch;
  smooth_depth(kWidth, kHeight, kernel, smoothed, scratch);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      double sum = 0.0;
      double weights = 0.0;
      for (int dv = -2; dv <= 2; ++dv) {
        for (int du = -2; du <= 2; ++du) {
          if (!depth.view().contains(u + du, v + dv) || depth(u + du, v + dv) <= 0.0F) continue;
          const double weight = kernel[static_cast<std::size_t>(du + 2)] * kernel[static_cast<std::size_t>(dv + 2)];
          sum += weight * depth(u + du, v + dv);
          weights += weight;
        }
      }
      REQUIRE(smoothed[static_cast<std::size_t>(v * kWidth + u)] == Approx(weights > 0.0 ? sum / weights : 0.0).margin(kPixelTolerance));
    }
  }
}

TEST_CASE("count_different_ferns: counts groups of four bits that differ") {
  Random random = test::test_random();
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::uint64_t a[2];
    std::uint64_t b[2];
    int expected = 0;
    for (int i = 0; i < 2; ++i) {
      a[i] = (static_cast<std::uint64_t>(random.bits()) << 32U) | random.bits();
      b[i] = a[i] ^ (((static_cast<std::uint64_t>(random.bits()) << 32U) | random.bits()) & random.bits());
      for (unsigned shift = 0; shift < 64; shift += 4) expected += ((a[i] >> shift) & 15U) != ((b[i] >> shift) & 15U) ? 1 : 0;
    }
    REQUIRE(count_different_ferns(a, b, 2) == expected);
  }
}

TEST_CASE("FernEncoder: sees every quarter of the image") {
  FernEncoder encoder{KeyframeRelocaliserSettings{}};
  const Image<float> flat(640, 480, 1.0F);
  std::vector<std::uint64_t> flat_code(encoder.num_words());
  REQUIRE(encoder.encode(flat.view(), flat_code));
  for (int quarter = 0; quarter < 4; ++quarter) {
    Image<float> changed = flat;
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) changed(u + 320 * (quarter % 2), v + 240 * (quarter / 2)) = 3.9F;
    }
    std::vector<std::uint64_t> code(encoder.num_words());
    REQUIRE(encoder.encode(changed.view(), code));
    // A fern keeps its bits if none of its four tests lies in the quarter: 0.75^4 = 32 % of 500.
    REQUIRE(count_different_ferns(flat_code.data(), code.data(), code.size()) > 250);
  }
}

TEST_CASE("FernEncoder: codes of one view at different sizes are alike") {
  Random random = test::test_random();
  FernEncoder encoder{KeyframeRelocaliserSettings{}};
  const Image<float> relief = random_relief(random, 640, 480);
  std::vector<std::uint64_t> code(encoder.num_words());
  REQUIRE(encoder.encode(relief.view(), code));
  for (const int divisor : {2, 4, 16}) {
    Image<float> small(640 / divisor, 480 / divisor);
    for (int v = 0; v < small.height(); ++v) {
      for (int u = 0; u < small.width(); ++u) small(u, v) = relief(u * divisor + divisor / 2, v * divisor + divisor / 2);
    }
    std::vector<std::uint64_t> small_code(encoder.num_words());
    REQUIRE(encoder.encode(small.view(), small_code));
    REQUIRE(count_different_ferns(code.data(), small_code.data(), code.size()) < 10);
  }
}

TEST_CASE("FernEncoder: equal seeds place equal tests, other seeds others") {
  Random random = test::test_random();
  const Image<float> relief = random_relief(random, 640, 480);
  KeyframeRelocaliserSettings settings;
  FernEncoder first(settings);
  FernEncoder second(settings);
  settings.seed = 43;
  FernEncoder other(settings);
  std::vector<std::uint64_t> codes[3];
  FernEncoder* encoders[] = {&first, &second, &other};
  for (int i = 0; i < 3; ++i) {
    codes[i].resize(first.num_words());
    REQUIRE(encoders[i]->encode(relief.view(), codes[i]));
  }
  REQUIRE(codes[0] == codes[1]);
  REQUIRE(codes[0] != codes[2]);
}

}  // namespace
}  // namespace foothold
