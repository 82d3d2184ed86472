// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The poses that a volume is rendered from, and at which depths the rays of each tile of the image may meet a surface.
#pragma once

#include "foothold/base/camera.h"
#include "foothold/base/exec/atomics.h"
#include "foothold/base/se3.h"
#include "raycast/depth_slices.h"
#include "raycast/surface_regions.h"
#include "tsdf/block_extent.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

/// Pixels that share a depth range; small, so that the range is tight.
inline constexpr int kRangeTilePx = 4;

/// The camera by value for kernels, its poses, and the tiles of each of its images.
///
/// Items are numbered through all images: those of the first pose, then those of the second, and so on.
struct RayCamera {
  Intrinsics intrinsics;
  int width;
  int height;
  const SE3* world_from_cameras;
  int num_tile_columns;  ///< of rendering
  int num_tiles;
  int num_range_columns;  ///< of depth ranges
  int num_ranges;

  FOOTHOLD_HD int num_pixels() const { return width * height; }
};

/// An item's image, and its number in that.
struct ImageItem {
  int image;
  int index;

  FOOTHOLD_HD ImageItem(std::size_t item, int num_per_image)
      : image(static_cast<int>(static_cast<std::uint32_t>(item) / static_cast<std::uint32_t>(num_per_image))),
        index(static_cast<int>(item) - image * num_per_image) {}
};

/// Takes the poses over into the map, and inverts them.
struct PlaceCamera {
  const SE3* from;
  SE3* world_from_cameras;
  SE3* cameras_from_world;

  FOOTHOLD_HD void operator()(std::size_t image) const {
    const SE3 pose = from[image];
    world_from_cameras[image] = pose;
    cameras_from_world[image] = pose.inverse();
  }
};

struct ResetRanges {
  std::int32_t* near;
  DepthSlices* slices;
  std::size_t num_ranges;
  SurfaceRegions regions;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    if (i < std::size_t{1} << static_cast<unsigned>(regions.log2_size)) regions.blocks[i] = 0;
    if (i >= num_ranges) return;
    near[i] = 0x7f7fffff;  // the largest float
    slices[i] = {};
  }
};

/// Notes the depths of blocks with a surface in every tile that they may cover.
struct ProjectBlockRange {
  TsdfView volume;
  RayCamera camera;
  const SE3* cameras_from_world;
  std::int32_t* near;
  DepthSlices* slices;
  SurfaceRegions regions;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const ImageItem item(i, volume.num_blocks);
    const unsigned octants = volume.surface_octants[item.index];
    if (octants == 0) return;
    const BlockCoordinates block = unpack_key(volume.block_keys[item.index]);
    if (item.image == 0) regions.add(block);
    const SE3 camera_from_world = cameras_from_world[item.image];
    const float side_m = volume.voxel_size_m * static_cast<float>(kOctantSide);
    const Eigen::Vector3f block_world(static_cast<float>(2 * block.x + 1) * side_m, static_cast<float>(2 * block.y + 1) * side_m,
                                      static_cast<float>(2 * block.z + 1) * side_m);
    const BlockExtent whole =
        bound_projection(camera_from_world * block_world, 2.0F * kHalfDiagonal * side_m, camera.intrinsics, camera.width, camera.height);
    if (!whole.visible()) return;
    for (int octant = 0; octant < 8; ++octant) {
      if ((octants >> static_cast<unsigned>(octant) & 1U) == 0) continue;
      const Eigen::Vector3f centre_world((static_cast<float>(2 * block.x + (octant & 1)) + 0.5F) * side_m,
                                         (static_cast<float>(2 * block.y + (octant >> 1 & 1)) + 0.5F) * side_m,
                                         (static_cast<float>(2 * block.z + (octant >> 2)) + 0.5F) * side_m);
      note(bound_projection(camera_from_world * centre_world, kHalfDiagonal * side_m, camera.intrinsics, camera.width, camera.height),
           item.image * camera.num_ranges);
    }
  }

  FOOTHOLD_HD void note(const BlockExtent& extent, int first_range) const {
    if (!extent.visible()) return;
    for (int v = extent.v_min / kRangeTilePx; v <= extent.v_max / kRangeTilePx; ++v) {
      for (int u = extent.u_min / kRangeTilePx; u <= extent.u_max / kRangeTilePx; ++u) {
        const int tile = first_range + v * camera.num_range_columns + u;
        atomic_lower(near + tile, float_bits(extent.z_near));
        slices[tile].add(extent.z_near, extent.z_far);
      }
    }
  }
};

}  // namespace foothold
