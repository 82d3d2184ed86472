// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a frame teaches: sample_examples() and colour_examples().
#include "examples/training_examples.h"

#include "examples/surface_pieces.h"
#include "foothold/base/se3.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Settings whose grid has a spacing of 8 pixels on a FlatFrame, a tenth as wide as the frames that settings refer to.
ReservoirSettings eight_pixel_grid() {
  ReservoirSettings settings;
  settings.grid_spacing_px = 80;
  return settings;
}

/// A frame of one depth and one colour.
struct FlatFrame {
  explicit FlatFrame(float depth_m, int width = 64, int height = 48)
      : depth(width, height, depth_m), colour(width, height, {80, 160, 240}) {
    frame.depth = depth.view();
    frame.colour = colour_view(colour);
    frame.calibration.depth = frame.calibration.colour = {60.0F, 60.0F, 31.5F, 23.5F};
  }
  Image<float> depth;
  Image<Rgb8> colour;
  Frame frame;
};

TEST_CASE("sample_examples: one pixel of each grid cell, with its point in the place's frame, and its colour") {
  const Context context = Context(ContextOptions{});
  FlatFrame flat(2.0F);
  flat.depth(0, 0) = 0.0F;
  SE3 place_from_camera = se3_exp((Tangent6() << 0.3F, -0.5F, 0.2F, 0.0F, 0.0F, 0.0F).finished());
  place_from_camera.translation = {1.0F, -2.0F, 0.5F};
  FeatureImage image(context);
  image.compute(context, flat.frame, 4);
  for (const bool jitter : {false, true}) {
    ReservoirSettings settings = eight_pixel_grid();
    settings.jitter = jitter;
    TrainingExamples examples(MemoryKind::kHost);
    sample_examples(context, flat.frame, settings, place_from_camera, 42, examples);
    colour_examples(context, image, examples);
    REQUIRE(examples.pixels.size() == 8 * 6);
    int num_moved = 0;
    for (int i = 0; i < 48; ++i) {
      const SampledPixel& pixel = examples.pixels[static_cast<std::size_t>(i)];
      REQUIRE(pixel.u / 8 == i % 8);
      REQUIRE(pixel.v / 8 == i / 8);
      num_moved += pixel.u % 8 != 0 || pixel.v % 8 != 0 ? 1 : 0;
      if (pixel.u == 0 && pixel.v == 0) {
        REQUIRE(pixel.depth_m == 0.0F);
        continue;
      }
      REQUIRE(pixel.depth_m == 2.0F);
      const Eigen::Vector3d point_camera((pixel.u - 31.5) / 60.0 * 2.0, (pixel.v - 23.5) / 60.0 * 2.0, 2.0);
      const Eigen::Vector3d expected_mm =
          (place_from_camera.rotation.cast<double>() * point_camera + place_from_camera.translation.cast<double>()) * 1000.0;
      const ReservoirPoint& point = examples.points[static_cast<std::size_t>(i)];
      constexpr double kRounding = 0.51;  // to millimetres, and a little for single precision
      REQUIRE((Eigen::Vector3d(point.x_mm, point.y_mm, point.z_mm) - expected_mm).cwiseAbs().maxCoeff() < kRounding);
      REQUIRE(point.rgb565 == ((80 >> 3) << 11 | (160 >> 2) << 5 | 240 >> 3));
    }
    REQUIRE((num_moved > 0) == jitter);
  }
}

TEST_CASE("sample_examples: points further than 32 m from the place's origin are dropped, and marked") {
  const Context context = Context(ContextOptions{});
  TrainingExamples examples(MemoryKind::kHost);
  const auto num_with_depth = [&](float depth_m, float z_m) {
    const FlatFrame flat(depth_m);
    SE3 place_from_camera;
    place_from_camera.translation.z() = z_m;
    sample_examples(context, flat.frame, eight_pixel_grid(), place_from_camera, 42, examples);
    int count = 0;
    for (std::size_t i = 0; i < examples.pixels.size(); ++i) {
      const bool has_depth = examples.pixels[i].depth_m > 0.0F;
      const std::uint64_t surface = surface_of(examples.surface_keys[i]);
      REQUIRE((has_depth ? surface < kNoSurface : surface == kBeyondReach));
      REQUIRE(example_of(examples.surface_keys[i]) == i);
      count += has_depth ? 1 : 0;
    }
    return count;
  };
  REQUIRE(num_with_depth(2.0F, 0.0F) == 48);
  REQUIRE(num_with_depth(20.0F, 12.0F) == 48);  // 32 m
  REQUIRE(num_with_depth(20.0F, 13.0F) == 0);   // 33 m
  REQUIRE(num_with_depth(20.0F, -60.0F) == 0);
  REQUIRE(num_with_depth(1e3F, 0.0F) == 0);
  const FlatFrame blank(0.0F);
  sample_examples(context, blank.frame, eight_pixel_grid(), SE3{}, 42, examples);
  for (const std::uint64_t key : examples.surface_keys.to_host()) REQUIRE(surface_of(key) == kNoSurface);
}

}  // namespace
}  // namespace foothold
