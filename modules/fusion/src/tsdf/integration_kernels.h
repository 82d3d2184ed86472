// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Averaging a frame into the blocks it sees.
#pragma once

#include <cfloat>

#include "foothold/base/exec/prefetch.h"
#include "tsdf/allocation_kernels.h"
#include "tsdf/block_extent.h"

namespace foothold {

inline constexpr int kDepthTilePx = 16;

/// The largest usable depth [m] in each tile of 16 x 16 pixels; 0 without one.
struct FindTileDepths {
  PosedDepth camera;
  int num_columns;
  float* max_depths_m;

  FOOTHOLD_HD void operator()(std::size_t tile) const {
    const int u0 = static_cast<int>(tile) % num_columns * kDepthTilePx;
    const int v0 = static_cast<int>(tile) / num_columns * kDepthTilePx;
    const int u1 = u0 + kDepthTilePx < camera.depth.width ? u0 + kDepthTilePx : camera.depth.width;
    const int v1 = v0 + kDepthTilePx < camera.depth.height ? v0 + kDepthTilePx : camera.depth.height;
    float columns[kDepthTilePx] = {};  // apart, so that the compiler takes several at once
    for (int v = v0; v < v1; ++v) {
      const float* const row = camera.depth.data + static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.depth.width) + u0;
      for (int i = 0; i < u1 - u0; ++i) {
        const float candidate_m = (row[i] >= camera.range.min_m) & (row[i] <= camera.range.max_m) ? row[i] : 0.0F;
        columns[i] = candidate_m > columns[i] ? candidate_m : columns[i];
      }
    }
    float max_depth_m = 0.0F;
    for (const float depth_m : columns) max_depth_m = depth_m > max_depth_m ? depth_m : max_depth_m;
    max_depths_m[tile] = max_depth_m;
  }
};

/// Averages one frame into one block; blocks out of view or behind what the camera sees are left alone.
///
/// Distance is measured along the optical axis: depth at the voxel's pixel minus the voxel's own. `kWidth` consecutive voxels are processed
/// side by side: a layer of a block on the host, whose loops the compiler vectorises, and one voxel per lane on the device.
template <int kWidth>
struct IntegrateBlock {
  TsdfView volume;
  PosedDepth camera;
  SE3 camera_from_world;
  ColourView colour;
  Intrinsics colour_intrinsics;
  SE3 colour_from_world;
  const float* tile_depths_m;
  int num_tile_columns;
  int max_weight;
  std::uint8_t* surface_octants;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t index) const {
    const BlockCoordinates coordinates = unpack_key(volume.block_keys[index]);
    const float side_m = volume.voxel_size_m * static_cast<float>(kBlockSide);
    const Eigen::Vector3f corner_world(static_cast<float>(coordinates.x) * side_m, static_cast<float>(coordinates.y) * side_m,
                                       static_cast<float>(coordinates.z) * side_m);
    if (!in_view(corner_world, side_m)) return;

    VoxelBlock& block = volume.block(static_cast<int>(index));
    if constexpr (kWidth > 1) {
      for (int voxel = 0; voxel < kBlockVoxels; voxel += 32) prefetch(block.distance + voxel);
      for (int voxel = 0; voxel < kBlockVoxels; voxel += 64) prefetch(block.weight + voxel);
    }
    const Eigen::Vector3f corner = camera_from_world * corner_world;
    const Eigen::Matrix3f step = camera_from_world.rotation * volume.voxel_size_m;
    int num_near_surface[8] = {};
    for (int first = team.lane() * kWidth; first < kBlockVoxels; first += team.size() * kWidth) {
      Voxels voxels;
      const bool any_seen = observe(first, corner, step, voxels);
      for (int i = 0; i < kWidth; ++i) voxels.distance[i] = static_cast<float>(block.distance[first + i]);
      if (any_seen && update(block, first, voxels)) colour_voxels(block, first, voxels, corner_world);
      count_near_surface(first, voxels, num_near_surface);
    }
    team.sum_all(num_near_surface);
    if (team.lane() != 0) return;
    unsigned octants = 0;
    for (int octant = 0; octant < 8; ++octant) octants |= (num_near_surface[octant] > 0 ? 1U : 0U) << static_cast<unsigned>(octant);
    surface_octants[index] = static_cast<std::uint8_t>(octants);
  }

 private:
  /// Voxels of one row that are processed side by side.
  static constexpr int kRow = kWidth < kBlockSide ? kWidth : kBlockSide;
  /// Voxels this near to the surface take part in its colour [voxels].
  static constexpr float kColourBand = 1.8F;
  /// Voxels this near to the surface may belong to a cell that it passes through [voxels]: the diagonal of a cell, and as much again for
  /// noise.
  static constexpr float kSurfaceBand = 3.0F;

  struct Voxels {
    float
        ahead[kWidth];  ///< distance from the voxel to the surface along the optical axis, as stored; -FLT_MAX where the frame says nothing
    float distance[kWidth];       ///< the old value, then the new one
    std::int32_t colour[kWidth];  ///< 1 where the voxel takes part in colour
  };

  FOOTHOLD_HD bool in_view(const Eigen::Vector3f& corner_world, float side_m) const {
    const Eigen::Vector3f half = Eigen::Vector3f::Constant(0.5F * side_m);
    const Eigen::Vector3f centre = camera_from_world * (corner_world + half);
    const BlockExtent extent = bound_projection(centre, kHalfDiagonal * side_m, camera.intrinsics, camera.depth.width, camera.depth.height);
    if (!extent.visible() || extent.z_near > camera.range.max_m + volume.truncation_m) return false;
    for (int v = extent.v_min / kDepthTilePx; v <= extent.v_max / kDepthTilePx; ++v) {
      for (int u = extent.u_min / kDepthTilePx; u <= extent.u_max / kDepthTilePx; ++u) {
        const float depth_m = tile_depths_m[v * num_tile_columns + u];
        if (depth_m > 0.0F && extent.z_near <= depth_m + volume.truncation_m) return true;
      }
    }
    return false;
  }

  /// Projects voxels into the depth image; returns whether the frame says anything of them.
  FOOTHOLD_HD bool observe(int first, const Eigen::Vector3f& corner, const Eigen::Matrix3f& step, Voxels& voxels) const {
    const float width = static_cast<float>(camera.depth.width);
    const float height = static_cast<float>(camera.depth.height);
    const float fx = camera.intrinsics.fx;
    const float fy = camera.intrinsics.fy;
    const float cx = camera.intrinsics.cx + 0.5F;
    const float cy = camera.intrinsics.cy + 0.5F;
    const int columns = camera.depth.width;
    const float* const depth = camera.depth.data;
    const float to_stored = kStoredOne / volume.truncation_m;
    const float min_depth_m = camera.range.min_m;
    const float max_depth_m = camera.range.max_m;
    std::int32_t pixels[kWidth];
    float z_m[kWidth];
    for (int row = 0; row < kWidth; row += kRow) {
      const float b = static_cast<float>(((first + row) >> 3) & 7);
      const float c = static_cast<float>((first + row) >> 6);
      for (int i = 0; i < kRow; ++i) {
        const float a = static_cast<float>((first + i) & 7);
        const float x = corner[0] + a * step(0, 0) + b * step(0, 1) + c * step(0, 2);
        const float y = corner[1] + a * step(1, 0) + b * step(1, 1) + c * step(1, 2);
        const float z = corner[2] + a * step(2, 0) + b * step(2, 1) + c * step(2, 2);
        const float inverse = 1.0F / z;
        const float u = fx * x * inverse + cx;
        const float v = fy * y * inverse + cy;
        const bool inside = (z > 0.0F) & (u >= 0.0F) & (v >= 0.0F) & (u < width) & (v < height);
        pixels[row + i] = static_cast<std::int32_t>(inside ? v : 0.0F) * columns + static_cast<std::int32_t>(inside ? u : 0.0F);
        z_m[row + i] = inside ? z : FLT_MAX;
      }
    }
    std::int32_t num_seen = 0;
    for (int i = 0; i < kWidth; ++i) {
      const float depth_m = depth[pixels[i]];
      const bool usable = (depth_m >= min_depth_m) & (depth_m <= max_depth_m) & (z_m[i] < FLT_MAX);
      voxels.ahead[i] = usable ? (depth_m - z_m[i]) * to_stored : -FLT_MAX;
      num_seen += voxels.ahead[i] >= -kStoredOne ? 1 : 0;
    }
    return num_seen > 0;
  }

  /// Averages the observations in; returns whether any voxel takes part in colour.
  FOOTHOLD_HD bool update(VoxelBlock& block, int first, Voxels& voxels) const {
    const float colour_limit = kColourBand * volume.voxel_size_m * kStoredOne / volume.truncation_m;
    std::int16_t* const distances = block.distance + first;
    std::uint8_t* const weights = block.weight + first;
    float weight[kWidth];
    std::int32_t raised[kWidth];
    for (int i = 0; i < kWidth; ++i) weight[i] = static_cast<float>(weights[i]);
    const float heaviest = static_cast<float>(max_weight);
    std::int32_t num_coloured = 0;
    for (int i = 0; i < kWidth; ++i) {
      const float ahead = voxels.ahead[i];
      const bool seen = ahead >= -kStoredOne;
      const float observed = ahead < kStoredOne ? ahead : kStoredOne;
      const float old = voxels.distance[i];
      const float average = (old * weight[i] + observed) / (weight[i] + 1.0F);
      const float more = weight[i] + 1.0F < heaviest ? weight[i] + 1.0F : heaviest;
      voxels.distance[i] = seen ? average : old;
      raised[i] = static_cast<std::int32_t>(seen ? more : weight[i]);
      voxels.colour[i] = (ahead >= -colour_limit) & (ahead <= colour_limit) ? 1 : 0;
      num_coloured += voxels.colour[i];
    }
    for (int i = 0; i < kWidth; ++i) {
      const float rounding = voxels.distance[i] < 0.0F ? -0.5F : 0.5F;
      distances[i] = static_cast<std::int16_t>(static_cast<std::int32_t>(voxels.distance[i] + rounding));
    }
    for (int i = 0; i < kWidth; ++i) weights[i] = static_cast<std::uint8_t>(raised[i]);
    return num_coloured > 0;
  }

  FOOTHOLD_HD void count_near_surface(int first, const Voxels& voxels, int (&counts)[8]) const {
    const float limit = kSurfaceBand * volume.voxel_size_m * kStoredOne / volume.truncation_m;
    if constexpr (kWidth == 1) {
      const int octant = octant_of(first & 7, (first >> 3) & 7, first >> 6);
      counts[octant] += voxels.distance[0] <= limit && voxels.distance[0] >= -limit ? 1 : 0;
    } else {
      for (int quarter = 0; quarter < kWidth; quarter += kBlockSide * 4) {
        std::int32_t near[2] = {0, 0};
        for (int i = 0; i < kBlockSide * 4; ++i) {
          const float distance = voxels.distance[quarter + i];
          const std::int32_t hit = (distance <= limit) & (distance >= -limit) ? 1 : 0;
          near[0] += (i & 4) == 0 ? hit : 0;
          near[1] += (i & 4) != 0 ? hit : 0;
        }
        const int octant = octant_of(0, ((first + quarter) >> 3) & 7, (first + quarter) >> 6);
        counts[octant] += near[0];
        counts[octant + 1] += near[1];
      }
    }
  }

  FOOTHOLD_HD void colour_voxels(VoxelBlock& block, int first, const Voxels& voxels, const Eigen::Vector3f& corner_world) const {
    std::int32_t pixels[kWidth];
    prefetch(block.red + first);
    prefetch(block.green + first);
    prefetch(block.blue + first);
    find_colours(first, voxels, corner_world, pixels);
    for (int i = 0; i < kWidth; ++i) {
      if (pixels[i] >= 0) prefetch(colour.data + static_cast<std::size_t>(pixels[i]) * static_cast<std::size_t>(colour.bytes_per_pixel));
    }
    for (int i = 0; i < kWidth; ++i) {
      if (pixels[i] < 0) continue;
      const int voxel = first + i;
      const std::uint8_t* const seen = colour.data + static_cast<std::size_t>(pixels[i]) * static_cast<std::size_t>(colour.bytes_per_pixel);
      // Eight bits hold no small increments: a longer memory would freeze the first colours.
      const bool coloured = (block.red[voxel] | block.green[voxel] | block.blue[voxel]) != 0;
      const int before = coloured ? block.weight[voxel] - 1 : 0;
      const int weight = before < kMaxColourWeight ? before : kMaxColourWeight;
      const float inverse = 1.0F / static_cast<float>(weight + 1);
      block.red[voxel] = average(block.red[voxel], seen[0], weight, inverse);
      block.green[voxel] = average(block.green[voxel], seen[1], weight, inverse);
      block.blue[voxel] = average(block.blue[voxel], seen[2], weight, inverse);
    }
  }

  /// Projects voxels that take part in colour into the colour image. @param pixels  Output; -1 where there is none.
  FOOTHOLD_HD void find_colours(int first, const Voxels& voxels, const Eigen::Vector3f& corner_world,
                                std::int32_t (&pixels)[kWidth]) const {
    const Eigen::Vector3f corner = colour_from_world * corner_world;
    const Eigen::Matrix3f step = colour_from_world.rotation * volume.voxel_size_m;
    const Intrinsics k = colour_intrinsics;
    const int columns = colour.width;
    const float width = static_cast<float>(colour.width);
    const float height = static_cast<float>(colour.height);
    for (int row = 0; row < kWidth; row += kRow) {
      const float b = static_cast<float>(((first + row) >> 3) & 7);
      const float c = static_cast<float>((first + row) >> 6);
      for (int i = 0; i < kRow; ++i) {
        const float a = static_cast<float>((first + i) & 7);
        const float x = corner[0] + (step(0, 0) * a + (step(0, 1) * b + step(0, 2) * c));
        const float y = corner[1] + (step(1, 0) * a + (step(1, 1) * b + step(1, 2) * c));
        const float z = corner[2] + (step(2, 0) * a + (step(2, 1) * b + step(2, 2) * c));
        const float u = k.fx * x / z + k.cx + 0.5F;
        const float v = k.fy * y / z + k.cy + 0.5F;
        const bool inside = (voxels.colour[row + i] != 0) & (z > 0.0F) & (u >= 0.0F) & (v >= 0.0F) & (u < width) & (v < height);
        const std::int32_t pixel = static_cast<std::int32_t>(inside ? v : 0.0F) * columns + static_cast<std::int32_t>(inside ? u : 0.0F);
        pixels[row + i] = inside ? pixel : -1;
      }
    }
  }

  static constexpr int kMaxColourWeight = 7;
  /// (old * weight + seen) / (weight + 1), rounded. @param inverse  1 / (weight + 1): exact enough for numbers this small.
  FOOTHOLD_HD static std::uint8_t average(int old, int seen, int weight, float inverse) {
    const int sum = old * weight + seen + (weight + 1) / 2;
    return static_cast<std::uint8_t>((static_cast<float>(sum) + 0.5F) * inverse);
  }
};

}  // namespace foothold
