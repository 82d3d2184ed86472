// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

/// Folds that hang from a rail, as upright cylinders side by side.
void curtain(const RoomBuilder& b, float width, const Material& cloth) {
  const int num_folds = static_cast<int>(width / 0.085F);
  for (int i = 0; i < num_folds; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * width / static_cast<float>(num_folds) - 0.5F * width;
    b.cylinder({x, -0.1F - 0.02F * static_cast<float>(i % 2), 0.05F}, 0.05F, 2.2F, cloth, 30);
  }
  b.rod({-0.5F * width - 0.1F, -0.1F, 2.28F}, {0.5F * width + 0.1F, -0.1F, 2.28F}, 0.015F, wood({0.4F, 0.28F, 0.18F}));
}

void television(const RoomBuilder& place, const Material& timber, Choices& choices) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.22F, 0.25F}, {1.6F, 0.42F, 0.42F}, timber, 40);
  for (const float x : {-0.53F, 0.0F, 0.53F}) b.box({x, -0.435F, 0.25F}, {0.5F, 0.015F, 0.36F}, plain({0.8F, 0.79F, 0.75F}));
  b.box({0.0F, -0.2F, 0.9F}, {1.1F, 0.05F, 0.64F}, gloss({0.08F, 0.08F, 0.09F}, 0.6F));
  b.box({0.0F, -0.2F, 0.52F}, {0.3F, 0.2F, 0.12F}, plain({0.1F, 0.1F, 0.1F}));
  clutter(b.at(-0.62F, -0.2F, 0.46F), 0.3F, 0.1F, 1, choices);
  clutter(b.at(0.65F, -0.2F, 0.46F), 0.25F, 0.1F, 1, choices);
  b.target({0.0F, -0.2F, 0.9F});
}

/// A lamp of paper balls on strings.
void hanging_balls(const RoomBuilder& b, float ceiling_z) {
  const float drop[3] = {0.45F, 0.7F, 0.55F};
  for (int i = 0; i < 3; ++i) {
    const float x = 0.28F * static_cast<float>(i - 1);
    b.rod({x, 0.0F, ceiling_z - drop[i]}, {x, 0.0F, ceiling_z}, 0.006F, plain({0.1F, 0.1F, 0.1F}));
    b.sphere({x, 0.0F, ceiling_z - drop[i]}, 0.13F, stripes({0.9F, 0.86F, 0.75F}, {0.75F, 0.65F, 0.45F}, 0.03F));
  }
}

}  // namespace

Room make_lounge() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7006);
  const Material wall = plaster({0.78F, 0.74F, 0.66F}, 0.3F);
  world.shell(5.0F, 4.4F, 2.6F,
              {wood({0.6F, 0.42F, 0.26F}, 0.14F, 0.5F), plain({0.86F, 0.85F, 0.83F}), wall, wall,
               stripes({0.4F, 0.5F, 0.5F}, {0.5F, 0.6F, 0.58F}, 0.15F, 0.3F), wall});
  world.light({-1.2F, 0.8F, 2.4F}, {1.5F, 1.35F, 1.1F});
  world.light({1.5F, -0.8F, 2.4F}, {1.5F, 1.4F, 1.2F});
  world.light({0.0F, -2.0F, 1.6F}, {0.6F, 0.7F, 0.8F});
  const Material teal = fabric({0.2F, 0.42F, 0.45F}, 0.6F);
  const Material mustard = stripes({0.78F, 0.58F, 0.18F}, {0.6F, 0.3F, 0.15F}, 0.05F);
  sofa(world.against_north(-0.4F), 2.1F, teal, mustard, 10);
  sofa(world.against_west(-0.3F), 1.5F, fabric({0.55F, 0.3F, 0.22F}, 0.6F), checker({0.85F, 0.82F, 0.75F}, {0.25F, 0.3F, 0.4F}, 0.06F), 20);
  sofa(world.at(1.15F, -0.2F, 0.0F, -75.0F), 0.95F, fabric({0.6F, 0.58F, 0.5F}, 0.7F), teal, 25);
  world.against_north(-0.4F).target({0.0F, -0.4F, 0.7F});
  world.against_west(-0.3F).target({0.0F, -0.4F, 0.7F});
  world.target({1.3F, -0.3F, 0.6F});
  for (const float x : {-1.2F, -0.5F, 0.25F}) framed_picture(world.against_north(x), 0.5F, 0.65F, 1.65F, choices);
  plant(world.at(1.1F, 1.75F, 0.0F), 1.5F, {0.8F, 0.78F, 0.72F}, choices);
  plant(world.at(-2.1F, 1.8F, 0.0F), 1.2F, {0.25F, 0.35F, 0.5F}, choices);
  world.target({1.1F, 1.7F, 1.1F});
  floor_lamp(world.at(1.85F, 1.95F, 0.0F), {0.85F, 0.75F, 0.5F});
  television(world.against_east(0.2F), wood({0.5F, 0.35F, 0.22F}, 0.42F), choices);
  framed_picture(world.against_east(-0.8F), 0.6F, 0.8F, 1.6F, choices);
  wall_shelf(world.against_east(0.5F), 1.2F, 1.65F, wood({0.5F, 0.35F, 0.22F}), 4, choices);
  window(world.against_south(0.2F), 1.5F, 1.2F, 0.9F, 6);
  curtain(world.against_south(-0.95F), 0.6F, fabric({0.62F, 0.3F, 0.3F}, 0.5F));
  curtain(world.against_south(1.35F), 0.6F, fabric({0.62F, 0.3F, 0.3F}, 0.5F));
  radiator(world.against_south(0.2F), 1.2F);
  world.against_south(0.2F).target({-0.8F, 0.0F, 1.2F});
  world.against_south(0.2F).target({0.9F, 0.0F, 1.1F});
  bookcase(world.against_west(1.3F), 0.8F, 1.2F, 3, 0.6F, wood({0.5F, 0.35F, 0.22F}), choices);
  framed_picture(world.against_west(-0.4F), 0.9F, 0.6F, 1.6F, choices);
  const RoomBuilder middle = world.at(-0.3F, 0.15F, 0.0F, 8.0F);
  middle.sheet({0.0F, 0.0F, 0.004F}, 2.1F, 1.5F, checker({0.7F, 0.62F, 0.5F}, {0.45F, 0.25F, 0.22F}, 0.25F));
  table(middle.at(0.0F, 0.3F, 0.0F), 1.0F, 0.6F, 0.42F, wood({0.55F, 0.38F, 0.22F}), wood({0.4F, 0.28F, 0.18F}), 50);
  clutter(middle.at(0.0F, 0.0F, 0.42F), 0.85F, 0.25F, 5, choices);
  for (const float x : {-0.3F, 0.3F}) middle.target({x, 0.0F, 0.45F});
  hanging_balls(world.at(0.9F, 1.2F, 0.0F), 2.6F);
  stool(world.at(-1.0F, -1.4F, 0.0F), 0.45F, mustard, wood({0.5F, 0.35F, 0.22F}));
  room.eye_low_world = {-1.2F, -1.2F, 1.15F};
  room.eye_high_world = {1.0F, 0.7F, 1.65F};
  return room;
}

}  // namespace foothold::synthetic_detail
