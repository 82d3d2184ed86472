// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "examples/learnt_views.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "examples/surface_pieces.h"
#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/checked_bytes.h"
#include "support/error_message.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Examples at random points of a wall of 2 m x 2 m, 1 m in front of the origin; every tenth has no depth.
TrainingExamples random_examples(Random& random, std::size_t count) {
  TrainingExamples examples(MemoryKind::kHost);
  examples.pixels.resize(count);
  examples.points.resize(count);
  examples.surface_keys.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    examples.pixels[i] = {static_cast<std::int16_t>(i), 0, i % 10 == 9 ? 0.0F : 1.0F};
    examples.points[i] = {static_cast<std::int16_t>(static_cast<int>(random.below(2000)) - 1000),
                          static_cast<std::int16_t>(static_cast<int>(random.below(2000)) - 1000), 1000, 0};
    examples.surface_keys[i] = surface_key(examples.pixels[i], examples.points[i], i);
  }
  return examples;
}

/// The piece of surface that a point lies on, by plain arithmetic.
std::tuple<int, int, int> piece_of(const ReservoirPoint& p) {
  const auto cell = [](int mm) { return (mm + 32768) / 100; };
  return {cell(p.x_mm), cell(p.y_mm), cell(p.z_mm)};
}

TEST_CASE("LearntViews: of each piece of surface, as many examples are kept as are missing, in their order, and none without depth") {
  Random random = test::test_random();
  constexpr int kPerView = 4;
  const Context context;
  LearntViews views(MemoryKind::kHost);
  std::map<std::tuple<int, int, int>, int> kept;
  for (int frame = 0; frame < 20; ++frame) {
    TrainingExamples examples = random_examples(random, 1000);
    std::map<std::tuple<int, int, int>, int> offered;
    for (std::size_t i = 0; i < 1000; ++i) offered[piece_of(examples.points[i])] += examples.pixels[i].depth_m > 0.0F ? 1 : 0;
    const auto before = kept;
    views.keep_new(context, Eigen::Vector3f::Zero(), kPerView, examples);
    REQUIRE(examples.points.size() == examples.pixels.size());
    for (std::size_t i = 0; i < examples.pixels.size(); ++i) {
      REQUIRE(examples.pixels[i].depth_m > 0.0F);
      if (i > 0) REQUIRE(examples.pixels[i].u > examples.pixels[i - 1].u);
      ++kept[piece_of(examples.points[i])];
    }
    for (const auto& [piece, count] : offered) {
      const int known = before.count(piece) != 0 ? before.at(piece) : 0;
      REQUIRE((kept.count(piece) != 0 ? kept.at(piece) : 0) == std::min(known + count, kPerView));
    }
  }
}

TEST_CASE(
    "surface_key: numbers the pieces of a place from corner to corner, apart from what has no depth, above the example's own number") {
  const SampledPixel pixel{0, 0, 1.0F};
  REQUIRE(surface_of(surface_key(pixel, {-32768, -32768, -32768, 0}, 0)) == 0);
  REQUIRE(surface_of(surface_key(pixel, {-32768, -32768, -32669, 0}, 0)) == 0);
  REQUIRE(surface_of(surface_key(pixel, {-32768, -32768, -32668, 0}, 0)) == 1);
  REQUIRE(surface_of(surface_key(pixel, {-32768, -32668, -32768, 0}, 0)) == kCellsPerAxis);
  REQUIRE(surface_of(surface_key(pixel, {32767, 32767, 32767, 0}, 0)) == kNoSurface - 1);
  REQUIRE(surface_of(surface_key({0, 0, 0.0F}, {}, 0)) == kNoSurface);
  REQUIRE(example_of(surface_key(pixel, {32767, 32767, 32767, 0}, 307199)) == 307199);
}

TEST_CASE("LearntViews: who stays learns nothing more, and takes no more memory, and from elsewhere there is something to learn") {
  Random random = test::test_random();
  const Context context;
  LearntViews views(MemoryKind::kHost);
  constexpr int kPerView = 8;
  const auto num_kept = [&](const Eigen::Vector3f& camera) {
    TrainingExamples examples = random_examples(random, 4000);
    views.keep_new(context, camera, kPerView, examples);
    return examples.pixels.size();
  };
  Random same = random;
  const TrainingExamples first = random_examples(same, 4000);
  std::map<std::tuple<int, int, int>, int> offered;
  for (std::size_t i = 0; i < 4000; ++i) offered[piece_of(first.points[i])] += first.pixels[i].depth_m > 0.0F ? 1 : 0;
  std::size_t num_expected = 0;
  for (const auto& [piece, count] : offered) num_expected += static_cast<std::size_t>(std::min(count, kPerView));
  REQUIRE(num_kept({0.0F, 0.0F, 0.0F}) == num_expected);
  num_kept({0.0F, 0.0F, 0.0F});
  const std::size_t bytes = views.state_bytes();
  for (int i = 0; i < 20; ++i) REQUIRE(num_kept({0.0F, 0.0F, 0.0F}) < 100);
  REQUIRE(views.state_bytes() == bytes);
  REQUIRE(num_kept({2.0F, 0.0F, 0.0F}) > 1000);
  REQUIRE(num_kept({0.0F, 0.0F, -4.0F}) > 1000);
}

std::string saved(const LearntViews& views) {
  return test::checked_bytes([&](CheckedWriter& writer) { views.save(writer); });
}

std::string table(std::uint64_t num_slots, const std::vector<std::uint64_t>& entries) {
  return test::checked_bytes([&](CheckedWriter& writer) {
    writer.write(num_slots);
    writer.write_array(entries);
  });
}

void load(const std::string& bytes, LearntViews& views) {
  test::read_checked(bytes, [&](CheckedReader& reader) { views.load(Context(), reader); });
}

TEST_CASE("LearntViews: without a limit, all that has depth is kept and nothing is remembered") {
  Random random = test::test_random();
  const Context context;
  LearntViews views(MemoryKind::kHost);
  for (int i = 0; i < 5; ++i) {
    TrainingExamples examples = random_examples(random, 1000);
    views.keep_new(context, Eigen::Vector3f::Zero(), 0, examples);
    REQUIRE(examples.pixels.size() == 900);
  }
  REQUIRE(saved(views).size() ==
          checked_size(2 * sizeof(std::uint64_t)));  // the size of the table and the number of views in it, which is 0
}

TEST_CASE("LearntViews: what is saved and loaded keeps the same examples afterwards") {
  Random random = test::test_random();
  const Context context;
  LearntViews views(MemoryKind::kHost);
  TrainingExamples first = random_examples(random, 1000);
  views.keep_new(context, Eigen::Vector3f::Zero(), 4, first);
  LearntViews loaded(MemoryKind::kHost);
  load(saved(views), loaded);
  Random again = random;
  TrainingExamples a = random_examples(random, 1000);
  TrainingExamples b = random_examples(again, 1000);
  views.keep_new(context, Eigen::Vector3f::Zero(), 4, a);
  loaded.keep_new(context, Eigen::Vector3f::Zero(), 4, b);
  REQUIRE(a.pixels.size() == b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i) REQUIRE(a.pixels[i].u == b.pixels[i].u);
}

TEST_CASE("LearntViews: a table that is not in order is refused") {
  for (const std::vector<std::uint64_t>& entries : {std::vector<std::uint64_t>{512, 512}, {1024, 512}, {~std::uint64_t{0}}}) {
    LearntViews views(MemoryKind::kHost);
    REQUIRE_THROWS_AS(load(table(1024, entries), views), FileError);
  }
}

TEST_CASE("LearntViews: a table that is nearly empty takes no memory to speak of") {
  LearntViews views(MemoryKind::kHost);
  REQUIRE_NOTHROW(load(table(1U << 20U, {512}), views));
  REQUIRE(views.state_bytes() < 1000000);
  const std::string message = test::error_message<FileError>([&] { load(table(1U << 30U, {512}), views); });
  REQUIRE(test::contains(message, "has 1073741824 slots for 1 learnt views, expected at most 16 for each"));
}

}  // namespace
}  // namespace foothold
