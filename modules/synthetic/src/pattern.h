// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What procedural textures are made of: lattice noise, lines and random colours, each blurred to the size of a pixel on the surface.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "foothold/base/platform.h"
#include "foothold/base/random.h"

namespace foothold::synthetic_detail {

/// 64 random bits of a lattice cell.
FOOTHOLD_INLINE std::uint64_t cell_bits(int x, int y, std::uint32_t seed) {
  const std::uint64_t cell = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) | static_cast<std::uint32_t>(y);
  return mix_bits(cell ^ (seed * 0x9e3779b97f4a7c15ULL));
}

/// The n-th of four uniform numbers in [0, 1) held by 64 random bits.
FOOTHOLD_INLINE float uniform_of(std::uint64_t bits, unsigned n) { return static_cast<float>((bits >> (16U * n)) & 0xffffU) * 0x1p-16F; }

FOOTHOLD_INLINE float cell_uniform(int x, int y, std::uint32_t seed) { return uniform_of(cell_bits(x, y, seed), 3); }

FOOTHOLD_INLINE int floor_to_int(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x ? 1 : 0);
}

FOOTHOLD_INLINE float mix(float a, float b, float t) { return a + (b - a) * t; }
FOOTHOLD_INLINE float saturate(float x) { return std::min(std::max(x, 0.0F), 1.0F); }

/// Smooth noise in [-0.5, 0.5] with one random value per unit cell.
inline float value_noise(float x, float y, std::uint32_t seed) {
  const int ix = floor_to_int(x);
  const int iy = floor_to_int(y);
  float fx = x - static_cast<float>(ix);
  float fy = y - static_cast<float>(iy);
  fx = fx * fx * (3.0F - 2.0F * fx);
  fy = fy * fy * (3.0F - 2.0F * fy);
  const float low = mix(cell_uniform(ix, iy, seed), cell_uniform(ix + 1, iy, seed), fx);
  const float high = mix(cell_uniform(ix, iy + 1, seed), cell_uniform(ix + 1, iy + 1, seed), fx);
  return mix(low, high, fy) - 0.5F;
}

/// How much of a pattern of this wavelength survives pixels of this size: 1 sharp, 0 blurred away.
inline float visibility(float wavelength, float footprint) { return saturate(2.0F - 4.0F * footprint / wavelength); }

/// Noise of wavelengths `scale`, `scale` / 3, ..., in about [-0.7, 0.7]; octaves finer than a pixel vanish.
inline float fractal_noise(float u, float v, float scale, float footprint, std::uint32_t seed, int octaves = 3) {
  float sum = 0.0F;
  float amplitude = 1.0F;
  for (int i = 0; i < octaves; ++i) {
    const float seen = visibility(scale, footprint);
    if (seen <= 0.0F) break;
    sum += seen * amplitude * value_noise(u / scale, v / scale, seed + static_cast<std::uint32_t>(i) * 101U);
    amplitude *= 0.55F;
    scale *= 0.33F;
  }
  return sum;
}

/// Coverage of a pixel by the half line x < edge.
inline float below_edge(float x, float edge, float footprint) { return saturate((edge - x) / footprint + 0.5F); }

/// Coverage of a pixel by the interval [low, high].
inline float within(float x, float low, float high, float footprint) {
  return saturate(below_edge(x, high, footprint) - below_edge(x, low, footprint));
}

/// Coverage of a pixel by lines of a width, one per period, centred on its multiples.
inline float lines(float x, float period, float width, float footprint) {
  const float distance = std::fabs(x - period * std::floor(x / period + 0.5F));
  return mix(width / period, below_edge(distance, 0.5F * width, footprint), visibility(period, footprint));
}

/// A vivid or pale colour from 64 random bits.
inline Eigen::Vector3f random_colour(std::uint64_t bits) {
  const float hue = uniform_of(bits, 0) * 6.0F;
  const float saturation = 0.1F + 0.7F * uniform_of(bits, 1);
  const float value = 0.2F + 0.6F * uniform_of(bits, 2);
  const auto channel = [&](float shift) {
    const float k = std::fmod(hue + shift, 6.0F);
    return value * (1.0F - saturation * saturate(std::min(k, 4.0F - k)));
  };
  return {channel(5.0F), channel(3.0F), channel(1.0F)};
}

}  // namespace foothold::synthetic_detail
