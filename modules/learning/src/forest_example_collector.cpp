// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_example_collector.h"

#include <algorithm>
#include <cmath>

#include "foothold/base/angle.h"
#include "foothold/base/exec/cpu_executor.h"
#include "rolled_frame.h"

namespace foothold {
namespace {

enum : std::uint64_t { kFeatureStream = 100, kPixelStream, kPartnerStream, kRollStream };

constexpr std::size_t kMaxSeenViews = 256;  // 150 kB each at a quarter of 640x480
constexpr int kPixelDraws = 64;             // after which a frame is taken to have no depth
constexpr int kPartnerDraws = 8;
constexpr float kSamePointM = 0.03F;     // two views see one point if their depths agree this well, and ...
constexpr float kSamePointPerM = 0.02F;  // ... this much better or worse per metre, as the sensor's noise grows

std::int16_t clamp_to_int16(int value) { return static_cast<std::int16_t>(std::clamp(value, -32768, 32767)); }

}  // namespace

std::vector<ForestFeature> draw_training_features(const ForestTrainingSettings& settings) {
  constexpr float kTwoPi = 6.28318530718F;
  const auto num_depth = static_cast<int>(std::lround(settings.depth_fraction * static_cast<float>(settings.num_features)));
  std::vector<ForestFeature> features;
  for (int i = 0; i < settings.num_features; ++i) {
    Random random(derive_seed(settings.seed, kFeatureStream), static_cast<std::uint64_t>(i));
    const float angle = random.uniform(0.0F, kTwoPi);
    const float radius = random.uniform(settings.min_offset_px_m, settings.max_offset_px_m);
    const auto channel = i < num_depth ? FeatureChannel::kDepth : static_cast<FeatureChannel>(1 + random.below(3));
    features.push_back({channel, radius * std::cos(angle), radius * std::sin(angle)});
  }
  return features;
}

bool ForestExampleCollector::collect(const Sequence& sequence, std::size_t scene, const std::function<bool()>& frame_done,
                                     ForestExamples& examples) {
  const std::size_t old_size = examples.size();
  seen_views_.clear();
  num_views_ = 0;
  for (int index = 0; index < sequence.num_frames(); index += settings_.frame_stride) {
    const RgbdFrame frame = sequence.load(index);
    if (frame.world_from_camera) {
      for (int copy = 0; copy <= settings_.rolled_copies; ++copy) {
        const std::uint64_t key = derive_seed(derive_seed(scene, static_cast<std::uint64_t>(index)), static_cast<std::uint64_t>(copy));
        if (copy == 0) {
          add_frame(frame, key, examples);
        } else {
          const float angle_deg =
              Random(derive_seed(settings_.seed, kRollStream), key).uniform(-settings_.max_roll_deg, settings_.max_roll_deg);
          add_frame(rolled_frame(frame, angle_deg * kRadPerDeg), key, examples);
        }
      }
    }
    if (!frame_done()) {
      examples.values.resize(old_size * examples.row_size());
      examples.points_world.resize(old_size);
      return false;
    }
  }
  if (examples.scene_begins.empty()) examples.scene_begins.push_back(0);
  examples.scene_begins.push_back(examples.size());
  return true;
}

void ForestExampleCollector::add_frame(const RgbdFrame& frame, std::uint64_t frame_key, ForestExamples& examples) {
  FeatureImage feature_image(context_);
  feature_image.compute(context_, frame.view(), settings_.downscale);
  const FeatureImageView image = feature_image.view();
  std::vector<Pixel> pixels;
  for (int i = 0; i < examples_per_frame_; ++i) {
    const Pixel pixel = sample_pixel(
        frame, image, Random(derive_seed(settings_.seed, kPixelStream), derive_seed(frame_key, static_cast<std::uint64_t>(i))));
    if (pixel.u >= 0) pixels.push_back(pixel);
  }
  const std::size_t first = examples.size();
  examples.points_world.resize(first + pixels.size());
  examples.values.resize((first + pixels.size()) * examples.row_size());
  struct NoScratch {};
  constexpr std::size_t kGrain = 64;
  const std::size_t num_chunks = (pixels.size() + kGrain - 1) / kGrain;
  CpuExecutor(context_).for_each_team<NoScratch>(num_chunks, [&](CpuTeam, NoScratch&, std::size_t chunk) {
    for (std::size_t i = chunk * kGrain; i < std::min(pixels.size(), (chunk + 1) * kGrain); ++i) {
      const auto [u, v] = pixels[i];
      const Eigen::Vector3f point_camera =
          frame.calibration.depth.back_project(static_cast<float>(u), static_cast<float>(v), frame.depth(u, v));
      examples.points_world[first + i] = *frame.world_from_camera * point_camera;
      std::int16_t* row = examples.values.data() + (first + i) * examples.row_size();
      evaluate(image, clamp_index(u / settings_.downscale, image.width), clamp_index(v / settings_.downscale, image.height), row);
      if (!examples.paired) continue;
      const Random random(derive_seed(settings_.seed, kPartnerStream), derive_seed(frame_key, i));
      std::int16_t* partner_row = row + examples.num_features;
      if (!evaluate_in_other_view(examples.points_world[first + i], random, partner_row))
        std::copy(row, row + examples.num_features, partner_row);
    }
  });
  if (examples.paired) remember_view(frame, image);
}

/// A random pixel of a frame that has depth there and in its feature image.
ForestExampleCollector::Pixel ForestExampleCollector::sample_pixel(const RgbdFrame& frame, const FeatureImageView& image,
                                                                   Random random) const {
  for (int draw = 0; draw < kPixelDraws; ++draw) {
    const int u = static_cast<int>(random.below(static_cast<std::uint32_t>(frame.depth.width())));
    const int v = static_cast<int>(random.below(static_cast<std::uint32_t>(frame.depth.height())));
    const int feature_u = clamp_index(u / settings_.downscale, image.width);
    const int feature_v = clamp_index(v / settings_.downscale, image.height);
    if (is_valid_depth(frame.depth(u, v)) && image.pixels[feature_v * image.width + feature_u].depth_mm() > 0) return {u, v};
  }
  return {};
}

/// @param u, v  Pixel of the feature image; has depth.
void ForestExampleCollector::evaluate(const FeatureImageView& image, int u, int v, std::int16_t* values) const {
  const float px_per_offset = image.offset_scale_px_mm / static_cast<float>(image.pixels[v * image.width + u].depth_mm());
  for (std::size_t f = 0; f < features_.size(); ++f) values[f] = clamp_to_int16(evaluate_feature(image, u, v, px_per_offset, features_[f]));
}

/// Looks for a point in a few views seen before. @return False if none of them sees it.
bool ForestExampleCollector::evaluate_in_other_view(const Eigen::Vector3f& point_world, Random random, std::int16_t* values) const {
  constexpr float kMillimetresPerMetre = 1000.0F;
  for (int draw = 0; draw < kPartnerDraws && !seen_views_.empty(); ++draw) {
    const SeenView& view = seen_views_[random.below(static_cast<std::uint32_t>(seen_views_.size()))];
    const Eigen::Vector3f point_camera = view.camera_from_world * point_world;
    if (point_camera.z() <= 0.0F) continue;
    const Eigen::Vector2f pixel = view.intrinsics.project(point_camera);
    const int u = static_cast<int>(std::floor(pixel.x() + 0.5F));
    const int v = static_cast<int>(std::floor(pixel.y() + 0.5F));
    if (u < 0 || v < 0 || u >= view.image.width || v >= view.image.height) continue;
    const int depth_mm = view.image.pixels[v * view.image.width + u].depth_mm();
    const float tolerance_m = kSamePointM + kSamePointPerM * point_camera.z();
    if (depth_mm <= 0 || std::abs(static_cast<float>(depth_mm) / kMillimetresPerMetre - point_camera.z()) > tolerance_m) continue;
    evaluate(view.image, u, v, values);
    return true;
  }
  return false;
}

/// Keeps views to pair later ones with; when there are enough, a new one takes the place of the oldest.
void ForestExampleCollector::remember_view(const RgbdFrame& frame, const FeatureImageView& image) {
  if (seen_views_.size() < kMaxSeenViews) seen_views_.emplace_back();
  SeenView& view = seen_views_[num_views_ % kMaxSeenViews];
  ++num_views_;
  view.pixels.assign(image.pixels, image.pixels + static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  view.image = image;
  view.image.pixels = view.pixels.data();
  view.intrinsics = frame.calibration.depth.scaled(1.0F / static_cast<float>(settings_.downscale));
  view.camera_from_world = frame.world_from_camera->inverse();
}

}  // namespace foothold
