// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/view_effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "foothold/synthetic/renderer.h"
#include "foothold/synthetic/sensor_model.h"
#include "furniture.h"
#include "pattern.h"

namespace foothold {
namespace {

using namespace synthetic_detail;
using Eigen::Vector3f;

/// Size of the patches in which depth is missing [px at that width].
constexpr float kHole_px = 40.0F;
/// A person from head to knee seen from the front [m^2], and how near one comes [m].
constexpr float kSilhouette_m2 = 0.75F;
constexpr float kNearestPerson_m = 0.7F;
constexpr float kFarthestPerson_m = 3.5F;

/// A person in a frame whose z points up, who stands at the origin.
void stand_person(const RoomBuilder& b, Choices& choices) {
  const Colour skin = Colour(0.85F, 0.65F, 0.52F) * choices.between(0.4F, 1.0F);
  const bool is_striped = choices.chance(0.5F);
  const Colour colour = choices.colour();
  const Material shirt = is_striped ? stripes(choices.colour(), colour, 0.05F) : fabric(colour);
  const Material trousers = fabric(choices.colour() * 0.7F);
  b.sphere({0.0F, 0.0F, 1.62F}, 0.11F, plain(skin), 1);
  b.cylinder({0.0F, 0.0F, 1.42F}, 0.06F, 0.12F, plain(skin), 2);
  b.box({0.0F, 0.0F, 1.15F}, {0.42F, 0.22F, 0.56F}, shirt, 3);
  const float raise = choices.between(-0.1F, 0.35F);
  for (const float side : {-1.0F, 1.0F}) {
    b.rod({0.22F * side, 0.0F, 1.38F}, {0.32F * side, -0.06F, 1.02F}, 0.055F, shirt, 4);
    b.rod({0.32F * side, -0.06F, 1.02F}, {0.28F * side, -0.25F, 0.86F + raise}, 0.045F, plain(skin), 5);
    b.rod({0.1F * side, 0.0F, 0.88F}, {0.12F * side, 0.0F, 0.06F}, 0.085F, trousers, 6);
  }
}

/// Somebody who sways before the camera, upright in its image.
Room person_room(float distance_m, float sideways_m, std::uint64_t seed) {
  Room room;
  const RoomBuilder world(room);
  // Camera x right, y down, z forward; the person's x right, y away, z up, with the chest at the height of the camera.
  Choices choices(seed);
  stand_person(world, choices);
  SE3 camera_from_person;
  camera_from_person.rotation << 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, -1.0F, 0.0F, 1.0F, 0.0F;
  camera_from_person.translation = {sideways_m, 1.15F, distance_m};
  for (Primitive& primitive : room.primitives) primitive.world_from_local = camera_from_person * primitive.world_from_local;
  room.lights.push_back({{-1.0F, -1.5F, distance_m - 0.6F}, Vector3f::Constant(1.2F)});
  return room;
}

void add_person(float share, std::uint64_t seed, RgbdFrame& frame) {
  const Intrinsics& camera = frame.calibration.depth;
  const int width = frame.depth.width();
  const int height = frame.depth.height();
  const auto area_px = static_cast<float>(width) * static_cast<float>(height);
  const float distance_m = std::clamp(camera.fx * std::sqrt(kSilhouette_m2 / (share * area_px)), kNearestPerson_m, kFarthestPerson_m);
  Random random(seed, 0x706572);
  const float phase = random.uniform(0.0F, 6.2831853F) + 0.05F * static_cast<float>(frame.index % 100000);
  const float reach_m = 0.25F * distance_m * static_cast<float>(width) / camera.fx;
  const Room room = person_room(distance_m, reach_m * std::sin(phase), derive_seed(seed, 1));
  const RenderedView view =
      measure(sensor_model(1), room, render(room, camera, SE3{}, width, height), seed, static_cast<int>(frame.index % 100000));
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    float& z = frame.depth.data()[i];
    if (view.primitive.data()[i] < 0 || (is_valid_depth(z) && z < distance_m - 0.4F)) continue;
    z = view.depth.data()[i];
    frame.colour.data()[i] = view.colour.data()[i];
  }
}

void blur(float length_px, float angle, Image<Rgb8>& colour) {
  const Image<Rgb8> sharp = colour;
  const int num_taps = std::max(2, static_cast<int>(length_px) + 1);
  for (int v = 0; v < colour.height(); ++v) {
    for (int u = 0; u < colour.width(); ++u) {
      std::array<float, 3> sum{};
      for (int tap = 0; tap < num_taps; ++tap) {
        const float along = length_px * (static_cast<float>(tap) / static_cast<float>(num_taps - 1) - 0.5F);
        const int su = std::clamp(static_cast<int>(std::lround(static_cast<float>(u) + along * std::cos(angle))), 0, colour.width() - 1);
        const int sv = std::clamp(static_cast<int>(std::lround(static_cast<float>(v) + along * std::sin(angle))), 0, colour.height() - 1);
        const Rgb8 pixel = sharp(su, sv);
        sum[0] += static_cast<float>(pixel.r);
        sum[1] += static_cast<float>(pixel.g);
        sum[2] += static_cast<float>(pixel.b);
      }
      const float factor = 1.0F / static_cast<float>(num_taps);
      colour(u, v) = {static_cast<std::uint8_t>(sum[0] * factor + 0.5F), static_cast<std::uint8_t>(sum[1] * factor + 0.5F),
                      static_cast<std::uint8_t>(sum[2] * factor + 0.5F)};
    }
  }
}

void relight(const ViewEffects& effects, Image<Rgb8>& colour) {
  const float gains[3] = {effects.exposure * (1.0F + effects.warmth), effects.exposure, effects.exposure * (1.0F - effects.warmth)};
  std::array<std::array<std::uint8_t, 256>, 3> tables{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < 256; ++i) {
      const float linear = saturate(std::max(gains[c], 0.0F) * static_cast<float>(i) / 255.0F);
      tables[c][i] = static_cast<std::uint8_t>(255.0F * std::pow(linear, effects.gamma) + 0.5F);
    }
  }
  for (std::size_t i = 0; i < colour.size(); ++i) {
    Rgb8& pixel = colour.data()[i];
    pixel = {tables[0][pixel.r], tables[1][pixel.g], tables[2][pixel.b]};
  }
}

/// Takes the depth of the pixels where smooth noise is highest.
void pierce(float share, std::uint64_t seed, Image<float>& depth) {
  const float patch_px = kHole_px * static_cast<float>(depth.width()) / kReferenceWidth;
  std::vector<float> noise(depth.size());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const auto i = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width()) + static_cast<std::size_t>(u);
      noise[i] = value_noise(static_cast<float>(u) / patch_px, static_cast<float>(v) / patch_px, static_cast<std::uint32_t>(seed));
    }
  }
  std::vector<float> sorted = noise;
  const auto rank = std::min(sorted.size() - 1, static_cast<std::size_t>((1.0F - share) * static_cast<float>(sorted.size())));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
  for (std::size_t i = 0; i < noise.size(); ++i) {
    if (noise[i] >= sorted[rank]) depth.data()[i] = 0.0F;
  }
}

}  // namespace

void apply_effects(const ViewEffects& effects, std::uint64_t seed, RgbdFrame& frame) {
  validate_settings(effects);
  const std::uint64_t frame_seed = derive_seed(seed, static_cast<std::uint64_t>(frame.index));
  if (effects.person > 0.0F) add_person(effects.person, seed, frame);
  if (effects.blur_px > 0.0F) {
    const float length_px = effects.blur_px * static_cast<float>(frame.colour.width()) / kReferenceWidth;
    blur(length_px, Random(frame_seed, 1).uniform(0.0F, 3.1415927F), frame.colour);
  }
  if (effects.exposure != 1.0F || effects.gamma != 1.0F || effects.warmth != 0.0F) relight(effects, frame.colour);
  if (effects.holes > 0.0F) pierce(effects.holes, derive_seed(frame_seed, 2), frame.depth);
}

}  // namespace foothold
