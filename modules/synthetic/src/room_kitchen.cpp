// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

constexpr float kWorktopZ = 0.9F;

/// The long row: cabinets, sink, cooker and what stands about.
void long_row(const RoomBuilder& wall, const Material& front, const Material& worktop, Choices& choices) {
  cabinets(wall.at(-0.75F, 0.0F, 0.0F), 4, 0.6F, kWorktopZ, front, worktop, 100);
  sink(wall.at(-1.0F, 0.0F, 0.0F), kWorktopZ);
  oven(wall.at(0.75F, 0.0F, 0.0F), {0.75F, 0.76F, 0.78F});
  cabinets(wall.at(1.36F, 0.0F, 0.0F), 1, 0.6F, kWorktopZ, front, worktop, 120);
  wall_cabinets(wall.at(-1.05F, 0.0F, 0.0F), 3, 0.6F, 1.5F, front, 130);
  wall_cabinets(wall.at(1.36F, 0.0F, 0.0F), 1, 0.6F, 1.5F, front, 140);
  // A hood above the cooker.
  wall.box({0.75F, -0.22F, 1.68F}, {0.6F, 0.44F, 0.12F}, gloss({0.6F, 0.61F, 0.63F}));
  wall.box({0.75F, -0.13F, 2.05F}, {0.26F, 0.26F, 0.62F}, gloss({0.6F, 0.61F, 0.63F}));
  wall.picture({0.0F, -0.004F, 1.2F}, 3.4F, 0.6F, tiles({0.58F, 0.68F, 0.68F}, {0.82F, 0.82F, 0.8F}, 0.1F, 0.45F), 150);
  clutter(wall.at(0.05F, -0.22F, kWorktopZ), 0.75F, 0.15F, 4, choices);
  clutter(wall.at(-1.75F, -0.22F, kWorktopZ), 0.4F, 0.15F, 2, choices);
  clutter(wall.at(1.36F, -0.3F, kWorktopZ), 0.5F, 0.2F, 2, choices);
  for (const float x : {-1.4F, -0.4F, 0.75F, 1.4F}) wall.target({x, -0.3F, 1.0F});
  wall.target({0.2F, -0.2F, 1.5F});
}

void short_row(const RoomBuilder& wall, const Material& front, const Material& worktop, Choices& choices) {
  cabinets(wall.at(-0.3F, 0.0F, 0.0F), 3, 0.55F, kWorktopZ, front, worktop, 160);
  wall.picture({-0.3F, -0.004F, 1.15F}, 1.7F, 0.5F, tiles({0.58F, 0.68F, 0.68F}, {0.82F, 0.82F, 0.8F}, 0.1F, 0.45F), 150);
  microwave(wall.at(-0.75F, -0.25F, kWorktopZ, 4.0F), {0.82F, 0.82F, 0.8F});
  wall_shelf(wall.at(-0.3F, 0.0F, 0.0F), 1.6F, 1.5F, wood({0.45F, 0.2F, 0.14F}), 6, choices);
  clutter(wall.at(0.0F, -0.25F, kWorktopZ), 0.8F, 0.2F, 4, choices);
  fridge(wall.at(0.95F, 0.0F, 0.0F), 1.75F, {0.84F, 0.85F, 0.86F}, choices);
  wall.target({-0.4F, -0.3F, 1.0F});
  wall.target({0.9F, -0.5F, 1.2F});
}

}  // namespace

Room make_kitchen() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7003);
  const Material wall = plaster({0.8F, 0.8F, 0.76F});
  world.shell(4.4F, 3.8F, 2.6F,
              {stripes({0.4F, 0.4F, 0.42F}, {0.2F, 0.2F, 0.22F}, 0.025F), plain({0.85F, 0.85F, 0.85F}), wall, wall, wall,
               plaster({0.72F, 0.76F, 0.7F})});
  world.light({-1.0F, 0.3F, 2.5F}, {1.5F, 1.45F, 1.35F});
  world.light({1.1F, -0.3F, 2.5F}, {1.5F, 1.45F, 1.4F});
  world.light({0.0F, 1.4F, 1.45F}, {0.3F, 0.28F, 0.24F});
  const Material front = plain({0.58F, 0.1F, 0.09F}, 0.2F);
  const Material worktop = speckle({0.2F, 0.2F, 0.21F}, {0.55F, 0.53F, 0.5F}, 0.6F);
  long_row(world.against_north(-0.3F), front, worktop, choices);
  short_row(world.against_east(0.4F), front, worktop, choices);
  const Material oak = wood({0.66F, 0.46F, 0.26F}, 0.14F);
  const RoomBuilder middle = world.at(-0.35F, -0.35F, 0.0F, 12.0F);
  table(middle.at(0.0F, 0.4F, 0.0F), 1.3F, 0.8F, 0.74F, oak, oak, 170);
  clutter(middle.at(0.0F, 0.0F, 0.74F), 1.1F, 0.4F, 6, choices);
  const Material seat = fabric({0.3F, 0.2F, 0.15F});
  wooden_chair(middle.at(-0.3F, 0.55F, 0.0F, 5.0F), oak, seat, 180);
  wooden_chair(middle.at(0.35F, 0.5F, 0.0F, -12.0F), oak, seat, 180);
  wooden_chair(middle.at(-0.3F, -0.55F, 0.0F, 170.0F), oak, seat, 180);
  wooden_chair(middle.at(0.9F, -0.05F, 0.0F, -80.0F), oak, seat, 180);
  for (const float x : {-0.4F, 0.0F, 0.4F}) middle.target({x, 0.0F, 0.75F});
  window(world.against_west(0.2F), 1.2F, 1.0F, 1.0F, 5);
  radiator(world.against_west(0.2F), 1.1F);
  world.against_west(0.2F).target({0.0F, 0.0F, 1.1F});
  bin(world.at(-1.9F, -0.95F, 0.0F), {0.7F, 0.72F, 0.74F});
  door(world.against_south(1.2F), plain({0.5F, 0.62F, 0.6F}), 8);
  bookcase(world.against_south(-0.4F), 0.8F, 1.5F, 4, 0.4F, oak, choices);
  framed_picture(world.against_south(0.4F), 0.5F, 0.6F, 1.6F, choices);
  world.against_south(-0.1F).target({0.0F, 0.0F, 1.1F});
  room.eye_low_world = {-1.35F, -1.1F, 1.25F};
  room.eye_high_world = {1.0F, 0.7F, 1.7F};
  return room;
}

}  // namespace foothold::synthetic_detail
