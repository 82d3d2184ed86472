// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <vector>

#include "clustering/leaf_modes.h"
#include "features/leaf_lookup_kernels.h"
#include "foothold/base/exec/cpu_executor.h"
#include "forest/device_forest.h"
#include "pose/pool_kernels.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Every second leaf has as many modes as its number says, whose means tell whose they are.
LeafModes numbered_modes(const Context& context, int num_leaves) {
  ClusteringSettings settings;
  LeafModes modes(context, num_leaves, settings);
  const LeafModesView view = modes.view();
  std::int32_t next_block = 0;
  for (std::uint32_t leaf = 0; leaf < static_cast<std::uint32_t>(num_leaves); leaf += 2) {
    view.num_modes[leaf] = leaf % 8;
    for (std::uint32_t k = 0; k < leaf % 8; ++k) {
      if (k % kModeBlockSize == 0) view.modes.own(leaf, static_cast<int>(k) / kModeBlockSize, static_cast<std::uint32_t>(next_block++));
      Mode mode{};
      mode.mean_m[0] = static_cast<float>(leaf);
      mode.mean_m[1] = static_cast<float>(k);
      view.modes.at(leaf, static_cast<int>(k)) = mode;
    }
  }
  return modes;
}

struct Filled {
  std::uint32_t num_pixels;
  std::vector<PooledPixel> pixels;
  std::vector<Mode> modes;
};

Filled filled(const std::vector<std::size_t>& ends) {
  const Context context = test::context_of(1);
  const Forest forest = test::small_forest();
  const DeviceForest device_forest(context.memory(), forest, 1);
  LeafModes modes = numbered_modes(context, forest.num_leaves());
  const Frame frame = test::office()[0].view();
  FeatureImage image(context);
  image.compute(context, frame, 2);
  const PoseQuery query{frame, image};
  CorrespondencePool pool(context.memory(), static_cast<int>(ends.back()));
  pool.make_room(forest.num_trees(), 12);
  sample_pool(CpuExecutor(context), query, 42, pool);
  for (const std::size_t end : ends) fill_pool<CpuExecutor>(context, query, modes.view(), device_forest.view(), end, pool);
  const CorrespondencePoolView view = pool.view();
  Filled result{*view.num_pixels, {view.pixels, view.pixels + *view.num_pixels}, {}};
  for (const PooledPixel& pixel : result.pixels) {
    for (std::uint32_t m = 0; m < pixel.num_modes; ++m) result.modes.push_back(view.modes[pixel.first_mode + m]);
  }
  return result;
}

TEST_CASE("fill_pool: in parts or at once, the pool holds the same") {
  const Filled at_once = filled({1000});
  REQUIRE(at_once.num_pixels > 500);
  REQUIRE(at_once.modes.size() > 1000);
  for (const std::vector<std::size_t>& ends : {std::vector<std::size_t>{300, 1000}, {1, 299, 303, 1000}}) {
    const Filled in_parts = filled(ends);
    REQUIRE(in_parts.num_pixels == at_once.num_pixels);
    for (std::size_t i = 0; i < at_once.pixels.size(); ++i) {
      REQUIRE(in_parts.pixels[i].first_mode == at_once.pixels[i].first_mode);
      REQUIRE(in_parts.pixels[i].num_modes == at_once.pixels[i].num_modes);
      for (int k = 0; k < 3; ++k) REQUIRE(in_parts.pixels[i].point_camera[k] == at_once.pixels[i].point_camera[k]);
    }
    REQUIRE(in_parts.modes.size() == at_once.modes.size());
    for (std::size_t i = 0; i < at_once.modes.size(); ++i) {
      REQUIRE(in_parts.modes[i].mean_m[0] == at_once.modes[i].mean_m[0]);
      REQUIRE(in_parts.modes[i].mean_m[1] == at_once.modes[i].mean_m[1]);
    }
  }
}

}  // namespace
}  // namespace foothold
