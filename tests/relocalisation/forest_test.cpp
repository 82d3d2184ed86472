// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/forest.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "foothold/base/error.h"
#include "foothold/synthetic/room.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

/// The parts of a small valid forest: one tree with a split at the root and one at its left child.
struct Parts {
  std::vector<ForestFeature> features = {{FeatureChannel::kDepth, 1.0F, 2.0F}, {FeatureChannel::kBlue, -3.0F, 0.5F}};
  std::vector<ForestNode> nodes = {{1, 0, 10}, {3, 1, -5}, {~0, 0, 0}, {~1, 0, 0}, {~2, 0, 0}};
  std::vector<std::int32_t> roots = {0};

  Forest build() const { return Forest(features, nodes, roots, "by hand"); }
  std::string error() const {
    return test::error_message<InvalidSettings>([&] { build(); });
  }
};

TEST_CASE("Forest: counts trees, leaves and depth") {
  const Forest forest = Parts{}.build();
  REQUIRE(forest.num_trees() == 1);
  REQUIRE(forest.num_leaves() == 3);
  REQUIRE(forest.depth() == 2);
  REQUIRE(forest.provenance() == "by hand");
  const ForestView view = forest.view();
  REQUIRE(view.nodes == forest.nodes().data());
  REQUIRE(view.features == forest.features().data());
  REQUIRE(view.roots == forest.roots().data());
  REQUIRE(view.num_trees == 1);
  REQUIRE(view.num_leaves == 3);
}

TEST_CASE("Forest: a single leaf is a tree") {
  const Forest forest({}, {{~0, 0, 0}}, {0}, "");
  REQUIRE(forest.num_leaves() == 1);
  REQUIRE(forest.depth() == 0);
}

TEST_CASE("Forest: rejects what is inconsistent, and says what") {
  Parts parts;
  SECTION("no trees") {
    parts.roots.clear();
    REQUIRE(test::contains(parts.error(), "no trees"));
  }
  SECTION("channels that do not exist") {
    for (const std::int32_t channel : {-1, 4, 1000}) {
      parts.features[1].channel = static_cast<FeatureChannel>(channel);
      REQUIRE(test::contains(parts.error(), "channel is " + std::to_string(channel)));
    }
  }
  SECTION("offsets that are not finite or absurd") {
    for (const float offset : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e9F}) {
      parts.features[1].offset_u_px_m = offset;
      REQUIRE(test::contains(parts.error(), "offset"));
      parts.features[1].offset_u_px_m = 0.0F;
      parts.features[0].offset_v_px_m = offset;
      REQUIRE(test::contains(parts.error(), "offset"));
      parts.features[0].offset_v_px_m = 0.0F;
    }
  }
  SECTION("features that do not exist") {
    parts.nodes[1].feature = 2;
    REQUIRE(test::contains(parts.error(), "node 1 uses feature 2"));
  }
  SECTION("roots that do not exist") {
    for (const std::int32_t root : {-1, 5, std::numeric_limits<std::int32_t>::max()}) {
      parts.roots = {root};
      REQUIRE(test::contains(parts.error(), "node " + std::to_string(root) + " is out of range"));
    }
  }
  SECTION("children that do not exist") {
    parts.nodes[1].left_child = 4;  // the right sibling would be node 5
    REQUIRE(test::contains(parts.error(), "node 5 is out of range"));
    parts.nodes[1].left_child = std::numeric_limits<std::int32_t>::max();
    REQUIRE(test::contains(parts.error(), "is out of range"));
  }
  SECTION("loops and shared children") {
    parts.nodes[1].left_child = 0;
    REQUIRE(test::contains(parts.error(), "two parents"));
    parts.nodes[1].left_child = 1;
    REQUIRE(test::contains(parts.error(), "two parents"));
    parts.nodes[1].left_child = 2;
    REQUIRE(test::contains(parts.error(), "two parents"));
    parts = {};
    parts.roots = {0, 0};
    REQUIRE(test::contains(parts.error(), "two parents"));
  }
  SECTION("leaves that appear twice or have absurd numbers") {
    parts.nodes[3].left_child = ~0;
    REQUIRE(test::contains(parts.error(), "appears twice"));
    parts.nodes[3].left_child = std::numeric_limits<std::int32_t>::min();
    REQUIRE(test::contains(parts.error(), "out of range"));
    parts.nodes[3].left_child = ~5;
    REQUIRE(test::contains(parts.error(), "out of range"));
  }
}

TEST_CASE("Forest::fingerprint: depends on features, nodes and roots, not on the provenance") {
  const Parts parts;
  const std::uint64_t fingerprint = parts.build().fingerprint();
  REQUIRE(Forest(parts.features, parts.nodes, parts.roots, "elsewhere").fingerprint() == fingerprint);
  Parts changed = parts;
  changed.features[0].offset_u_px_m = 1.5F;
  REQUIRE(changed.build().fingerprint() != fingerprint);
  changed = parts;
  changed.nodes[0].threshold = 11;
  REQUIRE(changed.build().fingerprint() != fingerprint);
  const std::vector<ForestNode> leaves = {{~0, 0, 0}, {~1, 0, 0}};
  REQUIRE(Forest({}, leaves, {0, 1}, "").fingerprint() != Forest({}, leaves, {1, 0}, "").fingerprint());
}

TEST_CASE("make_random_forest: trees are complete, and leaf numbers run through all of them") {
  RandomForestSettings settings;
  settings.num_trees = 3;
  settings.depth = 5;
  const Forest forest = make_random_forest(settings);
  REQUIRE(forest.num_trees() == 3);
  REQUIRE(forest.depth() == 5);
  REQUIRE(forest.num_leaves() == 3 * 32);
  REQUIRE(forest.nodes().size() == 3 * 63);
  // Walks to every leaf: 32 a tree, each after 5 splits.
  for (int tree = 0; tree < 3; ++tree) {
    for (int path = 0; path < 32; ++path) {
      std::int32_t node = forest.roots()[static_cast<std::size_t>(tree)];
      for (int split = 0; split < 5; ++split) {
        REQUIRE(forest.nodes()[static_cast<std::size_t>(node)].left_child >= 0);
        node = forest.nodes()[static_cast<std::size_t>(node)].left_child + (path >> (4 - split)) % 2;
      }
      REQUIRE(~forest.nodes()[static_cast<std::size_t>(node)].left_child == tree * 32 + path);
    }
  }
}

TEST_CASE("make_random_forest: features and thresholds follow the settings") {
  const RandomForestSettings settings;
  const Forest forest = make_random_forest(settings);
  REQUIRE(forest.num_trees() == 5);
  REQUIRE(forest.num_leaves() == 5 * 8192);
  REQUIRE(forest.features().size() == 256);
  int num_depth = 0;
  bool colours[4] = {};
  for (const ForestFeature& feature : forest.features()) {
    const double radius = std::hypot(feature.offset_u_px_m, feature.offset_v_px_m);
    REQUIRE(radius > settings.min_offset_px_m - 1e-3);
    REQUIRE(radius < settings.max_offset_px_m + 1e-3);
    num_depth += feature.channel == FeatureChannel::kDepth ? 1 : 0;
    colours[static_cast<int>(feature.channel)] = true;
  }
  REQUIRE(num_depth == 128);
  REQUIRE((colours[1] && colours[2] && colours[3]));
  // The mean absolute value of a Laplace distribution is its scale; with about 20,000 draws of each kind it is known to 1 %.
  double sums[2] = {};
  int counts[2] = {};
  for (const ForestNode& node : forest.nodes()) {
    if (node.left_child < 0) continue;
    const int kind = forest.features()[node.feature].channel == FeatureChannel::kDepth ? 0 : 1;
    sums[kind] += std::abs(node.threshold);
    ++counts[kind];
  }
  constexpr double kFourSigma = 0.04;
  REQUIRE(sums[0] / counts[0] == Approx(300.0).epsilon(kFourSigma));
  REQUIRE(sums[1] / counts[1] == Approx(25.0).epsilon(kFourSigma));
}

TEST_CASE("make_random_forest: a function of its settings alone") {
  RandomForestSettings settings;
  settings.depth = 6;
  const Forest forest = make_random_forest(settings);
  REQUIRE(make_random_forest(settings).fingerprint() == forest.fingerprint());
  REQUIRE(test::contains(forest.provenance(), "depth = 6"));
  REQUIRE(test::contains(forest.provenance(), "seed = 42"));
  settings.seed = 43;
  REQUIRE(make_random_forest(settings).fingerprint() != forest.fingerprint());
}

TEST_CASE("make_random_forest: the default settings give the forest that saved scenes refer to") {
  REQUIRE(make_random_forest({}).fingerprint() == 11778252148758534234ULL);
}

TEST_CASE("default_forest: is the one that saved scenes refer to and that docs/forest-training.md documents") {
  // Scenes saved with the default forest can be loaded only while this number stays.
  const Forest forest = default_forest();
  REQUIRE(forest.fingerprint() == 0xfe97c427631feb44ULL);
  REQUIRE(forest.num_trees() == 5);
  REQUIRE(forest.num_leaves() == 40686);
  REQUIRE(forest.features().size() == 256);
  for (const char* line : {"trainer version 1\n", "agreement_weight = 4\n", "seed = 42\n", "data hash = 630748bc9a99de00", "commit = "})
    REQUIRE(test::contains(forest.provenance(), line));
  // It was trained on rooms that nobody is tested in.
  REQUIRE(test::contains(forest.provenance(), "sequence = synthetic:training-19?frames=1200"));
  for (const std::string& room : synthetic_room_names()) REQUIRE_FALSE(test::contains(forest.provenance(), "synthetic:" + room));
}

}  // namespace
}  // namespace foothold
