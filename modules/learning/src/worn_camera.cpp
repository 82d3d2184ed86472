// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "worn_camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace foothold {

namespace {
constexpr float kTwoPi = 6.2831853F;
constexpr float kRadPerDeg = 0.0174533F;
/// Misalignment of colour and depth of a Kinect without calibration [px of 640].
constexpr float kShiftPx = 12.0F;
/// Relative error of depth at 1 m; it grows with depth, as the error of a stereo camera's calibration does.
constexpr float kDistortion = 0.004F;
/// Deviation of the logarithms of exposure, of contrast and of each channel's gain.
constexpr float kExposure = 0.35F;
constexpr float kContrast = 0.2F;
constexpr float kBalance = 0.08F;
/// Widest band by which near surfaces bleed over what is behind them [px of 640], and the step in depth that makes an edge.
constexpr float kBleedingPx = 7.0F;
constexpr float kEdge = 0.05F;
/// Longest blur [px of 640], to either side.
constexpr float kBlurPx = 5.0F;

float symmetric(Random& random) { return random.uniform(-1.0F, 1.0F); }

/// The mean along a short line through each pixel; also moves the image.
Image<Rgb8> shift_and_blur(const Image<Rgb8>& colour, int shift_u, int shift_v, float blur_u, float blur_v) {
  const int steps = static_cast<int>(std::ceil(std::max(std::abs(blur_u), std::abs(blur_v))));
  Image<Rgb8> result(colour.width(), colour.height());
  for (int v = 0; v < colour.height(); ++v) {
    for (int u = 0; u < colour.width(); ++u) {
      int sum[3] = {};
      for (int i = -steps; i <= steps; ++i) {
        const float along = steps > 0 ? static_cast<float>(i) / static_cast<float>(steps) : 0.0F;
        const int x = std::clamp(u + shift_u + static_cast<int>(std::lround(along * blur_u)), 0, colour.width() - 1);
        const int y = std::clamp(v + shift_v + static_cast<int>(std::lround(along * blur_v)), 0, colour.height() - 1);
        const Rgb8& pixel = colour(x, y);
        sum[0] += pixel.r;
        sum[1] += pixel.g;
        sum[2] += pixel.b;
      }
      const int count = 2 * steps + 1;
      result(u, v) = {static_cast<std::uint8_t>(sum[0] / count), static_cast<std::uint8_t>(sum[1] / count),
                      static_cast<std::uint8_t>(sum[2] / count)};
    }
  }
  return result;
}

/// A channel's values after exposure and contrast changed.
std::array<std::uint8_t, 256> tone_curve(float gain, float contrast) {
  std::array<std::uint8_t, 256> curve{};
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const float value = 255.0F * gain * std::pow(static_cast<float>(i) / 255.0F, contrast);
    curve[i] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F));
  }
  return curve;
}
}  // namespace

WornCamera::WornCamera(float wear, Random& random)
    : wear_(wear),
      shift_u_px_(static_cast<int>(std::lround(wear * kShiftPx * symmetric(random)))),
      shift_v_px_(static_cast<int>(std::lround(wear * kShiftPx * symmetric(random)))) {
  for (int i = 0; i < 3; ++i) distortion_[i] = wear * kDistortion * symmetric(random);
}

void WornCamera::wear(RgbdFrame& frame, Random& random) const {
  if (wear_ <= 0.0F) return;
  distort_depth(frame.depth);
  bleed_edges(frame.depth, random);
  if (!frame.colour.empty()) adjust_colour(frame.colour, random);
}

void WornCamera::distort_depth(Image<float>& depth) const {
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float x = 2.0F * static_cast<float>(u) / static_cast<float>(depth.width()) - 1.0F;
      const float y = 2.0F * static_cast<float>(v) / static_cast<float>(depth.height()) - 1.0F;
      float& depth_m = depth(u, v);
      depth_m += depth_m * depth_m * distortion_.dot(Eigen::Vector3f(1.0F, x, x * x + y * y));
    }
  }
}

void WornCamera::bleed_edges(Image<float>& depth, Random& random) const {
  const float scale = static_cast<float>(depth.width()) / 640.0F;
  const int reach = static_cast<int>(std::lround(wear_ * kBleedingPx * scale * random.uniform()));
  const int direction = random.uniform() < 0.5F ? 1 : -1;  // the side on which the projector's shadow falls, or motion spreads
  for (int v = 0; v < depth.height(); ++v) {
    int left = 0;
    float near_m = 0.0F;
    for (int i = 0; i < depth.width(); ++i) {
      float& depth_m = depth(direction > 0 ? i : depth.width() - 1 - i, v);
      const bool is_edge = near_m > 0.0F && depth_m > near_m * (1.0F + kEdge);
      if (is_edge && left > 0) {
        --left;
        depth_m = near_m;
      } else {
        left = reach;
        near_m = depth_m;
      }
    }
  }
}

void WornCamera::adjust_colour(Image<Rgb8>& colour, Random& random) const {
  const float scale = static_cast<float>(colour.width()) / 640.0F;
  const float blur = wear_ * kBlurPx * scale * random.uniform();
  const float direction = kTwoPi * random.uniform();
  const auto shift = [&](int shift_px) { return static_cast<int>(std::lround(scale * static_cast<float>(shift_px))); };
  colour = shift_and_blur(colour, shift(shift_u_px_), shift(shift_v_px_), blur * std::cos(direction), blur * std::sin(direction));
  const float exposure = kExposure * symmetric(random);
  const float contrast = std::exp(wear_ * kContrast * symmetric(random));
  std::array<std::uint8_t, 256> curves[3];
  for (auto& curve : curves) curve = tone_curve(std::exp(wear_ * (exposure + kBalance * symmetric(random))), contrast);
  for (std::size_t i = 0; i < colour.size(); ++i) {
    Rgb8& pixel = colour.data()[i];
    pixel = {curves[0][pixel.r], curves[1][pixel.g], curves[2][pixel.b]};
  }
}

void add_strangers(RgbdFrame& frame, float size, Random& random) {
  Image<float>& depth = frame.depth;
  const auto width = static_cast<float>(depth.width());
  for (std::uint32_t count = random.below(4); count > 0; --count) {
    // Drawn in statements: the order of arguments is the compiler's.
    const float centre_v = static_cast<float>(depth.height()) * random.uniform();
    const Eigen::Vector2f centre(width * random.uniform(), centre_v);
    const float tallness = random.uniform(0.2F, 1.0F);
    const Eigen::Vector2f radius = 0.5F * size * width * Eigen::Vector2f(random.uniform(0.2F, 1.0F), tallness);
    const float nearer = random.uniform(0.6F, 0.95F);
    const float behind_m = depth(static_cast<int>(centre.x()), static_cast<int>(centre.y()));
    if (behind_m <= 0.0F) continue;
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        const Eigen::Vector2f off = (Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v)) - centre).cwiseQuotient(radius);
        if (off.squaredNorm() < 1.0F && depth(u, v) > nearer * behind_m) depth(u, v) = nearer * behind_m;
      }
    }
  }
}

PoseDrift::PoseDrift(float drift_m, float drift_deg, Random& random) : drift_m_(drift_m), drift_rad_(drift_deg * kRadPerDeg) {
  constexpr float kShortestPeriod = 60.0F;
  constexpr float kLongestPeriod = 240.0F;
  for (int i = 0; i < 6; ++i) {
    phase_[i] = kTwoPi * random.uniform();
    period_frames_[i] = random.uniform(kShortestPeriod, kLongestPeriod);
  }
}

SE3 PoseDrift::apply(const SE3& world_from_camera, int frame_index) const {
  Tangent6 error;
  for (int i = 0; i < 6; ++i) {
    const float wave = std::sin(kTwoPi * static_cast<float>(frame_index) / period_frames_[i] + phase_[i]);
    error[i] = wave * (i < 3 ? drift_rad_ : drift_m_);
  }
  SE3 result = world_from_camera * se3_exp(error);
  result.rotation = nearest_rotation(result.rotation);
  return result;
}

}  // namespace foothold
