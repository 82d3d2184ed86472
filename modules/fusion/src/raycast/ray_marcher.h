// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Following a ray through a volume to the first surface.
#pragma once

#include <cfloat>

#include "raycast/depth_slices.h"
#include "raycast/surface_regions.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

/// Length of a ray [voxels]: single precision tells all places along it apart by less than the shortest step, kNudge.
inline constexpr float kRayLength = 32768.0F;
/// Cameras farther from the world's origin than this see nothing: no voxel has such coordinates [voxels].
inline constexpr float kFarthestCamera = 8388608.0F;

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

  /// The depth at which the ray leaves the cube of 2^log2_octants octants a side that an octant lies in.
  FOOTHOLD_HD float exit_depth(const BlockCoordinates& octant, int log2_octants) const {
    const int corner[3] = {octant.x >> log2_octants, octant.y >> log2_octants, octant.z >> log2_octants};
    const int side = kOctantSide << log2_octants;
    float exit = FLT_MAX;
    for (int axis = 0; axis < 3; ++axis) {
      const float plane = static_cast<float>((corner[axis] + (direction[axis] > 0.0F ? 1 : 0)) * side);
      const float depth = (plane - origin[axis]) * inverse[axis];
      exit = depth < exit ? depth : exit;
    }
    return exit;
  }
};

/// Follows one ray at a time to the first fall of the signed distance through zero.
/// @tparam kNumRemembered  Of VoxelReader.
template <int kNumRemembered>
class RayMarcher {
 public:
  FOOTHOLD_HD RayMarcher(const TsdfView& volume, const SurfaceRegions& regions)
      : volume_(volume),
        regions_(regions),
        reader_(volume),
        near_limit_(kInterpolationBand * volume.voxel_size_m / volume.truncation_m * kStoredOne) {}

  /// The depth of the surface [m], or 0.
  /// @param near    where the ray begins
  /// @param slices  depths at which there may be a surface
  FOOTHOLD_HD float march(const Ray& ray, float near, const DepthSlices& slices) {
    const float voxel = volume_.voxel_size_m * ray.depth_per_metre;
    const float to_depth = volume_.truncation_m * kStepFraction * ray.depth_per_metre;
    const float end = kRayLength * voxel;
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
        const float exit = ray.exit_depth(octant_, log2_empty_octants_);
        depth = slices.next((exit > depth ? exit : depth) + kNudge * voxel);
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

  FOOTHOLD_HD VoxelReader<kNumRemembered>& reader() { return reader_; }

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
    has_surface_ = false;
    const BlockCoordinates block{octant.x >> 1, octant.y >> 1, octant.z >> 1};
    const std::uint64_t region = SurfaceRegions::region_of(block);
    if (region != region_) {
      region_ = region;
      blocks_with_surface_ = regions_.blocks_with_surface(region);
    }
    log2_empty_octants_ = kLog2RegionOctants;
    if (blocks_with_surface_ == 0) return false;
    log2_empty_octants_ = 1;
    if ((blocks_with_surface_ & SurfaceRegions::bit_of(block)) == 0) return false;
    log2_empty_octants_ = 0;
    const unsigned surface_octants = reader_.find(block).surface_octants;
    has_surface_ = (surface_octants >> static_cast<unsigned>((octant.z & 1) << 2 | (octant.y & 1) << 1 | (octant.x & 1)) & 1U) != 0;
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
  SurfaceRegions regions_;
  VoxelReader<kNumRemembered> reader_;
  float near_limit_;
  BlockCoordinates octant_{INT32_MAX, 0, 0};
  int log2_empty_octants_ = 0;  ///< side of the cube around octant_ that has no surface, if octant_ has none
  std::uint64_t region_ = kNoKey;
  std::uint64_t blocks_with_surface_ = 0;
  bool has_surface_ = false;
};

}  // namespace foothold
