// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cmath>

#include "furniture.h"

namespace foothold::synthetic_detail {
namespace {

/// Five legs on castors and a gas spring, up to the seat.
void swivel_base(const RoomBuilder& b, float seat_z) {
  const Material steel = gloss({0.25F, 0.25F, 0.27F}, 0.9F);
  for (int leg = 0; leg < 5; ++leg) {
    const RoomBuilder at = b.at(0.0F, 0.0F, 0.0F, 72.0F * static_cast<float>(leg));
    at.rod({0.0F, 0.0F, 0.1F}, {0.0F, -0.28F, 0.06F}, 0.02F, steel);
    at.sphere({0.0F, -0.28F, 0.03F}, 0.03F, plain({0.1F, 0.1F, 0.1F}));
  }
  b.cylinder({0.0F, 0.0F, 0.08F}, 0.03F, seat_z - 0.08F, steel);
}

}  // namespace

RoomBuilder Choices::jitter(const RoomBuilder& b, float shift_m, float z, float turn_deg) {
  const float x = between(-shift_m, shift_m);
  const float y = between(-shift_m, shift_m);
  return b.at(x, y, z, between(-turn_deg, turn_deg));
}

Colour Choices::colour() {
  const float hue = between(0.0F, 6.0F);
  const float vividness = between(0.0F, 1.0F);
  const float saturation = 0.1F + 0.7F * vividness * vividness;
  const float value = between(0.2F, 0.8F);
  const auto channel = [&](float shift) {
    const float k = std::fmod(hue + shift, 6.0F);
    return value * (1.0F - saturation * std::fmax(0.0F, std::fmin(1.0F, std::fmin(k, 4.0F - k))));
  };
  return {channel(5.0F), channel(3.0F), channel(1.0F)};
}

Colour Choices::muted() {
  const float value = between(0.45F, 0.85F);
  const float warmth = between(-0.08F, 0.1F);
  return {value + warmth, value + between(-0.04F, 0.04F), value - warmth};
}

Colour Choices::timber() {
  const float light = between(0.35F, 1.0F);
  return Colour(0.78F, 0.58F, 0.37F) * light + Colour(0.06F, 0.0F, 0.0F) * between(0.0F, 1.0F);
}

void table(const RoomBuilder& place, float width, float depth, float height, const Material& top, const Material& legs,
           std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.5F * depth, height - 0.02F}, {width, depth, 0.04F}, top, seed);
  const float x = 0.5F * width - 0.06F;
  for (const float side : {-x, x}) {
    for (const float y : {-0.06F, -depth + 0.06F}) b.box({side, y, 0.5F * height - 0.02F}, {0.07F, 0.07F, height - 0.04F}, legs, seed + 1U);
  }
  b.box({0.0F, -0.06F, height - 0.09F}, {width - 0.16F, 0.025F, 0.09F}, legs, seed + 2U);
  b.box({0.0F, -depth + 0.06F, height - 0.09F}, {width - 0.16F, 0.025F, 0.09F}, legs, seed + 3U);
}

void desk(const RoomBuilder& place, float width, const Material& top, const Material& frame, std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  constexpr float kDepth = 0.75F;
  constexpr float kHeight = 0.73F;
  b.box({0.0F, -0.5F * kDepth, kHeight - 0.015F}, {width, kDepth, 0.03F}, top, seed);
  for (const float side : {-1.0F, 1.0F}) {
    b.box({side * (0.5F * width - 0.04F), -0.5F * kDepth, 0.02F}, {0.05F, kDepth - 0.1F, 0.04F}, frame, seed + 1U);
    b.box({side * (0.5F * width - 0.04F), -0.5F * kDepth, 0.36F}, {0.05F, 0.12F, 0.66F}, frame, seed + 2U);
  }
  b.box({0.0F, -0.04F, 0.45F}, {width - 0.15F, 0.02F, 0.4F}, frame, seed + 3U);
  // A pedestal with three drawers.
  const float x = 0.5F * width - 0.3F;
  b.box({x, -0.42F, 0.3F}, {0.4F, 0.55F, 0.6F}, frame, seed + 4U);
  for (int drawer = 0; drawer < 3; ++drawer) {
    const float z = 0.12F + 0.185F * static_cast<float>(drawer);
    b.box({x, -0.7F, z}, {0.37F, 0.02F, 0.165F}, top, seed + 5U);
    b.box({x, -0.72F, z + 0.04F}, {0.12F, 0.015F, 0.015F}, gloss({0.6F, 0.6F, 0.62F}));
  }
}

void office_chair(const RoomBuilder& place, const Material& cover, std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  swivel_base(b, 0.44F);
  b.box({0.0F, 0.0F, 0.48F}, {0.48F, 0.46F, 0.08F}, cover, seed);
  const RoomBuilder back = b.at(0.0F, 0.24F, 0.56F).pitched(-10.0F);
  back.box({0.0F, 0.0F, 0.26F}, {0.44F, 0.06F, 0.5F}, cover, seed + 1U);
  back.box({0.0F, 0.045F, 0.0F}, {0.08F, 0.03F, 0.3F}, plain({0.12F, 0.12F, 0.13F}));
  for (const float side : {-0.27F, 0.27F}) {
    b.box({side, 0.06F, 0.58F}, {0.03F, 0.04F, 0.2F}, plain({0.12F, 0.12F, 0.13F}));
    b.box({side, 0.0F, 0.69F}, {0.06F, 0.26F, 0.03F}, plain({0.12F, 0.12F, 0.13F}));
  }
}

void wooden_chair(const RoomBuilder& place, const Material& timber, const Material& seat, std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  for (const float x : {-0.19F, 0.19F}) {
    b.box({x, -0.18F, 0.22F}, {0.04F, 0.04F, 0.44F}, timber, seed);
    b.box({x, 0.19F, 0.45F}, {0.04F, 0.04F, 0.9F}, timber, seed + 1U);
  }
  b.box({0.0F, 0.0F, 0.45F}, {0.44F, 0.43F, 0.03F}, seat, seed + 2U);
  for (const float z : {0.58F, 0.69F, 0.83F}) b.box({0.0F, 0.19F, z}, {0.36F, 0.02F, z > 0.8F ? 0.1F : 0.05F}, timber, seed + 3U);
  b.box({0.0F, -0.18F, 0.2F}, {0.36F, 0.02F, 0.03F}, timber, seed + 4U);
}

void sofa(const RoomBuilder& place, float width, const Material& cover, const Material& cushion, std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.45F, 0.22F}, {width, 0.85F, 0.3F}, cover, seed);
  b.at(0.0F, -0.12F, 0.3F).pitched(-8.0F).box({0.0F, 0.0F, 0.28F}, {width, 0.2F, 0.56F}, cover, seed + 1U);
  for (const float side : {-1.0F, 1.0F}) {
    const float x = side * (0.5F * width - 0.1F);
    b.box({x, -0.45F, 0.4F}, {0.2F, 0.85F, 0.36F}, cover, seed + 2U);
    b.rod({x, -0.88F, 0.58F}, {x, -0.04F, 0.58F}, 0.11F, cover, seed + 3U);
    for (const float y : {-0.08F, -0.8F}) b.cylinder({side * (0.5F * width - 0.1F), y, 0.0F}, 0.03F, 0.08F, wood({0.3F, 0.18F, 0.1F}));
  }
  const int num_seats = width > 1.7F ? 3 : 2;
  const float seat = (width - 0.42F) / static_cast<float>(num_seats);
  for (int i = 0; i < num_seats; ++i) {
    const float x = (static_cast<float>(i) - 0.5F * static_cast<float>(num_seats - 1)) * seat;
    b.box({x, -0.53F, 0.42F}, {seat - 0.015F, 0.66F, 0.14F}, cover, seed + 10U + static_cast<std::uint32_t>(i));
  }
  b.at(-0.5F * width + 0.35F, -0.32F, 0.5F, 20.0F).pitched(-25.0F).box({0.0F, 0.0F, 0.2F}, {0.4F, 0.12F, 0.38F}, cushion, seed + 20U);
  b.at(0.5F * width - 0.4F, -0.35F, 0.5F, -12.0F)
      .pitched(-30.0F)
      .rolled(15.0F)
      .box({0.0F, 0.0F, 0.18F}, {0.38F, 0.12F, 0.36F}, cushion, seed + 21U);
}

void stool(const RoomBuilder& place, float height, const Material& seat, const Material& legs) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, 0.0F, height - 0.04F}, 0.17F, 0.04F, seat, 5);
  for (int leg = 0; leg < 4; ++leg) {
    const RoomBuilder at = b.at(0.0F, 0.0F, 0.0F, 45.0F + 90.0F * static_cast<float>(leg));
    at.rod({0.0F, -0.19F, 0.0F}, {0.0F, -0.11F, height - 0.03F}, 0.016F, legs);
  }
  b.rod({-0.12F, -0.12F, 0.3F * height}, {0.12F, 0.12F, 0.3F * height}, 0.01F, legs);
}

}  // namespace foothold::synthetic_detail
