// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "clustering/leaf_colours.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

Rgb8 random_colour(Random& random) {
  const auto channel = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  const std::uint8_t r = channel();
  const std::uint8_t g = channel();
  return {r, g, channel()};
}

LeafColours word_of(const std::vector<Rgb8>& colours) {
  LeafColours word = 0;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const std::uint8_t rgb[3] = {colours[i].r, colours[i].g, colours[i].b};
    word = with_colour(word, static_cast<int>(i), rgb);
  }
  return word;
}

int difference(const Rgb8& a, const Rgb8& b) { return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}); }

TEST_CASE(
    "LeafColours: closeness falls with the difference to the nearest of the first four colours, and is never off by more than storage is") {
  constexpr int kStorage = 4;  // half of the eight grey levels that are stored as one
  Random random = test::test_random();
  for (int i = 0; i < 5000; ++i) {
    std::vector<Rgb8> colours;
    for (int k = 0; k < 1 + i % 6; ++k) colours.push_back(random_colour(random));
    const Rgb8 asked = i % 2 == 0 ? random_colour(random) : colours[random.below(static_cast<std::uint32_t>(colours.size()))];
    int nearest = 255;
    for (std::size_t k = 0; k < std::min<std::size_t>(colours.size(), 4); ++k) nearest = std::min(nearest, difference(asked, colours[k]));
    const auto of_difference = [](int d) { return static_cast<std::uint32_t>(d < 20 ? (20 - d) * (20 - d) : 0); };
    const std::uint32_t found = closeness(word_of(colours), asked);
    CHECK(found <= of_difference(std::max(nearest - kStorage, 0)));
    CHECK(found >= of_difference(nearest + kStorage));
  }
}

TEST_CASE("LeafColours: black and white are colours, and no colour is close to none") {
  for (const Rgb8& colour : {Rgb8{0, 0, 0}, Rgb8{255, 255, 255}}) {
    CHECK(closeness(word_of({colour}), colour) >= 256);  // of 400: stored as the middle of eight grey levels
    CHECK(closeness(LeafColours{0}, colour) == 0);
  }
}

}  // namespace
}  // namespace foothold
