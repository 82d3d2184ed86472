// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pattern.h"

namespace foothold {
namespace {

using namespace synthetic_detail;

constexpr float kNoisePatch_px = 4.0F;          // disparity errors are alike within about the matching window
constexpr float kValueNoiseToUnitSigma = 5.2F;  // value_noise() has a standard deviation of 0.19

/// A number of about normal distribution with unit variance: the sum of four bytes.
float normal_of(std::uint64_t bits, unsigned shift) {
  const std::uint64_t b = bits >> shift;
  const auto sum = static_cast<float>((b & 255U) + ((b >> 8U) & 255U) + ((b >> 16U) & 255U) + ((b >> 24U) & 255U));
  return (sum - 510.0F) * (1.0F / 147.8F);
}

/// value_noise() along one row, one cell per `patch` pixels.
class SmoothRow {
 public:
  SmoothRow(float patch_px, int width, int v, std::uint32_t seed) : inverse_patch_(1.0F / patch_px) {
    const float y = static_cast<float>(v) * inverse_patch_;
    const int iy = floor_to_int(y);
    const float f = y - static_cast<float>(iy);
    const float smooth = f * f * (3.0F - 2.0F * f);
    const int num_nodes = floor_to_int(static_cast<float>(width) * inverse_patch_) + 2;
    for (int ix = 0; ix < num_nodes; ++ix) nodes_.push_back(mix(cell_uniform(ix, iy, seed), cell_uniform(ix, iy + 1, seed), smooth) - 0.5F);
  }
  float operator()(int u) const {
    const float x = static_cast<float>(u) * inverse_patch_;
    const auto ix = static_cast<std::size_t>(x);
    const float f = x - static_cast<float>(ix);
    return mix(nodes_[ix], nodes_[ix + 1], f * f * (3.0F - 2.0F * f));
  }

 private:
  float inverse_patch_;
  std::vector<float> nodes_;
};

/// One measurement's noise: pixel numbers and a seed in, random numbers out.
class Measurement {
 public:
  Measurement(const SensorModel& model, const Room& room, const RenderedView& ideal, std::uint64_t seed)
      : model_(model), room_(room), ideal_(ideal), seed_(seed), scale_(static_cast<float>(ideal.depth.width()) / kReferenceWidth) {}

  void depth_row(int v, float* out) const {
    const std::vector<bool> shadow = shadowed(v);
    const SmoothRow smooth(kNoisePatch_px * scale_, ideal_.depth.width(), v, static_cast<std::uint32_t>(seed_));
    for (int u = 0; u < ideal_.depth.width(); ++u) out[u] = shadow[static_cast<std::size_t>(u)] ? 0.0F : depth(u, v, smooth(u));
  }

  void colour_row(int v, const float gains[3], Rgb8* out) const {
    const int width = ideal_.colour.width();
    const std::vector<float> mean = blurred_row(v);
    const float y = 2.0F * static_cast<float>(v) / static_cast<float>(ideal_.colour.height()) - 1.0F;
    for (int u = 0; u < width; ++u) {
      const float x = 2.0F * static_cast<float>(u) / static_cast<float>(width) - 1.0F;
      const float brightness = 1.0F - 0.5F * model_.vignetting * (x * x + y * y);
      const std::uint64_t bits = pixel_bits(u, v, 2);
      std::uint8_t channels[3];
      for (unsigned c = 0; c < 3; ++c) {
        // The bytes of neighbouring channels overlap: they share some noise, as after demosaicing.
        const float noise = model_.colour_sigma * normal_of(bits, 16U * c);
        const float value = mean[3 * static_cast<std::size_t>(u) + c] * brightness * gains[c] + noise;
        channels[c] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
      }
      out[u] = {channels[0], channels[1], channels[2]};
    }
  }

 private:
  std::uint64_t pixel_bits(int u, int v, std::uint64_t stream) const {
    const std::uint64_t pixel = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) << 32U) | static_cast<std::uint32_t>(u);
    return mix_bits(seed_ + stream * 0x9e3779b97f4a7c15ULL + pixel);
  }

  /// What the projector, a baseline to the right of the camera, cannot light: pixels left of something nearer. [Khoshelham2012] Sec. 2
  std::vector<bool> shadowed(int v) const {
    const int width = ideal_.depth.width();
    std::vector<bool> result(static_cast<std::size_t>(width), false);
    float leftmost = kReferenceWidth * 100.0F;
    for (int u = width - 1; u >= 0; --u) {
      const float z = ideal_.depth(u, v);
      if (z <= 0.0F) continue;
      const float column_in_projector = static_cast<float>(u) - scale_ * model_.focal_baseline_px_m / z;
      result[static_cast<std::size_t>(u)] = column_in_projector > leftmost + 1.0F;
      leftmost = std::min(leftmost, column_in_projector);
    }
    return result;
  }

  float depth(int u, int v, float smooth) const {
    const std::uint64_t bits = pixel_bits(u, v, 1);
    const int jitter_u = static_cast<int>(std::lround(model_.lateral_sigma_px * scale_ * normal_of(bits, 0)));
    const int jitter_v = static_cast<int>(std::lround(model_.lateral_sigma_px * scale_ * normal_of(bits, 24)));
    const int su = std::clamp(u + jitter_u, 0, ideal_.depth.width() - 1);
    const int sv = std::clamp(v + jitter_v, 0, ideal_.depth.height() - 1);
    const float z = ideal_.depth(su, sv);
    if (z < model_.min_depth_m || z > model_.max_depth_m) return 0.0F;

    const float white = normal_of(bits, 32);
    const Material& material = room_.primitives[static_cast<std::size_t>(ideal_.primitive(su, sv))].material;
    const float facing = saturate(ideal_.incidence_cosine(su, sv) / model_.grazing_cosine - 0.5F);
    const float luck = saturate(0.5F + 1.4F * smooth + 0.12F * white);
    const float chance = facing * material.infrared_return;
    if (chance < 1.0F && luck >= chance) return 0.0F;

    const float sigma = model_.disparity_sigma_px;
    const float disparity = model_.focal_baseline_px_m / z + sigma * (0.6F * white + 0.8F * kValueNoiseToUnitSigma * smooth);
    const float steps = std::floor(disparity / model_.disparity_step_px + 0.5F);
    return steps > 0.0F ? model_.focal_baseline_px_m / (steps * model_.disparity_step_px) : 0.0F;
  }

  /// A row of the ideal colours, three numbers a pixel, under a 3x3 binomial blur: lens, demosaicing and compression.
  std::vector<float> blurred_row(int v) const {
    const int width = ideal_.colour.width();
    const std::uint8_t* rows[3];
    for (int dv = -1; dv <= 1; ++dv) rows[dv + 1] = &ideal_.colour(0, std::clamp(v + dv, 0, ideal_.colour.height() - 1)).r;
    // A pixel's copy at either end spares the ends a special case.
    const std::size_t n = 3 * static_cast<std::size_t>(width);
    std::vector<float> column(n + 6);
    for (std::size_t i = 0; i < n; ++i) column[i + 3] = static_cast<float>(rows[0][i] + 2 * rows[1][i] + rows[2][i]);
    std::copy_n(column.begin() + 3, 3, column.begin());
    std::copy_n(column.end() - 6, 3, column.end() - 3);
    std::vector<float> result(n);
    for (std::size_t i = 0; i < n; ++i) result[i] = (column[i] + 2.0F * column[i + 3] + column[i + 6]) * (1.0F / 16.0F);
    return result;
  }

  const SensorModel& model_;
  const Room& room_;
  const RenderedView& ideal_;
  std::uint64_t seed_;
  float scale_;
};

/// A slow wave in [-1, 1] along the frames.
float drift(std::uint64_t seed, std::uint64_t stream, int frame) {
  Random random(seed, stream);
  const float period = random.uniform(150.0F, 300.0F);
  const float phase = random.uniform(0.0F, 6.2831853F);
  return std::sin(6.2831853F * static_cast<float>(frame) / period + phase);
}

}  // namespace

SensorModel sensor_model(int noise_level) {
  FOOTHOLD_EXPECTS(noise_level == 1 || noise_level == 2);
  SensorModel model;
  if (noise_level == 2) {
    model.disparity_sigma_px *= 2.0F;
    model.lateral_sigma_px *= 2.0F;
    model.grazing_cosine *= 1.5F;
    model.colour_sigma *= 2.0F;
    model.vignetting *= 2.0F;
    model.exposure_drift = 0.15F;
  }
  return model;
}

RenderedView measure(const SensorModel& model, const Room& room, RenderedView ideal, std::uint64_t seed, int frame) {
  const Measurement measurement(model, room, ideal, derive_seed(seed, static_cast<std::uint64_t>(frame)));
  const int width = ideal.depth.width();
  const int height = ideal.depth.height();
  Image<float> depth(width, height);
  Image<Rgb8> colour(width, height);
  const float exposure = 1.0F + model.exposure_drift * drift(seed, 1, frame);
  const float warmth = 0.4F * model.exposure_drift * drift(seed, 2, frame);
  const float gains[3] = {exposure * (1.0F + warmth), exposure, exposure * (1.0F - warmth)};
  for (int v = 0; v < height; ++v) {
    measurement.depth_row(v, &depth(0, v));
    measurement.colour_row(v, gains, &colour(0, v));
  }
  ideal.depth = std::move(depth);
  ideal.colour = std::move(colour);
  return ideal;
}

void add_noise(const SensorModel& model, std::uint64_t seed, int frame, Image<float>& depth, Image<Rgb8>& colour) {
  FOOTHOLD_EXPECTS(depth.width() == colour.width() && depth.height() == colour.height());
  const std::uint64_t frame_seed = derive_seed(seed, static_cast<std::uint64_t>(frame));
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::uint64_t bits = mix_bits(frame_seed + i);
    float& z = depth.data()[i];
    if (is_valid_depth(z))
      z = model.focal_baseline_px_m / std::max(model.focal_baseline_px_m / z + model.disparity_sigma_px * normal_of(bits, 0), 1.0F);
    Rgb8& pixel = colour.data()[i];
    unsigned shift = 8;  // channels share some noise, as in measure()
    for (std::uint8_t* channel : {&pixel.r, &pixel.g, &pixel.b}) {
      const float value = static_cast<float>(*channel) + model.colour_sigma * normal_of(bits, shift);
      *channel = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
      shift += 12;
    }
  }
}

}  // namespace foothold
