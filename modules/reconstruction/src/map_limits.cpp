// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "map_limits.h"

#include <cmath>
#include <string>

#include "foothold/base/settings.h"

namespace foothold {

void MapLimits::watch(const Frame& frame, const TsdfSettings& volume, const Context& context, FusionFrameResult& result) {
  const bool is_readable = frame.depth.memory == MemoryKind::kHost && !frame.depth.empty();
  if (is_readable) watch_range(frame, volume, context, result);
  if (result.world_from_camera.has_value()) watch_reach(*result.world_from_camera, volume, context);
  if (result.num_blocks_refused == 0 || told_full_) return;
  told_full_ = true;
  context.log(LogLevel::kWarning, "the map is full: it holds fusion.volume.max_blocks = " + std::to_string(volume.max_blocks) +
                                      ", and frame " + std::to_string(frame.index) + " wanted " +
                                      std::to_string(result.num_blocks_refused) +
                                      " more; what is new is left out from here on, and tracking fails there");
}

void MapLimits::watch_reach(const SE3& world_from_camera, const TsdfSettings& volume, const Context& context) {
  const float coordinate_m = world_from_camera.translation.cwiseAbs().maxCoeff();
  if (told_reach_ || coordinate_m + volume.max_depth_m <= volume.reach_m()) return;
  told_reach_ = true;
  context.log(LogLevel::kWarning,
              "the camera is " + std::to_string(std::lround(coordinate_m)) +
                  " m from the map's origin along an axis; with fusion.volume.voxel_size_m = " + detail::to_text(volume.voxel_size_m) +
                  " the map ends at " + std::to_string(std::lround(volume.reach_m())) + " m, and what is beyond is left out");
}

void MapLimits::watch_range(const Frame& frame, const TsdfSettings& volume, const Context& context, FusionFrameResult& result) {
  constexpr int kStep = 4;          // pixels looked at, in both directions
  constexpr double kTooMuch = 0.5;  // of all depth so far
  int num_measured = 0;
  int num_out = 0;
  for (int v = 0; v < frame.depth.height; v += kStep) {
    for (int u = 0; u < frame.depth.width; u += kStep) {
      const float z = frame.depth(u, v);
      num_measured += is_valid_depth(z) ? 1 : 0;
      num_out += is_valid_depth(z) && !volume.depth_range().holds(z) ? 1 : 0;
    }
  }
  if (num_measured == 0) return;
  result.out_of_range_fraction = static_cast<float>(num_out) / static_cast<float>(num_measured);
  num_measured_ += num_measured;
  num_out_of_range_ += num_out;
  const double fraction = num_out_of_range_ / num_measured_;
  if (told_range_ || fraction <= kTooMuch) return;
  told_range_ = true;
  context.log(LogLevel::kWarning, std::to_string(std::lround(100.0 * fraction)) + " % of the depth until frame " +
                                      std::to_string(frame.index) +
                                      " lies outside of fusion.volume.min_depth_m = " + detail::to_text(volume.min_depth_m) +
                                      " to fusion.volume.max_depth_m = " + detail::to_text(volume.max_depth_m) + ", and is not used");
}

}  // namespace foothold
