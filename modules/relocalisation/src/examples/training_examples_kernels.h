// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of training_examples.h, for both devices.
#pragma once

#include <cmath>

#include "examples/surface_pieces.h"
#include "examples/training_examples.h"
#include "features/feature_image_kernels.h"
#include "foothold/base/random.h"

namespace foothold {

/// R p + t in a fixed order of operations, so that every device rounds alike.
FOOTHOLD_HD inline Eigen::Vector3f transform_point(const SE3& target_from_source, const Eigen::Vector3f& p) {
  const Eigen::Matrix3f& r = target_from_source.rotation;
  const Eigen::Vector3f& t = target_from_source.translation;
  return {((r(0, 0) * p.x() + r(0, 1) * p.y()) + r(0, 2) * p.z()) + t.x(), ((r(1, 0) * p.x() + r(1, 1) * p.y()) + r(1, 2) * p.z()) + t.y(),
          ((r(2, 0) * p.x() + r(2, 1) * p.y()) + r(2, 2) * p.z()) + t.z()};
}

FOOTHOLD_HD inline std::uint16_t pack_rgb565(const FeaturePixel& pixel) {
  return static_cast<std::uint16_t>(((pixel.r() >> 3) << 11) | ((pixel.g() >> 2) << 5) | (pixel.b() >> 3));
}
FOOTHOLD_HD inline int red_of(std::uint16_t rgb565) { return ((rgb565 >> 11) & 31) * 255 / 31; }
FOOTHOLD_HD inline int green_of(std::uint16_t rgb565) { return ((rgb565 >> 5) & 63) * 255 / 63; }
FOOTHOLD_HD inline int blue_of(std::uint16_t rgb565) { return (rgb565 & 31) * 255 / 31; }

/// One pixel of each grid cell, with its scene point and surface key.
struct SampleTrainingPixel {
  Frame frame;
  SE3 scene_from_camera;
  int grid_width;
  int spacing;
  bool jitter;
  std::uint64_t frame_seed;
  SampledPixel* pixels;
  ReservoirPoint* points;
  std::uint64_t* surface_keys;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    surface_keys[i] = take(i) ? surface_key(pixels[i], points[i], i) : (kBeyondReach << kExampleBits) | i;
  }

 private:
  /// False if the pixel shows what lies beyond the place's reach.
  FOOTHOLD_HD bool take(std::size_t i) const {
    Random random(frame_seed, i);
    const int cell_u = static_cast<int>(i) % grid_width * spacing;
    const int cell_v = static_cast<int>(i) / grid_width * spacing;
    const int u =
        clamp_index(cell_u + (jitter ? static_cast<int>(random.below(static_cast<std::uint32_t>(spacing))) : 0), frame.depth.width);
    const int v =
        clamp_index(cell_v + (jitter ? static_cast<int>(random.below(static_cast<std::uint32_t>(spacing))) : 0), frame.depth.height);
    const float depth_m = frame.depth(u, v);
    pixels[i] = {static_cast<std::int16_t>(u), static_cast<std::int16_t>(v), 0.0F};
    points[i] = {};
    if (!is_valid_depth(depth_m)) return true;
    const Eigen::Vector3f point_scene =
        transform_point(scene_from_camera, frame.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), depth_m));
    const float x = std::floor(point_scene.x() * 1000.0F + 0.5F);
    const float y = std::floor(point_scene.y() * 1000.0F + 0.5F);
    const float z = std::floor(point_scene.z() * 1000.0F + 0.5F);
    if (!(std::fabs(x) <= kReachMm && std::fabs(y) <= kReachMm && std::fabs(z) <= kReachMm)) return false;
    pixels[i].depth_m = depth_m;
    points[i] = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(z), 0};
    return true;
  }
};

static_assert(sizeof(Frame) == 152 && sizeof(SampleTrainingPixel) == 248, "made by the host's compiler, read by nvcc's code");

/// The colour of an example's pixel.
struct ColourExample {
  FeatureImageView image;
  int downscale;
  const SampledPixel* pixels;
  ReservoirPoint* points;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    const int u = clamp_index(pixels[i].u / downscale, image.width);
    const int v = clamp_index(pixels[i].v / downscale, image.height);
    points[i].rgb565 = pack_rgb565(image.pixels[v * image.width + u]);
  }
};

}  // namespace foothold
