// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Rendering a volume: depth ranges by tile, rays, normals, colours.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "foothold/fusion/raycaster.h"
#include "raycast/depth_range_kernels.h"
#include "raycast/ray_marcher.h"

namespace foothold {

struct Raycaster::Scratch {
  explicit Scratch(const Memory& memory)
      : pose(memory), cameras_from_world(memory), range_near(memory), slices(memory), regions(memory), depths_m(memory) {}

  Array<SE3> pose;  ///< of a single rendering
  Array<SE3> cameras_from_world;
  Array<std::int32_t> range_near;  ///< depth [m] as the bits of a positive float, whose order is that of integers
  Array<DepthSlices> slices;
  Array<std::uint64_t> regions;  ///< of SurfaceRegions
  Array<float> depths_m;
};

/// The steps of Raycaster that run on a device.
template <class Executor>
struct RaycastAlgorithms {
  using Scratch = Raycaster::Scratch;

  /// Renders from each pose into `map`, whose arrays have their sizes.
  static void render(const Context& context, const TsdfView& volume, const Array<SE3>& world_from_cameras, Scratch& scratch,
                     SurfaceMap& map);
};

/// Pixels rendered by one team.
inline constexpr int kRayTileWidth = 16;
inline constexpr int kRayTileHeight = 8;

/// Renders one tile of an image.
/// @tparam kNumRemembered  Of VoxelReader.
template <int kNumRemembered>
struct RenderTile {
  TsdfView volume;
  SurfaceRegions regions;
  RayCamera camera;
  const std::int32_t* near;
  const DepthSlices* slices;
  float* depths_m;
  Rgb8* colours;  ///< nullptr if not wanted

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t tile) const {
    const ImageItem item(tile, camera.num_tiles);
    const int u0 = item.index % camera.num_tile_columns * kRayTileWidth;
    const int v0 = item.index / camera.num_tile_columns * kRayTileHeight;
    RayMarcher<kNumRemembered> marcher(volume, regions);
    for (int i = team.lane(); i < kRayTileWidth * kRayTileHeight; i += team.size()) {
      const int u = u0 + i % kRayTileWidth;
      const int v = v0 + i / kRayTileWidth;
      if (u >= camera.width || v >= camera.height) continue;
      const Ray ray = ray_of(camera.world_from_cameras[item.image], u, v);  // read again: registers are for the march
      const int pixel = item.image * camera.num_pixels() + v * camera.width + u;
      const int range = item.image * camera.num_ranges + v / kRangeTilePx * camera.num_range_columns + u / kRangeTilePx;
      const float depth_m = ray.is_near_map() ? marcher.march(ray, float_of_bits(near[range]), slices[range]) : 0.0F;
      depths_m[pixel] = depth_m;
      if (colours != nullptr) colours[pixel] = depth_m > 0.0F ? colour_at(marcher.reader(), ray, depth_m) : Rgb8{};
    }
  }

  FOOTHOLD_HD Ray ray_of(const SE3& world_from_camera, int u, int v) const {
    const Eigen::Vector3f direction_camera = camera.intrinsics.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
    const Eigen::Vector3f direction_world = world_from_camera.rotation * direction_camera;
    const float to_voxels = 1.0F / volume.voxel_size_m;
    Ray ray{};
    for (int axis = 0; axis < 3; ++axis) {
      const float d = direction_world[axis] * to_voxels;
      ray.origin[axis] = world_from_camera.translation[axis] * to_voxels;
      ray.direction[axis] = d > -1e-6F && d < 1e-6F ? 1e-6F : d;
      ray.inverse[axis] = 1.0F / ray.direction[axis];
    }
    ray.depth_per_metre = 1.0F / direction_camera.norm();
    return ray;
  }

  /// The trilinear average of the coloured voxels around a point; black if there are none.
  FOOTHOLD_HD Rgb8 colour_at(VoxelReader<kNumRemembered>& reader, const Ray& ray, float depth_m) const {
    float g[3];
    int base[3];
    for (int axis = 0; axis < 3; ++axis) {
      g[axis] = ray.origin[axis] + ray.direction[axis] * depth_m;
      base[axis] = floor_to_int(g[axis]);
      g[axis] -= static_cast<float>(base[axis]);
    }
    float sum[3] = {0.0F, 0.0F, 0.0F};
    float total = 0.0F;
    typename VoxelReader<kNumRemembered>::Cell cell;
    if constexpr (kNumRemembered == 8) reader.find_cell(base[0], base[1], base[2], cell);
    for (int i = 0; i < 8; ++i) {
      if constexpr (kNumRemembered == 1) reader.find_corner(base[0], base[1], base[2], i, cell);
      const VoxelBlock* const block = cell.blocks[i];
      const int voxel = cell.voxels[i];
      if (block == nullptr) continue;
      if ((block->red[voxel] | block->green[voxel] | block->blue[voxel]) == 0) continue;
      const float weight = ((i & 1) != 0 ? g[0] : 1.0F - g[0]) * ((i & 2) != 0 ? g[1] : 1.0F - g[1]) * ((i & 4) != 0 ? g[2] : 1.0F - g[2]);
      sum[0] += weight * static_cast<float>(block->red[voxel]);
      sum[1] += weight * static_cast<float>(block->green[voxel]);
      sum[2] += weight * static_cast<float>(block->blue[voxel]);
      total += weight;
    }
    if (total <= 0.0F) return {};
    return {static_cast<std::uint8_t>(sum[0] / total + 0.5F), static_cast<std::uint8_t>(sum[1] / total + 0.5F),
            static_cast<std::uint8_t>(sum[2] / total + 0.5F)};
  }
};

/// Estimates normals from the points of neighbouring pixels.
struct EstimateNormal {
  /// Neighbouring pixels whose depths differ by more than this part of the depth belong to different surfaces (T: fusion_benchmark).
  static constexpr float kDiscontinuity = 0.04F;

  RayCamera camera;
  const float* depths_m;
  SurfacePixel* pixels;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const ImageItem item(i, camera.num_pixels());
    const float* const image_m = depths_m + static_cast<std::size_t>(i) - static_cast<std::size_t>(item.index);
    const int u = item.index % camera.width;
    const int v = item.index / camera.width;
    SurfacePixel pixel;
    pixel.depth_m = depths_m[i];
    Eigen::Vector3f along_u;
    Eigen::Vector3f along_v;
    if (pixel.depth_m > 0.0F && u > 0 && v > 0 && u + 1 < camera.width && v + 1 < camera.height &&
        difference(image_m, u, v, 1, 0, pixel.depth_m, along_u) && difference(image_m, u, v, 0, 1, pixel.depth_m, along_v)) {
      const Eigen::Vector3f normal = along_v.cross(along_u);  // u is right, v is down: towards the camera
      const float length = normal.norm();
      if (length > 0.0F) {
        pixel.normal_x = normal.x() / length;
        pixel.normal_y = normal.y() / length;
        pixel.normal_z = normal.z() / length;
      }
    }
    pixels[i] = pixel;
  }

  FOOTHOLD_HD bool difference(const float* image_m, int u, int v, int du, int dv, float centre_m, Eigen::Vector3f& along) const {
    const float before_m = image_m[(v - dv) * camera.width + u - du];
    const float after_m = image_m[(v + dv) * camera.width + u + du];
    const float limit = kDiscontinuity * centre_m;
    if (!(std::abs(before_m - centre_m) < limit && std::abs(after_m - centre_m) < limit)) return false;
    along = camera.intrinsics.back_project(static_cast<float>(u + du), static_cast<float>(v + dv), after_m) -
            camera.intrinsics.back_project(static_cast<float>(u - du), static_cast<float>(v - dv), before_m);
    return true;
  }
};

/// Slots for regions, as a power of two: several for each region of a map whose blocks lie along surfaces.
inline int log2_num_regions(int num_blocks) {
  int log2 = 10;
  while (log2 < 20 && (1 << log2) < num_blocks / 2) ++log2;
  return log2;
}

template <class Executor>
void RaycastAlgorithms<Executor>::render(const Context& context, const TsdfView& volume, const Array<SE3>& world_from_cameras,
                                         Scratch& scratch, SurfaceMap& map) {
  const Executor exec(context);
  const RenderCamera& view = map.camera;
  const std::size_t num_images = world_from_cameras.size();
  const int num_columns = (view.width + kRayTileWidth - 1) / kRayTileWidth;
  const int num_rows = (view.height + kRayTileHeight - 1) / kRayTileHeight;
  const int num_range_columns = (view.width + kRangeTilePx - 1) / kRangeTilePx;
  const int num_range_rows = (view.height + kRangeTilePx - 1) / kRangeTilePx;
  const RayCamera camera{view.intrinsics,   view.width,
                         view.height,       map.world_from_cameras.data(),
                         num_columns,       num_columns * num_rows,
                         num_range_columns, num_range_columns * num_range_rows};
  const std::size_t num_ranges = num_images * static_cast<std::size_t>(camera.num_ranges);
  scratch.cameras_from_world.resize(num_images);
  scratch.range_near.resize(num_ranges);
  scratch.slices.resize(num_ranges);
  scratch.depths_m.resize(map.pixels.size());
  const int log2_regions = log2_num_regions(volume.num_blocks);
  scratch.regions.resize(std::size_t{1} << static_cast<unsigned>(log2_regions));
  SE3* const cameras_from_world = scratch.cameras_from_world.data();
  std::int32_t* const near = scratch.range_near.data();
  DepthSlices* const slices = scratch.slices.data();
  exec.for_each(num_images, PlaceCamera{world_from_cameras.data(), map.world_from_cameras.data(), cameras_from_world});
  const SurfaceRegions regions{scratch.regions.data(), log2_regions};
  exec.for_each(std::max(num_ranges, scratch.regions.size()), ResetRanges{near, slices, num_ranges, regions});
  exec.for_each(num_images * static_cast<std::size_t>(volume.num_blocks),
                ProjectBlockRange{volume, camera, cameras_from_world, near, slices, regions});
  constexpr int kNumRemembered = Executor::kVectorWidth > 1 ? 8 : 1;
  exec.for_each_team(num_images * static_cast<std::size_t>(camera.num_tiles),
                     RenderTile<kNumRemembered>{volume, regions, camera, near, slices, scratch.depths_m.data(),
                                                map.colours.empty() ? nullptr : map.colours.data()});
  exec.for_each(map.pixels.size(), EstimateNormal{camera, scratch.depths_m.data(), map.pixels.data()});
}

}  // namespace foothold
