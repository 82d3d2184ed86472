// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "reservoirs/leaf_reservoirs.h"

#include <cstring>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/checked_bytes.h"
#include "support/mend_checksums.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

Context context_of(int num_threads) {
  ContextOptions options;
  options.num_threads = num_threads;
  return Context(options);
}

ReservoirSettings small_reservoirs(int capacity) {
  ReservoirSettings settings;
  settings.capacity = capacity;
  return settings;
}

/// A point that carries its number.
ReservoirPoint numbered_point(std::uint32_t number) {
  return {static_cast<std::int16_t>(number & 0x7fffU), static_cast<std::int16_t>((number >> 15U) & 0x7fffU), 7,
          static_cast<std::uint16_t>(number * 31U)};
}
std::uint32_t number_of(const ReservoirPoint& point) {
  return static_cast<std::uint32_t>(point.x_mm) | static_cast<std::uint32_t>(point.y_mm) << 15U;
}

/// Examples numbered from `first`, each in one random leaf per tree; every tenth has none.
TrainingExamples random_examples(Random& random, std::uint32_t first, std::size_t count, int num_trees, int num_leaves) {
  TrainingExamples examples(MemoryKind::kHost);
  examples.pixels.resize(count);
  examples.points.resize(count);
  examples.leaves.resize(count * static_cast<std::size_t>(num_trees));
  for (std::size_t i = 0; i < count; ++i) {
    examples.pixels[i] = {0, 0, 1.0F};
    examples.points[i] = numbered_point(first + static_cast<std::uint32_t>(i));
  }
  const auto leaves_per_tree = static_cast<std::uint32_t>(num_leaves / num_trees);
  for (std::size_t i = 0; i < examples.leaves.size(); ++i) {
    const auto tree = static_cast<std::uint32_t>(i / count);
    examples.leaves[i] =
        i % count % 10 == 9 ? static_cast<std::uint32_t>(num_leaves) : tree * leaves_per_tree + random.below(leaves_per_tree);
  }
  return examples;
}

std::vector<ReservoirPoint> points_of(const LeafReservoirsView& view, std::uint32_t leaf) {
  std::vector<ReservoirPoint> points;
  for (int i = 0; i < view.num_stored(leaf); ++i) points.push_back(view.point(leaf, i));
  return points;
}

bool same(const ReservoirPoint& a, const ReservoirPoint& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

void require_same(LeafReservoirs& a, LeafReservoirs& b) {
  const LeafReservoirsView va = a.view();
  const LeafReservoirsView vb = b.view();
  REQUIRE(va.num_leaves == vb.num_leaves);
  for (int leaf = 0; leaf < va.num_leaves; ++leaf) {
    const auto l = static_cast<std::uint32_t>(leaf);
    REQUIRE(va.num_seen[leaf] == vb.num_seen[leaf]);
    REQUIRE(va.num_changed[leaf] == vb.num_changed[leaf]);
    bool equal = true;
    for (int i = 0; i < va.num_stored(l); ++i) equal = equal && same(va.point(l, i), vb.point(l, i));
    REQUIRE(equal);
  }
}

TEST_CASE("LeafReservoirs: below its capacity a leaf keeps every point, in order") {
  Random random = test::test_random();
  constexpr int kLeaves = 60;
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, kLeaves, small_reservoirs(1024), 42);
  std::vector<std::vector<ReservoirPoint>> expected(kLeaves);
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    const TrainingExamples examples = random_examples(random, 1000 * frame, 300, 3, kLeaves);
    for (std::size_t i = 0; i < examples.leaves.size(); ++i) {
      if (examples.leaves[i] < kLeaves) expected[examples.leaves[i]].push_back(examples.points[i % 300]);
    }
    reservoirs.insert(context, examples);
    for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
      const std::vector<ReservoirPoint> found = points_of(reservoirs.view(), leaf);
      REQUIRE(found.size() == expected[leaf].size());
      REQUIRE(reservoirs.view().num_seen[leaf] == found.size());
      REQUIRE(reservoirs.view().num_changed[leaf] == found.size());
      for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(same(found[i], expected[leaf][i]));
    }
  }
}

TEST_CASE("LeafReservoirs: stores min(seen, capacity) points, each offered to that leaf and none twice") {
  Random random = test::test_random();
  constexpr int kLeaves = 20;
  constexpr int kCapacity = 40;
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, kLeaves, small_reservoirs(kCapacity), 42);
  std::vector<std::set<std::uint32_t>> offered(kLeaves);
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    const TrainingExamples examples = random_examples(random, 1000 * frame, 200, 2, kLeaves);
    for (std::size_t i = 0; i < examples.leaves.size(); ++i) {
      if (examples.leaves[i] < kLeaves) offered[examples.leaves[i]].insert(number_of(examples.points[i % 200]));
    }
    reservoirs.insert(context, examples);
    for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
      REQUIRE(reservoirs.view().num_seen[leaf] == offered[leaf].size());
      std::set<std::uint32_t> stored;
      for (const ReservoirPoint& point : points_of(reservoirs.view(), leaf)) {
        REQUIRE(offered[leaf].count(number_of(point)) == 1);
        REQUIRE(point.z_mm == 7);
        REQUIRE(point.rgb565 == static_cast<std::uint16_t>(number_of(point) * 31U));
        stored.insert(number_of(point));
      }
      REQUIRE(stored.size() == std::min<std::size_t>(offered[leaf].size(), kCapacity));
    }
  }
}

TEST_CASE("LeafReservoirs: thinning keeps every second point, none of leaves with few, and what follows is appended") {
  Random random = test::test_random();
  constexpr int kLeaves = 60;
  constexpr int kMinPoints = 8;
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, kLeaves, small_reservoirs(80), 42);
  for (std::uint32_t frame = 0; frame < 6; ++frame)
    reservoirs.insert(context, random_examples(random, 1000 * frame, 200 + 100 * frame, 2, kLeaves));
  const std::size_t num_bytes = reservoirs.state_bytes(context);
  std::vector<std::vector<ReservoirPoint>> before;
  for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) before.push_back(points_of(reservoirs.view(), leaf));
  REQUIRE(reservoirs.thin(context, kMinPoints));
  REQUIRE(reservoirs.state_bytes(context) < num_bytes);
  for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
    const std::vector<ReservoirPoint> kept = points_of(reservoirs.view(), leaf);
    REQUIRE(kept.size() == (before[leaf].size() < kMinPoints ? 0 : before[leaf].size() / 2));
    REQUIRE(reservoirs.view().num_seen[leaf] == kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) REQUIRE(same(kept[i], before[leaf][2 * i]));
  }
  const std::string saved = test::checked_bytes([&](CheckedWriter& writer) { reservoirs.save(writer); });
  LeafReservoirs loaded(context, kLeaves, small_reservoirs(80), 42);
  test::read_checked(saved, [&](CheckedReader& reader) { loaded.load(reader); });
  require_same(loaded, reservoirs);

  const TrainingExamples more = random_examples(random, 9000, 100, 2, kLeaves);
  reservoirs.insert(context, more);
  loaded.insert(context, more);
  require_same(loaded, reservoirs);
}

TEST_CASE("LeafReservoirs: thinning changes nothing where it would give back little") {
  Random random = test::test_random();
  constexpr int kLeaves = 60;
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, kLeaves, small_reservoirs(80), 42);
  REQUIRE_FALSE(reservoirs.thin(context, 8));
  for (std::uint32_t frame = 0; frame < 6; ++frame) reservoirs.insert(context, random_examples(random, 1000 * frame, 500, 2, kLeaves));
  int num_times = 0;
  while (reservoirs.thin(context, 1)) ++num_times;
  REQUIRE(num_times == 3);  // 80 to 40, 20 and 10 points: one block
  for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) REQUIRE(reservoirs.view().num_seen[leaf] <= 10);
}

TEST_CASE("LeafReservoirs: every point offered is kept equally likely") {
  constexpr int kLeaves = 4000;
  constexpr std::uint32_t kOffered = 96;
  constexpr int kCapacity = 16;
  const Context context = context_of(2);
  LeafReservoirs reservoirs(context, kLeaves, small_reservoirs(kCapacity), 42);
  // Each frame offers one point to each leaf; points carry the number of their frame.
  for (std::uint32_t k = 0; k < kOffered; ++k) {
    TrainingExamples examples(MemoryKind::kHost);
    examples.points.resize(kLeaves);
    examples.leaves.resize(kLeaves);
    for (std::uint32_t i = 0; i < kLeaves; ++i) {
      examples.points[i] = numbered_point(k);
      examples.leaves[i] = i;
    }
    reservoirs.insert(context, examples);
  }
  std::vector<double> kept(kOffered);
  for (std::uint32_t leaf = 0; leaf < kLeaves; ++leaf) {
    for (const ReservoirPoint& point : points_of(reservoirs.view(), leaf)) kept[number_of(point)] += 1.0;
  }
  const double p = static_cast<double>(kCapacity) / kOffered;
  double chi2 = 0.0;
  for (const double count : kept) chi2 += (count - kLeaves * p) * (count - kLeaves * p) / (kLeaves * p * (1.0 - p));
  // Chi-square with 95 degrees of freedom: mean 95, standard deviation 13.8. Five of them either way.
  REQUIRE(chi2 < 95.0 + 5 * 13.8);
  REQUIRE(chi2 > 95.0 - 5 * 13.8);
}

TEST_CASE("LeafReservoirs: the same whatever the number of threads") {
  constexpr int kLeaves = 500;
  std::vector<LeafReservoirs> all;
  for (const int num_threads : {1, 2, 4}) {
    Random random = test::test_random();
    const Context context = context_of(num_threads);
    all.emplace_back(context, kLeaves, small_reservoirs(50), 42);
    for (std::uint32_t frame = 0; frame < 6; ++frame) all.back().insert(context, random_examples(random, 5000 * frame, 5000, 5, kLeaves));
  }
  const Context context = context_of(1);
  REQUIRE(all[0].state_bytes(context) == all[1].state_bytes(context));
  REQUIRE(all[0].state_bytes(context) == all[2].state_bytes(context));
  require_same(all[0], all[1]);
  require_same(all[0], all[2]);
}

/// One leaf that was offered `num_seen` points, of which it stores `capacity`, and is then offered 1000 more.
LeafReservoirs seen_often(const Context& context, int capacity, std::uint32_t num_seen) {
  LeafReservoirs reservoirs(context, 1, small_reservoirs(capacity), 42);
  TrainingExamples examples(MemoryKind::kHost);
  const auto offer = [&](std::uint32_t first, std::size_t count) {
    examples.points.resize(count);
    examples.leaves.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      examples.points[i] = numbered_point(first + static_cast<std::uint32_t>(i));
      examples.leaves[i] = 0;
    }
    reservoirs.insert(context, examples);
  };
  offer(0, static_cast<std::size_t>(capacity));
  reservoirs.view().num_seen[0] = num_seen;
  reservoirs.view().num_changed[0] = 0;
  offer(10000, 1000);
  return reservoirs;
}

TEST_CASE("LeafReservoirs: a leaf that is offered points for ever stays within its bounds, and stops counting before its count wraps") {
  constexpr int kCapacity = 32;
  constexpr std::uint32_t kMax = ~std::uint32_t{0};
  const Context context = context_of(1);
  for (const std::uint32_t num_seen : {0x7ffffff0U, 0x80000000U, 0xc0000000U, kMax - 1000, kMax - 500, kMax - 1, kMax}) {
    LeafReservoirs reservoirs = seen_often(context, kCapacity, num_seen);
    const LeafReservoirsView view = reservoirs.view();
    INFO(num_seen);
    REQUIRE(view.num_seen[0] == (num_seen < kMax - 1000 ? num_seen + 1000 : kMax));
    REQUIRE(view.num_stored(0) == kCapacity);
    REQUIRE(view.num_changed[0] == 0);  // the chance of any of 1000 being kept is 1 in 67,000; whether one is depends on the seed alone
    for (int i = 0; i < kCapacity; ++i) REQUIRE(number_of(view.point(0, i)) == static_cast<std::uint32_t>(i));
  }
}

TEST_CASE("LeafReservoirs: clear forgets everything") {
  Random random = test::test_random();
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, 100, small_reservoirs(32), 42);
  const std::size_t empty = reservoirs.state_bytes(context);
  LeafReservoirs fresh(context, 100, small_reservoirs(32), 42);
  reservoirs.insert(context, random_examples(random, 0, 1000, 5, 100));
  REQUIRE(reservoirs.state_bytes(context) > empty);
  reservoirs.clear();
  REQUIRE(reservoirs.state_bytes(context) == empty);
  require_same(reservoirs, fresh);
}

std::string saved(const LeafReservoirs& reservoirs) {
  return test::checked_bytes([&](CheckedWriter& writer) { reservoirs.save(writer); });
}

void load(LeafReservoirs& reservoirs, const std::string& bytes) {
  test::read_checked(bytes, [&](CheckedReader& reader) { reservoirs.load(reader); });
}

TEST_CASE("LeafReservoirs: load restores what save wrote, and both go on alike") {
  Random random = test::test_random();
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, 100, small_reservoirs(32), 42);
  reservoirs.insert(context, random_examples(random, 0, 1000, 5, 100));
  const std::string bytes = saved(reservoirs);
  LeafReservoirs copy(context, 100, small_reservoirs(32), 42);
  load(copy, bytes);
  REQUIRE((saved(copy) == bytes));
  require_same(reservoirs, copy);
  const TrainingExamples more = random_examples(random, 5000, 1000, 5, 100);
  reservoirs.insert(context, more);
  copy.insert(context, more);
  require_same(reservoirs, copy);
  REQUIRE((saved(copy) == saved(reservoirs)));
}

TEST_CASE("LeafReservoirs: refuses damaged data and keeps what it had") {
  Random random = test::test_random();
  const Context context = context_of(1);
  LeafReservoirs reservoirs(context, 20, small_reservoirs(32), 42);
  reservoirs.insert(context, random_examples(random, 0, 150, 2, 20));
  const std::string good = saved(reservoirs);
  const auto require_refused = [&](const std::string& bytes) {
    REQUIRE_THROWS_AS(load(reservoirs, bytes), FileError);
    REQUIRE((saved(reservoirs) == good));
  };
  for (std::size_t length = 0; length < good.size(); length += 1 + length / 50) require_refused(good.substr(0, length));
  require_refused(good.substr(0, good.size() - 1));
  // Arrays of 20 counts, 20 changes, 40 block references, and blocks, each after their number.
  const auto with_value = [&](std::size_t offset, auto value) {
    std::string bytes = good;
    std::memcpy(&bytes[offset], &value, sizeof(value));
    return test::with_right_checksums(bytes);
  };
  constexpr std::size_t kCounts = test::kContents;
  constexpr std::size_t kChanges = kCounts + 8 + 80;
  constexpr std::size_t kBlocks = kChanges + 8 + 80;
  constexpr std::size_t kPool = kBlocks + 8 + 160;
  for (const std::size_t offset : {kCounts, kChanges, kBlocks, kPool}) {
    require_refused(with_value(offset, std::uint64_t{3}));
    require_refused(with_value(offset, ~std::uint64_t{0}));
  }
  require_refused(with_value(kBlocks + 8, std::int32_t{-1}));
  require_refused(with_value(kBlocks + 8, std::int32_t{1000}));
  // Two leaves must not share a block, nor blocks be left over that later growth would run out of.
  std::int32_t other = 0;
  std::memcpy(&other, &good[kBlocks + 8 + 8], sizeof(other));
  require_refused(with_value(kBlocks + 8, other));
  require_refused(with_value(kCounts + 8, std::uint32_t{0}));
}

}  // namespace
}  // namespace foothold
