// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "texture.h"

#include <cmath>

#include "pattern.h"

namespace foothold::synthetic_detail {
namespace {

using Eigen::Vector3f;

Vector3f blend(const Vector3f& a, const Vector3f& b, float t) { return a + (b - a) * t; }

Vector3f plain(const Material& m, const SurfacePoint& p) {
  return m.colour * (1.0F + m.contrast * fractal_noise(p.u, p.v, 0.6F, p.footprint_m, p.seed, 2));
}

Vector3f plaster(const Material& m, const SurfacePoint& p) {
  return blend(m.colour, m.accent, saturate(0.4F * m.contrast + m.contrast * fractal_noise(p.u, p.v, m.scale_m, p.footprint_m, p.seed, 4)));
}

Vector3f wood(const Material& m, const SurfacePoint& p) {
  const int plank = floor_to_int(p.v / m.scale_m);
  const std::uint64_t bits = cell_bits(plank, 0, p.seed);
  const float along = p.u + 3.0F * uniform_of(bits, 0);
  // Rings: bent lines of slowly varying distance. Grain: noise stretched along u.
  const float bend = value_noise(along * 1.5F, p.v * 8.0F, p.seed + 7U);
  const float rings = std::sin((p.v + 0.06F * bend) * 260.0F + 9.0F * bend) * visibility(0.024F, p.footprint_m);
  const float grain = fractal_noise(along * 0.08F, p.v, 0.02F, p.footprint_m, p.seed + 13U, 2);
  const float blotches = fractal_noise(along * 0.4F, p.v, 0.25F, p.footprint_m, p.seed + 29U, 2);
  const float tint = uniform_of(bits, 1) - 0.5F;
  const float dark = m.contrast * (0.35F * rings + 0.9F * grain + 0.8F * blotches + 0.9F * tint);
  const float joint = lines(p.v, m.scale_m, 0.003F, p.footprint_m);
  return blend(m.colour, m.accent, saturate(0.35F + dark)) * (1.0F - 0.5F * joint);
}

Vector3f tiles(const Material& m, const SurfacePoint& p) {
  const int iu = floor_to_int(p.u / m.scale_m + 0.5F);
  const int iv = floor_to_int(p.v / m.scale_m + 0.5F);
  const std::uint64_t bits = cell_bits(iu, iv, p.seed);
  const float shade =
      m.contrast * ((uniform_of(bits, 0) - 0.5F) + 0.4F * fractal_noise(p.u, p.v, 0.4F * m.scale_m, p.footprint_m, p.seed, 2));
  const float half = 0.5F * m.scale_m;
  const float joint = std::max(lines(p.u + half, m.scale_m, 0.05F * m.scale_m, p.footprint_m),
                               lines(p.v + half, m.scale_m, 0.05F * m.scale_m, p.footprint_m));
  return blend(m.colour * (1.0F + shade * visibility(2.0F * m.scale_m, p.footprint_m)), m.accent, joint);
}

Vector3f checker(const Material& m, const SurfacePoint& p) {
  const float a = lines(p.u, 2.0F * m.scale_m, m.scale_m, p.footprint_m);
  const float b = lines(p.v, 2.0F * m.scale_m, m.scale_m, p.footprint_m);
  const float stain = 1.0F + 0.3F * m.contrast * fractal_noise(p.u, p.v, 0.5F, p.footprint_m, p.seed, 3);
  return blend(m.colour, m.accent, a + b - 2.0F * a * b) * stain;
}

Vector3f stripes(const Material& m, const SurfacePoint& p) {
  // Irregular stripes across u, broken along v as in woven carpet.
  const int segment = floor_to_int(p.v / (8.0F * m.scale_m) + cell_uniform(floor_to_int(p.u / m.scale_m), 1, p.seed));
  const std::uint64_t bits = cell_bits(floor_to_int(p.u / m.scale_m), segment, p.seed);
  const float seen = visibility(2.0F * m.scale_m, p.footprint_m);
  const float t = mix(0.5F, uniform_of(bits, 0), seen * (0.3F + 0.7F * m.contrast));
  return blend(m.colour, m.accent, t) * (1.0F + 0.3F * m.contrast * fractal_noise(p.u, p.v, 0.7F, p.footprint_m, p.seed, 2));
}

/// Coverage by print: lines of words with gaps.
float print(float u, float v, float line_m, float left, float right, float footprint, std::uint32_t seed) {
  const int row = floor_to_int(v / line_m);
  const std::uint64_t row_bits = cell_bits(row, 5, seed);
  if (uniform_of(row_bits, 0) < 0.12F) return 0.0F;  // between paragraphs
  const float end = mix(right, left, uniform_of(row_bits, 1) < 0.25F ? 0.6F * uniform_of(row_bits, 2) : 0.03F);
  const float letter_m = 0.6F * line_m;
  const std::uint64_t letter = cell_bits(floor_to_int(u / letter_m), row, seed);
  const bool gap = uniform_of(letter, 0) < 0.17F;
  const float ink = gap ? 0.0F : 0.6F + 0.4F * uniform_of(letter, 1);
  const float in_row = within(v / line_m - static_cast<float>(row), 0.2F, 0.75F, footprint / line_m);
  const float sharp = mix(0.35F, ink * in_row, visibility(2.0F * letter_m, footprint));
  return sharp * within(u, left, end, footprint);
}

Vector3f text(const Material& m, const SurfacePoint& p) {
  const float ink = print(p.u, p.v, m.scale_m, -0.85F * p.half_u, 0.85F * p.half_u, p.footprint_m, p.seed) *
                    within(p.v, -0.88F * p.half_v, 0.88F * p.half_v, p.footprint_m);
  const float fold = 1.0F + 0.15F * fractal_noise(p.u, p.v, 0.3F, p.footprint_m, p.seed, 2);
  return blend(m.colour, m.accent, ink * m.contrast) * fold;
}

/// Coverage by the n-th random shape of a poster: a disc, a bar, a block or a ring.
float poster_shape(std::uint64_t bits, float u, float v, const SurfacePoint& p) {
  const float extent = std::min(p.half_u, p.half_v);
  const float cu = (2.0F * uniform_of(bits, 0) - 1.0F) * p.half_u;
  const float cv = (2.0F * uniform_of(bits, 1) - 1.0F) * p.half_v;
  const float size = (0.15F + 0.5F * uniform_of(bits, 2)) * extent;
  const float du = u - cu;
  const float dv = v - cv;
  switch ((bits >> 60U) & 3U) {
    case 0:
      return below_edge(std::sqrt(du * du + dv * dv), size, p.footprint_m);
    case 1:
      return within(0.8F * du + 0.6F * dv, -0.25F * size, 0.25F * size, p.footprint_m);
    case 2:
      return within(du, -size, size, p.footprint_m) * within(dv, -0.5F * size, 0.5F * size, p.footprint_m);
    default:
      return within(std::sqrt(du * du + dv * dv), 0.6F * size, size, p.footprint_m);
  }
}

Vector3f poster(const Material& m, const SurfacePoint& p) {
  Vector3f colour = m.colour * (1.0F + 0.5F * p.v / p.half_v * m.contrast);
  colour *= 1.0F + 0.5F * m.contrast * fractal_noise(p.u, p.v, 0.5F * p.half_u, p.footprint_m, p.seed, 4);
  const int num_shapes = 4 + static_cast<int>(cell_bits(0, 77, p.seed) & 3U);
  for (int i = 0; i < num_shapes; ++i) {
    const Vector3f shape_colour = random_colour(cell_bits(i, 78, p.seed));
    colour = blend(colour, shape_colour, 0.9F * poster_shape(cell_bits(i, 79, p.seed), p.u, p.v, p));
  }
  // A caption at the bottom and a pale border.
  const float caption = within(p.v, -0.8F * p.half_v, -0.5F * p.half_v, p.footprint_m);
  colour = blend(colour, m.accent, caption * print(p.u, p.v, 0.11F * p.half_v, -0.75F * p.half_u, 0.75F * p.half_u, p.footprint_m, p.seed));
  const float border = 0.05F * std::min(p.half_u, p.half_v);
  const float inside =
      within(p.u, border - p.half_u, p.half_u - border, p.footprint_m) * within(p.v, border - p.half_v, p.half_v - border, p.footprint_m);
  return blend(Vector3f(0.85F, 0.85F, 0.82F), colour, inside);
}

Vector3f spine(const Material& m, const SurfacePoint& p) {
  const std::uint64_t bits = cell_bits(3, 4, p.seed);
  const float v = p.v / p.half_v;
  const float footprint = p.footprint_m / p.half_v;
  const float band =
      within(std::fabs(v), 0.62F + 0.2F * uniform_of(bits, 0), 0.92F, footprint) * (uniform_of(bits, 1) < 0.6F ? 1.0F : 0.0F);
  const float title = within(v, -0.45F, 0.1F + 0.4F * uniform_of(bits, 2), footprint) *
                      within(p.u, -0.45F * p.half_u, 0.45F * p.half_u, p.footprint_m) *
                      (cell_uniform(floor_to_int(p.v / 0.012F), 9, p.seed) < 0.75F ? 1.0F : 0.25F);
  return blend(m.colour, m.accent, saturate(band + 0.9F * title)) *
         (1.0F + 0.4F * m.contrast * fractal_noise(p.u, p.v, 0.05F, p.footprint_m, p.seed, 2));
}

Vector3f fabric(const Material& m, const SurfacePoint& p) {
  const float weave =
      0.5F * visibility(2.0F * m.scale_m, p.footprint_m) * std::sin(p.u * 6.2832F / m.scale_m) * std::sin(p.v * 6.2832F / m.scale_m);
  const float folds = fractal_noise(p.u, p.v, 0.22F, p.footprint_m, p.seed, 3);
  return blend(m.colour, m.accent, saturate(0.25F + m.contrast * (0.7F * weave + 1.1F * folds)));
}

Vector3f speckle(const Material& m, const SurfacePoint& p) {
  const float fine = fractal_noise(p.u, p.v, m.scale_m, p.footprint_m, p.seed, 2);
  const float coarse = fractal_noise(p.u, p.v, 12.0F * m.scale_m, p.footprint_m, p.seed + 3U, 2);
  return blend(m.colour, m.accent, saturate(0.3F + m.contrast * (1.6F * fine + 0.5F * coarse)));
}

Vector3f bricks(const Material& m, const SurfacePoint& p) {
  const float height = 0.35F * m.scale_m;
  const int row = floor_to_int(p.v / height);
  const float u = p.u + ((row & 1) != 0 ? 0.5F * m.scale_m : 0.0F);
  const std::uint64_t bits = cell_bits(floor_to_int(u / m.scale_m), row, p.seed);
  const float mortar = std::max(lines(u, m.scale_m, 0.012F, p.footprint_m), lines(p.v, height, 0.012F, p.footprint_m));
  const float shade =
      visibility(m.scale_m, p.footprint_m) * (uniform_of(bits, 0) - 0.5F) + 0.6F * fractal_noise(p.u, p.v, 0.1F, p.footprint_m, p.seed, 3);
  return blend(m.colour * (1.0F + m.contrast * shade), m.accent, mortar);
}

Vector3f keyboard(const Material& m, const SurfacePoint& p) {
  constexpr float kKey = 0.019F;
  const float gap = std::max(lines(p.u, kKey, 0.004F, p.footprint_m), lines(p.v, kKey, 0.004F, p.footprint_m));
  const float special = cell_uniform(floor_to_int(p.u / kKey), floor_to_int(p.v / kKey), p.seed) < 0.2F ? 0.7F : 1.0F;
  return blend(m.colour * special, m.accent, gap);
}

Vector3f screen(const Material& m, const SurfacePoint& p) {
  Vector3f colour = blend(m.colour, m.accent, saturate(0.5F + 0.5F * p.v / p.half_v));
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t bits = cell_bits(i, 31, p.seed);
    const float left = (-0.95F + 1.0F * uniform_of(bits, 0)) * p.half_u;
    const float bottom = (-0.9F + 0.9F * uniform_of(bits, 1)) * p.half_v;
    const float right = left + (0.5F + 0.4F * uniform_of(bits, 2)) * p.half_u;
    const float top = bottom + (0.6F + 0.5F * uniform_of(bits, 3)) * p.half_v;
    const float inside = within(p.u, left, right, p.footprint_m) * within(p.v, bottom, top, p.footprint_m);
    const float ink = print(p.u, p.v, 0.013F, left + 0.01F, right - 0.01F, p.footprint_m, p.seed + static_cast<std::uint32_t>(i));
    const float bar = below_edge(top - p.v, 0.015F, p.footprint_m);
    const Vector3f page = (bits & 1U) != 0 ? Vector3f(0.88F, 0.9F, 0.92F) : Vector3f(0.1F, 0.12F, 0.14F);
    const Vector3f letters = (bits & 1U) != 0 ? Vector3f(0.15F, 0.15F, 0.25F) : Vector3f(0.5F, 0.8F, 0.5F);
    colour = blend(colour, blend(blend(page, letters, ink), random_colour(bits), bar), inside);
  }
  const float edge = 0.012F;
  const float lit =
      within(p.u, edge - p.half_u, p.half_u - edge, p.footprint_m) * within(p.v, edge - p.half_v, p.half_v - edge, p.footprint_m);
  return colour * lit + Vector3f::Constant(0.04F);
}

Vector3f foliage(const Material& m, const SurfacePoint& p) {
  const float leaves = fractal_noise(p.u + 0.3F * p.v, p.v - 0.3F * p.u, m.scale_m, p.footprint_m, p.seed, 3);
  return blend(m.colour, m.accent, saturate(0.45F + 1.6F * m.contrast * leaves));
}

}  // namespace

Eigen::Vector3f texture_colour(const Material& material, const SurfacePoint& point) {
  switch (material.texture) {
    case Texture::kPlain:
      return plain(material, point);
    case Texture::kPlaster:
      return plaster(material, point);
    case Texture::kWood:
      return wood(material, point);
    case Texture::kTiles:
      return tiles(material, point);
    case Texture::kChecker:
      return checker(material, point);
    case Texture::kStripes:
      return stripes(material, point);
    case Texture::kText:
      return text(material, point);
    case Texture::kPoster:
      return poster(material, point);
    case Texture::kSpine:
      return spine(material, point);
    case Texture::kFabric:
      return fabric(material, point);
    case Texture::kSpeckle:
      return speckle(material, point);
    case Texture::kBricks:
      return bricks(material, point);
    case Texture::kKeyboard:
      return keyboard(material, point);
    case Texture::kScreen:
      return screen(material, point);
    case Texture::kFoliage:
      return foliage(material, point);
  }
  return material.colour;
}

}  // namespace foothold::synthetic_detail
