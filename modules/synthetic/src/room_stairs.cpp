// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

constexpr int kNumSteps = 11;
constexpr float kRise = 0.17F;
constexpr float kRun = 0.28F;
constexpr float kWidth = 2.3F;

/// The flight rises along +y from the origin. Every step has the same pattern.
void flight(const RoomBuilder& b) {
  const Material stone = speckle({0.62F, 0.61F, 0.58F}, {0.4F, 0.39F, 0.37F}, 0.5F);
  const Material nosing = plain({0.22F, 0.22F, 0.23F});
  for (int i = 0; i < kNumSteps; ++i) {
    const float height = kRise * static_cast<float>(i + 1);
    const float y = kRun * static_cast<float>(i);
    b.box({0.0F, y + 0.5F * kRun, 0.5F * height}, {kWidth, kRun, height}, stone, 10);
    b.box({0.0F, y + 0.02F, height + 0.003F}, {kWidth - 0.1F, 0.04F, 0.008F}, nosing, 12);
  }
  const float top = kRise * static_cast<float>(kNumSteps);
  const float end = kRun * static_cast<float>(kNumSteps);
  b.box({0.0F, end + 0.5F, 0.5F * top}, {kWidth, 1.0F, top}, stone, 11);
}

/// Chips and stains that years have left here and there, all that tells one step from another.
void wear(const RoomBuilder& b, Choices& choices) {
  for (int i = 0; i < 2 * kNumSteps; ++i) {
    const auto step = static_cast<float>(choices.below(kNumSteps));
    const float x = choices.between(-0.45F, 0.45F) * kWidth;
    const float size = choices.between(0.03F, 0.14F);
    const Material stain = plaster(Colour(0.5F, 0.48F, 0.44F) * choices.between(0.5F, 1.4F), 0.6F, 0.04F);
    if (choices.chance(0.5F)) {
      b.sheet({x, kRun * (step + 0.6F), kRise * (step + 1.0F) + 0.001F}, size, 0.6F * size, stain);
    } else {
      b.picture({x, kRun * step - 0.001F, kRise * (step + 0.45F)}, size, 0.6F * size, stain);
    }
  }
}

/// Bars on every step, a handrail above them.
void handrail(const RoomBuilder& b) {
  const Material steel = plain({0.32F, 0.33F, 0.35F});
  const float x = 0.5F * kWidth - 0.06F;
  for (int i = 0; i < kNumSteps; ++i) {
    const float z = kRise * static_cast<float>(i + 1);
    const float y = kRun * (static_cast<float>(i) + 0.5F);
    b.rod({x, y, z}, {x, y, z + 0.86F}, 0.012F, steel, 20);
  }
  const float end = static_cast<float>(kNumSteps) - 0.5F;
  b.rod({x, 0.5F * kRun, kRise + 0.88F}, {x, kRun * end, kRise * (end + 0.5F) + 0.88F}, 0.03F, wood({0.5F, 0.32F, 0.18F}), 21);
}

}  // namespace

Room make_stairs() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7002);
  const Material wall = plain({0.76F, 0.75F, 0.71F}, 0.05F);
  world.shell(3.2F, 6.0F, 4.4F,
              {tiles({0.55F, 0.53F, 0.5F}, {0.4F, 0.39F, 0.37F}, 0.4F, 0.15F), plain({0.8F, 0.8F, 0.8F}), wall, wall, wall, wall});
  world.light({0.6F, -1.8F, 3.6F}, {3.6F, 3.4F, 3.1F});
  world.light({-0.8F, 2.0F, 4.1F}, {2.4F, 2.4F, 2.5F});
  const RoomBuilder stairs = world.at(-0.45F, -1.08F, 0.0F);
  flight(stairs);
  wear(stairs, choices);
  handrail(stairs);
  // Beside the flight: bare floor, a door, an extinguisher and a box, all that tells one place from another.
  door(world.against_north(1.1F), plain({0.45F, 0.5F, 0.52F}), 3);
  framed_picture(world.against_west(1.6F), 0.5F, 0.7F, 3.2F, choices);
  world.against_west(-1.9F).picture({0.0F, -0.01F, 1.7F}, 0.3F, 0.3F, print({0.85F, 0.85F, 0.3F}, {0.1F, 0.1F, 0.1F}, 0.05F));
  const RoomBuilder extinguisher = world.against_east(-0.3F).at(0.0F, -0.12F, 0.6F);
  extinguisher.cylinder({0.0F, 0.0F, 0.0F}, 0.08F, 0.45F, plain({0.75F, 0.1F, 0.08F}));
  extinguisher.cylinder({0.0F, 0.0F, 0.45F}, 0.03F, 0.1F, plain({0.1F, 0.1F, 0.1F}));
  radiator(world.against_east(1.3F), 0.9F);
  box_stack(world.at(1.25F, 1.6F, 0.0F, 10.0F), 1, choices);
  for (int i = 1; i < kNumSteps; ++i) {
    const float side = i % 2 == 0 ? -0.5F : 0.5F;
    stairs.target({side, kRun * static_cast<float>(i), kRise * static_cast<float>(i)});
  }
  // From the foot of the flight to a little way up it, so that steps fill most views.
  room.eye_low_world = {-1.0F, -2.0F, 1.3F};
  room.eye_high_world = {0.5F, -0.1F, 2.0F};
  return room;
}

}  // namespace foothold::synthetic_detail
