// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {

Room make_textureless() {
  Room room;
  const RoomBuilder world(room);
  // A touch of tint tells surfaces apart; hardly any pattern tells places on one surface apart.
  const auto paint = [](float value, float warmth) { return plain({value + warmth, value, value - warmth}, 0.03F); };
  const Material wall = paint(0.76F, 0.01F);
  world.shell(4.2F, 3.8F, 2.6F, {paint(0.6F, 0.02F), paint(0.85F, 0.0F), wall, wall, paint(0.74F, -0.015F), wall});
  world.light({0.9F, -0.6F, 2.4F}, {1.7F, 1.68F, 1.6F});
  world.light({-1.4F, 1.0F, 2.2F}, {0.7F, 0.72F, 0.78F});
  const Material white = paint(0.8F, 0.0F);
  const Material cream = paint(0.72F, 0.03F);
  const Material grey = paint(0.62F, -0.01F);
  // Cupboards and plinths.
  world.against_north(-1.2F).piece().box({0.0F, -0.3F, 0.9F}, {1.0F, 0.6F, 1.8F}, white);
  world.against_north(-0.1F).piece().box({0.0F, -0.25F, 0.4F}, {1.1F, 0.5F, 0.8F}, cream);
  world.against_north(1.3F).piece().box({0.0F, -0.35F, 0.25F}, {0.9F, 0.7F, 0.5F}, grey);
  world.against_north(1.4F).piece().box({0.0F, -0.3F, 0.75F}, {0.5F, 0.5F, 0.5F}, white);
  world.against_east(-0.2F).piece().box({0.0F, -0.2F, 1.0F}, {0.3F, 0.4F, 2.0F}, cream);
  world.against_east(0.9F).piece().box({0.0F, -0.4F, 0.35F}, {1.0F, 0.8F, 0.7F}, white);
  world.at(1.65F, -1.0F, 0.7F).piece().cylinder({0.0F, 0.0F, 0.0F}, 0.16F, 0.35F, grey);
  world.at(1.5F, -0.65F, 0.7F).piece().sphere({0.0F, 0.0F, 0.14F}, 0.14F, cream);
  world.against_south(0.4F).piece().box({0.0F, -0.15F, 1.2F}, {1.4F, 0.3F, 0.06F}, cream);
  world.against_south(0.1F).piece().box({0.0F, -0.16F, 1.36F}, {0.25F, 0.2F, 0.26F}, grey);
  world.against_south(0.7F).piece().cylinder({0.0F, -0.16F, 1.23F}, 0.09F, 0.22F, white);
  world.against_south(-1.2F).piece().box({0.0F, -0.3F, 0.6F}, {0.8F, 0.6F, 1.2F}, white);
  world.against_south(0.6F).piece().box({0.0F, -0.35F, 0.22F}, {1.2F, 0.5F, 0.44F}, white);
  world.against_west(0.6F).piece().cylinder({0.0F, -0.35F, 0.0F}, 0.22F, 1.3F, cream);
  world.against_west(-0.5F).piece().box({0.0F, -0.3F, 0.45F}, {0.6F, 0.6F, 0.9F}, grey);
  world.against_west(-0.5F).piece().sphere({0.0F, -0.3F, 1.08F}, 0.18F, white);
  world.against_west(0.0F).piece().box({0.0F, -0.05F, 1.9F}, {1.6F, 0.1F, 0.25F}, cream);
  // A low table, a step and a ball in the middle.
  table(world.at(-0.2F, 0.3F, 0.0F, 20.0F), 1.0F, 0.6F, 0.45F, white, grey, 5);
  world.at(0.5F, 0.5F, 0.0F, -35.0F).piece().box({0.0F, 0.0F, 0.15F}, {0.5F, 0.4F, 0.3F}, cream);
  world.piece().sphere({-0.35F, 0.05F, 0.57F}, 0.12F, grey);
  for (const float x : {-1.2F, -0.1F, 1.3F}) world.against_north(x).target({0.0F, -0.3F, 0.8F});
  for (const float x : {-0.2F, 0.9F}) world.against_east(x).target({0.0F, -0.3F, 0.8F});
  for (const float x : {-1.0F, 0.4F}) world.against_south(x).target({0.0F, -0.3F, 1.0F});
  for (const float x : {-0.5F, 0.6F}) world.against_west(x).target({0.0F, -0.3F, 0.9F});
  world.target({-0.2F, 0.1F, 0.5F});
  room.eye_low_world = {-1.1F, -0.9F, 1.2F};
  room.eye_high_world = {0.9F, 0.8F, 1.65F};
  room.ambient = Colour::Constant(0.4F);
  return room;
}

}  // namespace foothold::synthetic_detail
