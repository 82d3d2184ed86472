// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Rendering a volume: depth ranges by tile, rays, normals, colours.
#pragma once

#include <Eigen/Geometry>
#include <cstring>

#include "raycaster_ops.h"
#include "tsdf_integration_kernels.h"

namespace foothold {

/// Pixels that share a depth range; small, so that the range is tight.
inline constexpr int kRangeTilePx = 4;
/// Pixels rendered by one team.
inline constexpr int kRayTileWidth = 16;
inline constexpr int kRayTileHeight = 8;
/// Voxels along each side of an eighth of a block, the unit of empty space.
inline constexpr int kOctantSide = kBlockSide / 2;
/// Length of a ray [voxels]: single precision tells all places along it apart by less than the shortest step, kNudge.
inline constexpr float kRayLength = 32768.0F;
/// Cameras farther from the world's origin than this see nothing: no voxel has such coordinates [voxels].
inline constexpr float kFarthestCamera = 8388608.0F;

FOOTHOLD_HD inline std::int32_t float_bits(float value) {
  std::int32_t bits = 0;
  memcpy(&bits, &value, sizeof(bits));
  return bits;
}
FOOTHOLD_HD inline float float_of_bits(std::int32_t bits) {
  float value = 0.0F;
  memcpy(&value, &bits, sizeof(value));
  return value;
}

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
  std::int32_t* far;

  FOOTHOLD_HD void operator()(std::size_t tile) const {
    near[tile] = 0x7f7fffff;  // the largest float
    far[tile] = 0;
  }
};

/// Widens the depth range of every tile that a block with a surface may cover.
struct ProjectBlockRange {
  TsdfView volume;
  RayCamera camera;
  const SE3* cameras_from_world;
  std::int32_t* near;
  std::int32_t* far;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const ImageItem item(i, volume.num_blocks);
    const unsigned octants = volume.surface_octants[item.index];
    if (octants == 0) return;
    const BlockCoordinates block = unpack_key(volume.block_keys[item.index]);
    const SE3 camera_from_world = cameras_from_world[item.image];
    const float side_m = volume.voxel_size_m * static_cast<float>(kOctantSide);
    for (int octant = 0; octant < 8; ++octant) {
      if ((octants >> static_cast<unsigned>(octant) & 1U) == 0) continue;
      const Eigen::Vector3f centre_world((static_cast<float>(2 * block.x + (octant & 1)) + 0.5F) * side_m,
                                         (static_cast<float>(2 * block.y + (octant >> 1 & 1)) + 0.5F) * side_m,
                                         (static_cast<float>(2 * block.z + (octant >> 2)) + 0.5F) * side_m);
      widen(bound_projection(camera_from_world * centre_world, kHalfDiagonal * side_m, camera.intrinsics, camera.width, camera.height),
            item.image * camera.num_ranges);
    }
  }

  FOOTHOLD_HD void widen(const BlockExtent& extent, int first_range) const {
    if (!extent.visible()) return;
    for (int v = extent.v_min / kRangeTilePx; v <= extent.v_max / kRangeTilePx; ++v) {
      for (int u = extent.u_min / kRangeTilePx; u <= extent.u_max / kRangeTilePx; ++u) {
        const int tile = first_range + v * camera.num_range_columns + u;
        atomic_lower(near + tile, float_bits(extent.z_near));
        atomic_raise(far + tile, float_bits(extent.z_far));
      }
    }
  }
};

/// A ray in voxel units, parametrised by depth along the optical axis [m].
struct Ray {
  float origin[3];
  float direction[3];
  float inverse[3];       ///< of the direction
  float depth_per_metre;  ///< advance in depth for each metre along the ray

  /// Whether it begins where voxels can be.
  FOOTHOLD_HD bool is_near_map() const {
    return std::abs(origin[0]) < kFarthestCamera && std::abs(origin[1]) < kFarthestCamera && std::abs(origin[2]) < kFarthestCamera;
  }

  /// The depth at which the ray leaves an octant, given in octants.
  FOOTHOLD_HD float exit_depth(const BlockCoordinates& octant) const {
    const int corner[3] = {octant.x, octant.y, octant.z};
    float exit = FLT_MAX;
    for (int axis = 0; axis < 3; ++axis) {
      const float plane = static_cast<float>((corner[axis] + (direction[axis] > 0.0F ? 1 : 0)) * kOctantSide);
      const float depth = (plane - origin[axis]) * inverse[axis];
      exit = depth < exit ? depth : exit;
    }
    return exit;
  }
};

/// Follows one ray at a time to the first fall of the signed distance through zero.
class RayMarcher {
 public:
  FOOTHOLD_HD explicit RayMarcher(const TsdfView& volume)
      : volume_(volume), reader_(volume), near_limit_(kInterpolationBand * volume.voxel_size_m / volume.truncation_m * kStoredOne) {}

  /// The depth of the surface [m], or 0.
  FOOTHOLD_HD float march(const Ray& ray, float near, float far) {
    const float voxel = volume_.voxel_size_m * ray.depth_per_metre;
    const float to_depth = volume_.truncation_m * kStepFraction * ray.depth_per_metre;
    const float end = far < kRayLength * voxel ? far : kRayLength * voxel;
    float depth = near;
    bool outside = false;  // whether the last sample was in free space
    float outside_depth = 0.0F;
    float outside_distance = 0.0F;
    while (depth < end) {
      const float x = ray.origin[0] + ray.direction[0] * depth;
      const float y = ray.origin[1] + ray.direction[1] * depth;
      const float z = ray.origin[2] + ray.direction[2] * depth;
      if (!enter_octant(x, y, z)) {
        outside = false;
        const float exit = ray.exit_depth(octant_);
        depth = (exit > depth ? exit : depth) + kNudge * voxel;
        continue;
      }
      float distance = 0.0F;
      if (!sample(x, y, z, distance)) {
        outside = false;
        depth += voxel;
        continue;
      }
      if (distance > 0.0F) {
        outside = true;
        outside_depth = depth;
        outside_distance = distance;
        const float step = distance * to_depth;
        depth += step > voxel ? step : voxel;  // too far is better than not quite there: the crossing is bracketed
        continue;
      }
      float surface = 0.0F;
      if (outside && refine(ray, outside_depth, outside_distance, depth, distance, surface)) return surface;
      outside = false;
      depth += voxel;
    }
    return 0.0F;
  }

  FOOTHOLD_HD VoxelReader& reader() { return reader_; }

 private:
  /// Part of the distance that a ray advances at once: below 1, because distances were measured along other rays (T: fusion_benchmark).
  static constexpr float kStepFraction = 0.8F;
  /// How far beyond its border a ray enters an octant [voxels].
  static constexpr float kNudge = 0.05F;
  /// Farther from the surface than this the nearest voxel is exact enough [voxels].
  static constexpr float kInterpolationBand = 2.0F;

  FOOTHOLD_HD bool enter_octant(float x, float y, float z) {
    const BlockCoordinates octant{floor_to_int(x) >> 2, floor_to_int(y) >> 2, floor_to_int(z) >> 2};
    if (octant.x == octant_.x && octant.y == octant_.y && octant.z == octant_.z) return has_surface_;
    octant_ = octant;
    const std::uint64_t key = pack_key({octant.x >> 1, octant.y >> 1, octant.z >> 1});
    if (key != key_) {
      key_ = key;
      const int index = volume_.find(key);
      surface_octants_ = index >= 0 ? volume_.surface_octants[index] : 0U;
    }
    has_surface_ = (surface_octants_ >> static_cast<unsigned>((octant.z & 1) << 2 | (octant.y & 1) << 1 | (octant.x & 1)) & 1U) != 0;
    return has_surface_;
  }

  FOOTHOLD_HD bool sample(float x, float y, float z, float& distance) {
    const std::int16_t nearest = reader_.stored(floor_to_int(x + 0.5F), floor_to_int(y + 0.5F), floor_to_int(z + 0.5F));
    if (nearest == kUnobserved) return false;
    distance = static_cast<float>(nearest);
    if (distance > near_limit_ || distance < -near_limit_) {
      distance *= 1.0F / kStoredOne;
      return true;
    }
    return reader_.interpolate(x, y, z, distance);
  }

  /// Regula falsi between a sample outside and one inside.
  FOOTHOLD_HD bool refine(const Ray& ray, float outside, float outside_distance, float inside, float inside_distance, float& surface) {
    constexpr int kNumSteps = 2;
    for (int i = 0; i < kNumSteps; ++i) {
      surface = outside + (inside - outside) * outside_distance / (outside_distance - inside_distance);
      float distance = 0.0F;
      if (!reader_.interpolate(ray.origin[0] + ray.direction[0] * surface, ray.origin[1] + ray.direction[1] * surface,
                               ray.origin[2] + ray.direction[2] * surface, distance)) {
        return false;
      }
      if (distance > 0.0F) {
        outside = surface;
        outside_distance = distance;
      } else {
        inside = surface;
        inside_distance = distance;
      }
    }
    surface = outside + (inside - outside) * outside_distance / (outside_distance - inside_distance);
    return true;
  }

  TsdfView volume_;
  VoxelReader reader_;
  float near_limit_;
  BlockCoordinates octant_{INT32_MAX, 0, 0};
  std::uint64_t key_ = kNoKey;
  unsigned surface_octants_ = 0;
  bool has_surface_ = false;
};

/// Renders one tile of an image.
struct RenderTile {
  TsdfView volume;
  RayCamera camera;
  const std::int32_t* near;
  const std::int32_t* far;
  float* depths_m;
  Rgb8* colours;  ///< nullptr if not wanted

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, NoScratch&, std::size_t tile) const {
    const ImageItem item(tile, camera.num_tiles);
    const int u0 = item.index % camera.num_tile_columns * kRayTileWidth;
    const int v0 = item.index / camera.num_tile_columns * kRayTileHeight;
    RayMarcher marcher(volume);
    for (int i = team.lane(); i < kRayTileWidth * kRayTileHeight; i += team.size()) {
      const int u = u0 + i % kRayTileWidth;
      const int v = v0 + i / kRayTileWidth;
      if (u >= camera.width || v >= camera.height) continue;
      const Ray ray = ray_of(camera.world_from_cameras[item.image], u, v);  // read again: registers are for the march
      const int pixel = item.image * camera.num_pixels() + v * camera.width + u;
      const int range = item.image * camera.num_ranges + v / kRangeTilePx * camera.num_range_columns + u / kRangeTilePx;
      const float depth_m = ray.is_near_map() ? marcher.march(ray, float_of_bits(near[range]), float_of_bits(far[range])) : 0.0F;
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
  FOOTHOLD_HD Rgb8 colour_at(VoxelReader& reader, const Ray& ray, float depth_m) const {
    float g[3];
    int base[3];
    for (int axis = 0; axis < 3; ++axis) {
      g[axis] = ray.origin[axis] + ray.direction[axis] * depth_m;
      base[axis] = floor_to_int(g[axis]);
      g[axis] -= static_cast<float>(base[axis]);
    }
    float sum[3] = {0.0F, 0.0F, 0.0F};
    float total = 0.0F;
    for (int i = 0; i < 8; ++i) {
      const int x = base[0] + (i & 1);
      const int y = base[1] + ((i >> 1) & 1);
      const int z = base[2] + (i >> 2);
      const VoxelBlock* block = reader.block_of(x, y, z);
      if (block == nullptr) continue;
      const int voxel = VoxelReader::voxel_index(x, y, z);
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

template <Device kDevice>
void RaycasterOps<kDevice>::render(const Context& context, const TsdfView& volume, const Array<SE3>& world_from_cameras, Scratch& scratch,
                                   SurfaceMap& map) {
  const typename ExecutorOf<kDevice>::Type exec(context);
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
  scratch.range_far.resize(num_ranges);
  scratch.depths_m.resize(map.pixels.size());
  SE3* const cameras_from_world = scratch.cameras_from_world.data();
  std::int32_t* const near = scratch.range_near.data();
  std::int32_t* const far = scratch.range_far.data();
  exec.for_each(num_images, PlaceCamera{world_from_cameras.data(), map.world_from_cameras.data(), cameras_from_world});
  exec.for_each(num_ranges, ResetRanges{near, far});
  exec.for_each(num_images * static_cast<std::size_t>(volume.num_blocks), ProjectBlockRange{volume, camera, cameras_from_world, near, far});
  exec.template for_each_team<NoScratch>(
      num_images * static_cast<std::size_t>(camera.num_tiles),
      RenderTile{volume, camera, near, far, scratch.depths_m.data(), map.colours.empty() ? nullptr : map.colours.data()});
  exec.for_each(map.pixels.size(), EstimateNormal{camera, scratch.depths_m.data(), map.pixels.data()});
}

}  // namespace foothold
