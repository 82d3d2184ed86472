// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {

Room make_bookshelf() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7005);
  const Material wall = plaster({0.74F, 0.7F, 0.6F}, 0.25F);
  world.shell(4.8F, 4.2F, 2.7F,
              {carpet({0.42F, 0.2F, 0.18F}, {0.25F, 0.12F, 0.12F}, 0.7F), plain({0.85F, 0.83F, 0.78F}), wall, wall, wall, wall});
  world.light({-1.0F, 0.0F, 2.6F}, {1.8F, 1.65F, 1.4F});
  world.light({1.1F, 0.2F, 2.6F}, {1.8F, 1.65F, 1.4F});
  const Material walnut = wood({0.42F, 0.27F, 0.17F}, 0.3F);
  // Cases of one make along three walls.
  for (const float x : {-1.5F, -0.5F, 0.5F, 1.5F}) bookcase(world.against_north(x), 0.98F, 2.2F, 6, 0.95F, walnut, choices);
  for (const float x : {-0.5F, 0.5F}) bookcase(world.against_east(x), 0.98F, 2.2F, 6, 0.9F, walnut, choices);
  for (const float x : {-0.1F, 0.9F}) bookcase(world.against_west(x), 0.98F, 2.2F, 6, 0.9F, walnut, choices);
  for (const float x : {-1.4F, 0.0F, 1.4F}) world.against_north(x).target({0.0F, -0.3F, 1.2F});
  for (const float x : {-0.5F, 0.5F}) world.against_east(x).target({0.0F, -0.3F, 1.1F});
  for (const float x : {-0.1F, 0.9F}) world.against_west(x).target({0.0F, -0.3F, 1.1F});
  // A reading table under the pictures of the fourth wall, and a low trolley.
  const RoomBuilder reading = world.against_south(0.2F);
  table(reading.at(0.0F, -0.1F, 0.0F), 1.6F, 0.8F, 0.75F, walnut, walnut, 50);
  books_lying(reading.at(-0.55F, -0.4F, 0.75F), 5, choices);
  books_lying(reading.at(-0.1F, -0.6F, 0.75F), 1, choices);
  books_lying(reading.at(0.2F, -0.35F, 0.75F), 3, choices);
  desk_lamp(reading.at(0.6F, -0.35F, 0.75F), {0.1F, 0.35F, 0.2F});
  wooden_chair(reading.at(-0.3F, -1.0F, 0.0F, 190.0F), walnut, fabric({0.45F, 0.12F, 0.12F}), 60);
  wooden_chair(reading.at(0.4F, -1.05F, 0.0F, 160.0F), walnut, fabric({0.45F, 0.12F, 0.12F}), 60);
  framed_picture(reading.at(-0.5F, 0.0F, 0.0F), 0.5F, 0.65F, 1.65F, choices);
  framed_picture(reading.at(0.35F, 0.0F, 0.0F), 0.7F, 0.5F, 1.7F, choices);
  reading.target({-0.2F, -0.4F, 0.8F});
  reading.target({0.2F, 0.0F, 1.4F});
  door(world.against_south(-1.7F), walnut, 70);
  floor_lamp(world.against_south(1.75F), {0.8F, 0.7F, 0.45F});
  bookcase(world.at(0.35F, 0.35F, 0.0F, 100.0F), 0.8F, 0.85F, 2, 0.8F, walnut, choices);
  clutter(world.at(0.35F, 0.35F, 0.86F, 100.0F).at(0.0F, -0.15F, 0.0F), 0.7F, 0.1F, 3, choices);
  world.target({0.4F, 0.35F, 0.7F});
  stool(world.at(-0.7F, 0.9F, 0.0F), 0.45F, walnut, walnut);
  plant(world.at(2.0F, 1.1F, 0.0F), 1.1F, {0.3F, 0.3F, 0.32F}, choices);
  room.eye_low_world = {-1.2F, -0.6F, 1.25F};
  room.eye_high_world = {1.2F, 0.8F, 1.7F};
  return room;
}

}  // namespace foothold::synthetic_detail
