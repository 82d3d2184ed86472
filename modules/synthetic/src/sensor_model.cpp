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

/// The width for which lengths in pixels are given.
constexpr float kReferenceWidth = 640.0F;
constexpr float kNoisePatch_px = 4.0F;          // disparity errors are alike within about the matching window
constexpr float kValueNoiseToUnitSigma = 5.2F;  // value_noise() has a standard deviation of 0.19

/// A number of about normal distribution with unit variance: the sum of four bytes.
float normal_of(std::uint64_t bits, unsigned shift) {
  const std::uint64_t b = bits >> shift;
  const auto sum = static_cast<float>((b & 255U) + ((b >> 8U) & 255U) + ((b >> 16U) & 255U) + ((b >> 24U) & 255U));
  return (sum - 510.0F) * (1.0F / 147.8F);
}

/// One measurement's noise: pixel numbers and a seed in, random numbers out.
class Measurement {
 public:
  Measurement(const SensorModel& model, const Room& room, const RenderedView& ideal, std::uint64_t seed)
      : model_(model), room_(room), ideal_(ideal), seed_(seed), scale_(static_cast<float>(ideal.depth.width()) / kReferenceWidth) {}

  void depth_row(int v, float* out) const {
    const std::vector<bool> shadow = shadowed(v);
    for (int u = 0; u < ideal_.depth.width(); ++u) out[u] = shadow[static_cast<std::size_t>(u)] ? 0.0F : depth(u, v);
  }

  void colour_row(int v, float red_gain, float green_gain, float blue_gain, Rgb8* out) const {
    const int width = ideal_.colour.width();
    const int height = ideal_.colour.height();
    const float y = 2.0F * static_cast<float>(v) / static_cast<float>(height) - 1.0F;
    for (int u = 0; u < width; ++u) {
      const float x = 2.0F * static_cast<float>(u) / static_cast<float>(width) - 1.0F;
      const float gain = 1.0F - 0.5F * model_.vignetting * (x * x + y * y);
      const std::uint64_t bits = pixel_bits(u, v, 2);
      const auto noisy = [&](float value, float channel_gain, unsigned shift) {
        const float noise = model_.colour_sigma * normal_of(bits, shift);
        return static_cast<std::uint8_t>(std::clamp(value * gain * channel_gain + noise, 0.0F, 255.0F) + 0.5F);
      };
      const Eigen::Vector3f mean = blurred(u, v);
      // The bytes overlap: neighbouring channels share some noise, as after demosaicing.
      out[u] = {noisy(mean.x(), red_gain, 0), noisy(mean.y(), green_gain, 16), noisy(mean.z(), blue_gain, 32)};
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

  float depth(int u, int v) const {
    const std::uint64_t bits = pixel_bits(u, v, 1);
    const int jitter_u = static_cast<int>(std::lround(model_.lateral_sigma_px * scale_ * normal_of(bits, 0)));
    const int jitter_v = static_cast<int>(std::lround(model_.lateral_sigma_px * scale_ * normal_of(bits, 24)));
    const int su = std::clamp(u + jitter_u, 0, ideal_.depth.width() - 1);
    const int sv = std::clamp(v + jitter_v, 0, ideal_.depth.height() - 1);
    const float z = ideal_.depth(su, sv);
    if (z < model_.min_depth_m || z > model_.max_depth_m) return 0.0F;

    const auto seed = static_cast<std::uint32_t>(seed_);
    const float patch = kNoisePatch_px * scale_;
    const float smooth = value_noise(static_cast<float>(u) / patch, static_cast<float>(v) / patch, seed);
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

  /// The ideal colour under a 3x3 binomial blur: lens, demosaicing and compression.
  Eigen::Vector3f blurred(int u, int v) const {
    static constexpr float kWeights[3] = {0.25F, 0.5F, 0.25F};
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int dv = -1; dv <= 1; ++dv) {
      const int sv = std::clamp(v + dv, 0, ideal_.colour.height() - 1);
      for (int du = -1; du <= 1; ++du) {
        const Rgb8& c = ideal_.colour(std::clamp(u + du, 0, ideal_.colour.width() - 1), sv);
        sum += kWeights[du + 1] * kWeights[dv + 1] *
               Eigen::Vector3f(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b));
      }
    }
    return sum;
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
  for (int v = 0; v < height; ++v) {
    measurement.depth_row(v, &depth(0, v));
    measurement.colour_row(v, exposure * (1.0F + warmth), exposure, exposure * (1.0F - warmth), &colour(0, v));
  }
  ideal.depth = std::move(depth);
  ideal.colour = std::move(colour);
  return ideal;
}

}  // namespace foothold
