// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/random.h"

#include <cmath>
#include <vector>

#include "support/catch.h"

namespace foothold {
namespace {

/// Deviations allowed from the expectation, in standard deviations. With fixed seeds these tests always give the same answer.
constexpr double kSigmas = 5.0;

TEST_CASE("mix_bits: is the published finaliser of SplitMix64") {
  // The first outputs of the published generator for the seeds 0 and 1234567.
  REQUIRE(mix_bits(0x9e3779b97f4a7c15ULL) == 0xe220a8397b1dcdafULL);
  REQUIRE(mix_bits(1234567ULL + 0x9e3779b97f4a7c15ULL) == 6457827717110365317ULL);
  REQUIRE(mix_bits(1234567ULL + 2 * 0x9e3779b97f4a7c15ULL) == 3203168211198807973ULL);
}

TEST_CASE("Random: the sequence never changes") {
  // Forests, scenes and every published number depend on these values.
  REQUIRE(derive_seed(0, 0) == 0xca23bb4e5daf0ff5ULL);
  REQUIRE(derive_seed(42, 7) == 0xb4aaa31803e74030ULL);
  Random random(42, 7);
  for (const std::uint32_t expected : {1730412107U, 1861391253U, 1247646896U, 3273783752U}) REQUIRE(random.bits() == expected);
  REQUIRE(random.below(1000) == 323U);
  REQUIRE(random.uniform() == 0.250778437F);
  REQUIRE(random.uniform(-2.0F, 3.0F) == 1.24170852F);
}

TEST_CASE("Random: is usable in constant expressions and copies continue alike") {
  constexpr std::uint32_t kFirst = Random(1, 2).bits();
  Random original(1, 2);
  REQUIRE(original.bits() == kFirst);
  Random copy = original;
  for (int i = 0; i < 10; ++i) REQUIRE(copy.bits() == original.bits());
}

TEST_CASE("Random: numbers stay in their ranges and fill them evenly") {
  constexpr int kBins = 64;
  constexpr int kSamples = 64000;
  Random random(3, 0);
  std::vector<int> by_uniform(kBins, 0);
  std::vector<int> by_below(kBins, 0);
  for (int i = 0; i < kSamples; ++i) {
    const float x = random.uniform();
    if (x < 0.0F || x >= 1.0F) FAIL("uniform() gave " << x);
    ++by_uniform[static_cast<std::size_t>(x * kBins)];
    const std::uint32_t k = random.below(kBins);
    if (k >= kBins) FAIL("below(64) gave " << k);
    ++by_below[k];
  }
  for (const std::vector<int>& histogram : {by_uniform, by_below}) {
    const double expected = static_cast<double>(kSamples) / kBins;
    double chi_square = 0.0;
    for (const int count : histogram) chi_square += (count - expected) * (count - expected) / expected;
    // Chi-square with k - 1 degrees of freedom has mean k - 1 and variance 2 (k - 1).
    REQUIRE(std::abs(chi_square - (kBins - 1)) < kSigmas * std::sqrt(2.0 * (kBins - 1)));
  }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return sum / (static_cast<double>(a.size()) / 12.0);  // the variance of a uniform number is 1 / 12
}

std::vector<double> draw(Random random, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(static_cast<double>(random.uniform()));
  return values;
}

TEST_CASE("Random: streams, seeds and successive numbers are independent") {
  constexpr int kCount = 10000;
  const double limit = kSigmas / std::sqrt(static_cast<double>(kCount));
  const std::vector<double> base = draw(Random(5, 0), kCount + 1);
  const std::vector<double> successors(base.begin() + 1, base.end());
  const std::vector<double> first(base.begin(), base.end() - 1);
  REQUIRE(std::abs(correlation(first, successors)) < limit);
  for (std::uint64_t k = 1; k < 20; ++k) {
    REQUIRE(std::abs(correlation(first, draw(Random(5, k), kCount))) < limit);
    REQUIRE(std::abs(correlation(first, draw(Random(5 + k, 0), kCount))) < limit);
  }
  // The first number of successive streams, as algorithms use that draw one number per item.
  std::vector<double> heads;
  for (int i = 0; i <= kCount; ++i) heads.push_back(static_cast<double>(Random(9, static_cast<std::uint64_t>(i)).uniform()));
  REQUIRE(std::abs(correlation({heads.begin(), heads.end() - 1}, {heads.begin() + 1, heads.end()})) < limit);
}

}  // namespace
}  // namespace foothold
