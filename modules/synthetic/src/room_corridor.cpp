// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

constexpr float kDoorPitch_m = 1.17F;
constexpr int kDoorsPerSide = 5;
constexpr float kHeight_m = 2.6F;

/// A door with its lamp, its skirting and its light switch, all of one make.
void doorway(const RoomBuilder& b) {
  door(b, wood({0.6F, 0.45F, 0.3F}, 0.6F, 0.35F), 3);
  b.box({0.54F, -0.008F, 1.1F}, {0.08F, 0.016F, 0.08F}, plain({0.88F, 0.88F, 0.86F}), 20);
  b.box({0.0F, -0.04F, 2.3F}, {0.3F, 0.08F, 0.08F}, plain({0.9F, 0.88F, 0.8F}), 21);
}

/// What hangs or stands at one place only.
void landmarks(const RoomBuilder& world, Choices& choices) {
  framed_picture(world.against_east(0.4F), 0.6F, 0.8F, 1.6F, choices);
  plant(world.at(2.7F, -1.1F, 0.0F), 1.1F, {0.6F, 0.6F, 0.58F}, choices);
  whiteboard(world.against_west(0.3F), 1.2F, 1.6F, 9);
  bin(world.at(-2.75F, 1.25F, 0.0F), {0.3F, 0.32F, 0.34F});
  const RoomBuilder extinguisher = world.against_north(0.58F).at(0.0F, -0.12F, 0.5F).piece();
  extinguisher.cylinder({0.0F, 0.0F, 0.0F}, 0.07F, 0.42F, plain({0.75F, 0.1F, 0.08F}));
  extinguisher.cylinder({0.0F, 0.0F, 0.42F}, 0.03F, 0.1F, plain({0.1F, 0.1F, 0.1F}));
}

}  // namespace

Room make_corridor() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7007);
  const Material wall = plain({0.8F, 0.79F, 0.74F}, 0.05F);
  world.shell(6.0F, 3.0F, kHeight_m,
              {tiles({0.5F, 0.5F, 0.52F}, {0.4F, 0.4F, 0.42F}, 0.3F, 0.1F), plain({0.86F, 0.86F, 0.86F}), wall, wall, wall, wall});
  for (int i = 0; i < kDoorsPerSide; ++i) {
    const float x = kDoorPitch_m * static_cast<float>(i - kDoorsPerSide / 2);
    doorway(world.against_north(x));
    doorway(world.against_south(x));
    world.against_north(x).target({0.0F, 0.0F, 1.1F});
    world.against_south(x).target({0.0F, 0.0F, 1.1F});
    world.light({x, 0.0F, kHeight_m - 0.1F}, {0.8F, 0.78F, 0.7F});
  }
  landmarks(world, choices);
  room.eye_low_world = {-1.4F, -0.45F, 1.25F};
  room.eye_high_world = {1.4F, 0.45F, 1.65F};
  return room;
}

}  // namespace foothold::synthetic_detail
