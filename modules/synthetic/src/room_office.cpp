// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

constexpr float kDeskZ = 0.73F;

/// What every desk of the office has; only the things lying about differ.
void desk_with_chair(const RoomBuilder& b, Choices& choices) {
  desk(b, 1.5F, wood({0.72F, 0.6F, 0.45F}, 0.4F, 0.3F), plain({0.55F, 0.56F, 0.58F}), 40);
  monitor(b.at(-0.2F, -0.22F, kDeskZ, 6.0F), 0.52F, 50);
  keyboard(b.at(-0.2F, -0.52F, kDeskZ));
  office_chair(b.at(-0.15F, -1.05F, 0.0F, choices.between(-30.0F, 30.0F)), fabric({0.16F, 0.2F, 0.32F}), 60);
  const Colour colour = choices.colour();
  mug(b.at(0.18F, choices.between(-0.5F, -0.3F), kDeskZ), colour);
  clutter(b.at(0.46F, -0.35F, kDeskZ), 0.5F, 0.35F, 2, choices);
  b.piece().at(0.1F, -0.6F, kDeskZ, choices.between(-20.0F, 20.0F)).sheet({0.0F, 0.0F, 0.002F}, 0.21F, 0.297F, paper());
  b.target({0.0F, -0.35F, kDeskZ + 0.1F});
}

}  // namespace

Room make_office() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7001);
  const Material wall = plaster({0.8F, 0.79F, 0.74F});
  world.shell(5.4F, 4.6F, 2.7F,
              {stripes({0.34F, 0.36F, 0.42F}, {0.22F, 0.24F, 0.3F}, 0.05F), tiles({0.85F, 0.85F, 0.84F}, {0.6F, 0.6F, 0.6F}, 0.6F, 0.1F),
               wall, wall, plaster({0.62F, 0.68F, 0.72F}), wall});
  world.light({-1.4F, 0.6F, 2.6F}, {1.7F, 1.65F, 1.5F});
  world.light({1.5F, -0.6F, 2.6F}, {1.6F, 1.65F, 1.7F});
  world.light({0.2F, 2.0F, 1.8F}, {0.5F, 0.6F, 0.75F});
  for (const float x : {-1.65F, 0.0F, 1.65F}) desk_with_chair(world.against_north(x), choices);
  for (const float x : {-1.65F, 0.0F, 1.65F}) desk_with_chair(world.against_south(x), choices);
  for (const float x : {-1.5F, 0.3F}) framed_picture(world.against_north(x), 0.6F, 0.45F, 1.75F, choices);
  window(world.against_north(1.75F), 1.3F, 1.0F, 1.25F, 4);
  whiteboard(world.against_south(0.6F), 1.8F, 1.65F, 9);
  framed_picture(world.against_south(-1.7F), 0.5F, 0.7F, 1.7F, choices);
  bookcase(world.against_east(-0.2F), 0.9F, 1.9F, 5, 0.7F, wood({0.7F, 0.55F, 0.38F}, 0.3F), choices);
  bookcase(world.against_east(0.75F), 0.9F, 1.9F, 5, 0.85F, wood({0.7F, 0.55F, 0.38F}, 0.3F), choices);
  world.against_east(0.3F).target({0.0F, -0.3F, 1.1F});
  door(world.against_west(-0.7F), wood({0.62F, 0.42F, 0.25F}, 0.9F, 0.4F), 3);
  plant(world.against_west(0.9F).at(0.0F, -0.35F, 0.0F), 1.2F, {0.7F, 0.35F, 0.25F}, choices);
  world.against_west(0.6F).target({0.0F, -0.2F, 0.9F});
  bin(world.at(-0.8F, 1.7F, 0.0F), {0.25F, 0.28F, 0.3F});
  box_stack(world.at(2.2F, -0.95F, 0.0F, 80.0F), 3, choices);
  room.eye_low_world = {-1.3F, -0.55F, 1.25F};
  room.eye_high_world = {1.2F, 0.55F, 1.75F};
  return room;
}

}  // namespace foothold::synthetic_detail
