// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "frame_pairer.h"

#include <algorithm>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold::test {
namespace {

using Pairer = capture::FramePairer<int>;
constexpr double kPeriod_s = 1.0 / 30.0;

TEST_CASE("FramePairer: pairs images of the same time, whichever comes first") {
  Pairer pairer(0.5 * kPeriod_s);
  CHECK_FALSE(pairer.add_depth(1.000, 1).has_value());
  auto pair = pairer.add_colour(1.010, 10);
  REQUIRE(pair.has_value());
  CHECK(pair->depth == 1);
  CHECK(pair->colour == 10);
  CHECK(pair->depth_time_s == 1.000);
  CHECK_FALSE(pairer.add_colour(1.033, 11).has_value());
  pair = pairer.add_depth(1.034, 2);
  REQUIRE(pair.has_value());
  CHECK(pair->depth == 2);
  CHECK(pair->colour == 11);
  CHECK(pairer.num_dropped() == 0);
}

TEST_CASE("FramePairer: an image without a partner is dropped and counted") {
  Pairer pairer(0.5 * kPeriod_s);
  pairer.add_depth(1.0, 1);
  pairer.add_depth(1.0 + kPeriod_s, 2);
  const auto pair = pairer.add_colour(1.0 + kPeriod_s, 20);
  REQUIRE(pair.has_value());
  CHECK(pair->depth == 2);
  CHECK(pairer.num_dropped() == 1);
}

TEST_CASE("FramePairer: one stream may run ahead of the other") {
  Pairer pairer(0.5 * kPeriod_s);
  for (int i = 0; i < 3; ++i) CHECK_FALSE(pairer.add_depth(i * kPeriod_s, i).has_value());
  for (int i = 0; i < 20; ++i) {
    const auto pair = pairer.add_colour(i * kPeriod_s, i);
    REQUIRE(pair.has_value());
    CHECK(pair->depth == i);
    CHECK(pair->colour == i);
    CHECK_FALSE(pairer.add_depth((i + 3) * kPeriod_s, i + 3).has_value());
  }
  CHECK(pairer.num_dropped() == 0);
}

TEST_CASE("FramePairer: a lone stream keeps a few images and drops the rest") {
  Pairer pairer(0.5 * kPeriod_s);
  for (int i = 0; i < 100; ++i) CHECK_FALSE(pairer.add_colour(i * kPeriod_s, i).has_value());
  CHECK(pairer.num_dropped() == 96);
  pairer.clear();
  CHECK(pairer.num_dropped() == 96);
}

TEST_CASE("FramePairer: with lost images and jitter, every pair is a true one and no true pair is missed") {
  Random random = test_random();
  Pairer pairer(0.5 * kPeriod_s);
  int num_expected = 0;
  int num_paired = 0;
  for (int i = 0; i < 500; ++i) {
    const bool has_depth = random.uniform(0.0F, 1.0F) > 0.1F;
    const bool has_colour = random.uniform(0.0F, 1.0F) > 0.1F;
    num_expected += has_depth && has_colour ? 1 : 0;
    const double jitter_s = 0.2 * kPeriod_s * static_cast<double>(random.uniform(-1.0F, 1.0F));
    if (has_depth) pairer.add_depth(i * kPeriod_s, i);
    const auto pair = has_colour ? pairer.add_colour(i * kPeriod_s + jitter_s, i) : std::optional<Pairer::Pair>();
    if (!pair.has_value()) continue;
    CHECK(pair->depth == pair->colour);
    ++num_paired;
  }
  CHECK(num_paired == num_expected);
}

}  // namespace
}  // namespace foothold::test
