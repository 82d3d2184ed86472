// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Averaging a frame into the blocks it sees.
#pragma once

#include <cfloat>

#include "tsdf_allocation_kernels.h"

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
    float max_depth_m = 0.0F;
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        const float depth_m = camera.depth(u, v);
        const float candidate_m = camera.usable(depth_m) ? depth_m : 0.0F;
        max_depth_m = candidate_m > max_depth_m ? candidate_m : max_depth_m;
      }
    }
    max_depths_m[tile] = max_depth_m;
  }
};

/// The part of the image and the range of depth that a block may cover.
struct BlockExtent {
  int u_min = 0;
  int v_min = 0;
  int u_max = -1;  ///< inclusive; below u_min if the block is out of view
  int v_max = -1;
  float z_near = 0.0F;
  float z_far = 0.0F;

  FOOTHOLD_HD bool visible() const { return u_min <= u_max && v_min <= v_max; }
};

/// Bounds the projection of a cube given by its centre in the camera frame and half its diagonal.
FOOTHOLD_HD inline BlockExtent bound_projection(const Eigen::Vector3f& centre, float radius, const Intrinsics& k, int width, int height) {
  constexpr float kNearestM = 0.05F;  // nearer cubes may cover any pixel
  BlockExtent extent;
  extent.z_near = centre.z() - radius;
  extent.z_far = centre.z() + radius;
  if (extent.z_far < kNearestM) return extent;
  if (extent.z_near < kNearestM) {
    extent.z_near = kNearestM;
    extent.u_min = 0;
    extent.v_min = 0;
    extent.u_max = width - 1;
    extent.v_max = height - 1;
    return extent;
  }
  const float inverse_near = 1.0F / extent.z_near;
  const float inverse_far = 1.0F / extent.z_far;
  const float x0 = centre.x() - radius;
  const float x1 = centre.x() + radius;
  const float y0 = centre.y() - radius;
  const float y1 = centre.y() + radius;
  const float u0 = k.fx * x0 * (x0 < 0.0F ? inverse_near : inverse_far) + k.cx;
  const float u1 = k.fx * x1 * (x1 > 0.0F ? inverse_near : inverse_far) + k.cx;
  const float v0 = k.fy * y0 * (y0 < 0.0F ? inverse_near : inverse_far) + k.cy;
  const float v1 = k.fy * y1 * (y1 > 0.0F ? inverse_near : inverse_far) + k.cy;
  const float right = static_cast<float>(width - 1);
  const float bottom = static_cast<float>(height - 1);
  if (u1 < 0.0F || v1 < 0.0F || u0 > right || v0 > bottom) return extent;
  extent.u_min = u0 > 0.0F ? static_cast<int>(u0) : 0;
  extent.v_min = v0 > 0.0F ? static_cast<int>(v0) : 0;
  extent.u_max = u1 < right ? static_cast<int>(u1) + 1 : width - 1;
  extent.v_max = v1 < bottom ? static_cast<int>(v1) + 1 : height - 1;
  return extent;
}

/// Averages one frame into one block; blocks out of view or behind what the camera sees are left alone.
///
/// Distance is measured along the optical axis: depth at the voxel's pixel minus the voxel's own. Rows of eight voxels are processed side
/// by side.
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
  std::uint8_t* block_has_surface;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, NoScratch&, std::size_t index) const {
    const BlockCoordinates coordinates = unpack_key(volume.block_keys[index]);
    const float side_m = volume.voxel_size_m * static_cast<float>(kBlockSide);
    const Eigen::Vector3f corner_world(static_cast<float>(coordinates.x) * side_m, static_cast<float>(coordinates.y) * side_m,
                                       static_cast<float>(coordinates.z) * side_m);
    if (!in_view(corner_world, side_m)) return;

    VoxelBlock& block = volume.block(static_cast<int>(index));
    const Eigen::Vector3f corner = camera_from_world * corner_world;
    const Eigen::Matrix3f step = camera_from_world.rotation * volume.voxel_size_m;
    int num_near_surface = 0;
    for (int row = team.lane(); row < kBlockSide * kBlockSide; row += team.size()) {
      const Eigen::Vector3f start = corner + step.col(1) * static_cast<float>(row & 7) + step.col(2) * static_cast<float>(row >> 3);
      const std::uint32_t colour_mask = integrate_row(block, row * kBlockSide, start, step.col(0), num_near_surface);
      if (colour_mask != 0) integrate_colour(block, row, colour_mask, corner_world);
    }
    num_near_surface = team.sum(num_near_surface);
    if (team.lane() == 0) block_has_surface[index] = num_near_surface > 0 ? 1 : 0;
  }

 private:
  /// Voxels this near to the surface take part in its colour [voxels].
  static constexpr float kColourBand = 1.8F;
  /// Voxels this near to the surface may belong to a cell that it passes through [voxels]: the diagonal of a cell and as much again for
  /// noise.
  static constexpr float kSurfaceBand = 3.0F;

  FOOTHOLD_HD bool in_view(const Eigen::Vector3f& corner_world, float side_m) const {
    const Eigen::Vector3f half = Eigen::Vector3f::Constant(0.5F * side_m);
    const Eigen::Vector3f centre = camera_from_world * (corner_world + half);
    const BlockExtent extent = bound_projection(centre, 0.8661F * side_m, camera.intrinsics, camera.depth.width, camera.depth.height);
    if (!extent.visible() || extent.z_near > camera.max_depth_m + volume.truncation_m) return false;
    for (int v = extent.v_min / kDepthTilePx; v <= extent.v_max / kDepthTilePx; ++v) {
      for (int u = extent.u_min / kDepthTilePx; u <= extent.u_max / kDepthTilePx; ++u) {
        const float depth_m = tile_depths_m[v * num_tile_columns + u];
        if (depth_m > 0.0F && extent.z_near <= depth_m + volume.truncation_m) return true;
      }
    }
    return false;
  }

  /// Updates the distances of eight voxels; returns a bit for each that should take part in colour.
  FOOTHOLD_HD std::uint32_t integrate_row(VoxelBlock& block, int first, const Eigen::Vector3f& start, const Eigen::Vector3f& step,
                                          int& num_near_surface) const {
    std::int16_t* const distances = block.distance + first;
    std::uint8_t* const weights = block.weight + first;
    const float width = static_cast<float>(camera.depth.width);
    const float height = static_cast<float>(camera.depth.height);
    const float cx = camera.intrinsics.cx + 0.5F;
    const float cy = camera.intrinsics.cy + 0.5F;
    int pixels[kBlockSide];
    float depths_m[kBlockSide];
    float zs[kBlockSide];
    for (int i = 0; i < kBlockSide; ++i) {
      const float t = static_cast<float>(i);
      const float z = start.z() + t * step.z();
      const float inverse = 1.0F / z;
      const float u = camera.intrinsics.fx * (start.x() + t * step.x()) * inverse + cx;
      const float v = camera.intrinsics.fy * (start.y() + t * step.y()) * inverse + cy;
      const bool inside = (z > 0.0F) & (u >= 0.0F) & (v >= 0.0F) & (u < width) & (v < height);
      const int pixel = static_cast<int>(inside ? v : 0.0F) * camera.depth.width + static_cast<int>(inside ? u : 0.0F);
      pixels[i] = pixel;
      zs[i] = inside ? z : FLT_MAX;
    }
    for (int i = 0; i < kBlockSide; ++i) depths_m[i] = camera.depth.data[pixels[i]];

    const float to_stored = kStoredOne / volume.truncation_m;
    const float colour_limit = kColourBand * volume.voxel_size_m * to_stored;
    const float surface_limit = kSurfaceBand * volume.voxel_size_m * to_stored;
    std::uint32_t colours[kBlockSide];
    int near[kBlockSide];
    for (int i = 0; i < kBlockSide; ++i) {
      const float depth_m = depths_m[i];
      const float ahead = (depth_m - zs[i]) * to_stored;
      const bool update = (depth_m >= camera.min_depth_m) & (depth_m <= camera.max_depth_m) & (ahead >= -kStoredOne);
      const float weight = static_cast<float>(weights[i]);
      const float clamped = ahead < kStoredOne ? ahead : kStoredOne;  // NaN becomes a number here and is not used
      const float observed = clamped > -kStoredOne ? clamped : -kStoredOne;
      const float average = (static_cast<float>(distances[i]) * weight + observed) / (weight + 1.0F);
      const int rounded = static_cast<int>(average + (average < 0.0F ? -0.5F : 0.5F));
      const int stored = update ? rounded : static_cast<int>(distances[i]);
      const int raised = static_cast<int>(weights[i]) + (update ? 1 : 0);
      const int magnitude = stored < 0 ? -stored : stored;
      distances[i] = static_cast<std::int16_t>(stored);
      weights[i] = static_cast<std::uint8_t>(raised < max_weight ? raised : max_weight);
      near[i] = static_cast<float>(magnitude) <= surface_limit ? 1 : 0;
      colours[i] = update & (ahead >= -colour_limit) & (ahead <= colour_limit) ? 1U : 0U;
    }
    std::uint32_t mask = 0;
    for (int i = 0; i < kBlockSide; ++i) {
      num_near_surface += near[i];
      mask |= colours[i] << static_cast<unsigned>(i);
    }
    return mask;
  }

  FOOTHOLD_HD void integrate_colour(VoxelBlock& block, int row, std::uint32_t mask, const Eigen::Vector3f& corner_world) const {
    const Eigen::Vector3f start =
        colour_from_world *
        (corner_world + volume.voxel_size_m * Eigen::Vector3f(0.0F, static_cast<float>(row & 7), static_cast<float>(row >> 3)));
    const Eigen::Vector3f step = colour_from_world.rotation.col(0) * volume.voxel_size_m;
    for (int i = 0; i < kBlockSide; ++i) {
      if ((mask >> static_cast<unsigned>(i) & 1U) == 0) continue;
      const Eigen::Vector3f point = start + step * static_cast<float>(i);
      if (point.z() <= 0.0F) continue;
      const Eigen::Vector2f pixel = colour_intrinsics.project(point);
      const int u = floor_to_int(pixel.x() + 0.5F);
      const int v = floor_to_int(pixel.y() + 0.5F);
      if (u < 0 || v < 0 || u >= colour.width || v >= colour.height) continue;
      const Rgb8 seen = colour(u, v);
      const int voxel = row * kBlockSide + i;
      // Eight bits hold no small increments: a longer memory would freeze the first colours.
      const bool coloured = (block.red[voxel] | block.green[voxel] | block.blue[voxel]) != 0;
      const int before = coloured ? block.weight[voxel] - 1 : 0;
      const int weight = before < kMaxColourWeight ? before : kMaxColourWeight;
      block.red[voxel] = average(block.red[voxel], seen.r, weight);
      block.green[voxel] = average(block.green[voxel], seen.g, weight);
      block.blue[voxel] = average(block.blue[voxel], seen.b, weight);
    }
  }

  static constexpr int kMaxColourWeight = 7;
  FOOTHOLD_HD static std::uint8_t average(std::uint8_t old, std::uint8_t seen, int weight) {
    return static_cast<std::uint8_t>((old * weight + seen + (weight + 1) / 2) / (weight + 1));
  }
};

}  // namespace foothold
