// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

const Colour kIron(0.3F, 0.31F, 0.33F);

/// Screwdrivers, hammers and saws on hooks.
void tool_wall(const RoomBuilder& b, float width, Choices& choices) {
  b.box({0.0F, -0.01F, 1.5F}, {width, 0.02F, 0.8F}, tiles({0.55F, 0.47F, 0.35F}, {0.3F, 0.25F, 0.2F}, 0.05F, 0.2F));
  const int num_tools = static_cast<int>(width / 0.16F);
  for (int i = 0; i < num_tools; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * width / static_cast<float>(num_tools) - 0.5F * width;
    const float z = choices.between(1.3F, 1.65F);
    const Colour grip = choices.colour();
    switch (choices.below(4)) {
      case 0:
        b.rod({x, -0.05F, z}, {x, -0.05F, z + 0.13F}, 0.016F, plain(grip));
        b.rod({x, -0.05F, z - 0.14F}, {x, -0.05F, z}, 0.005F, gloss(kIron));
        break;
      case 1:
        b.rod({x, -0.05F, z - 0.2F}, {x, -0.05F, z + 0.12F}, 0.014F, wood({0.7F, 0.5F, 0.3F}));
        b.box({x, -0.05F, z + 0.14F}, {0.12F, 0.035F, 0.04F}, plain(kIron));
        break;
      case 2:
        b.at(x, 0.0F, z).rolled(8.0F).box({0.0F, -0.03F, -0.05F}, {0.09F, 0.004F, 0.4F}, gloss({0.6F, 0.6F, 0.62F}, 0.85F));
        b.box({x, -0.035F, z + 0.19F}, {0.1F, 0.03F, 0.1F}, plain(grip));
        break;
      default:
        b.box({x, -0.035F, z}, {0.05F, 0.02F, 0.28F}, plain(grip));
        b.cylinder({x, -0.035F, z + 0.13F}, 0.035F, 0.03F, plain(kIron));
        break;
    }
  }
}

void workbench(const RoomBuilder& b, float width, Choices& choices) {
  const Material beech = wood({0.68F, 0.5F, 0.3F}, 0.09F, 0.8F);
  table(b, width, 0.7F, 0.88F, beech, wood({0.45F, 0.33F, 0.2F}), choices.seed());
  b.box({0.0F, -0.35F, 0.25F}, {width - 0.2F, 0.55F, 0.03F}, beech);
  box_stack(b.at(-0.25F * width, -0.35F, 0.27F), 1, choices);
  box_stack(b.at(0.22F * width, -0.35F, 0.27F), 1, choices);
  // A vice.
  const RoomBuilder vice = b.piece().at(-0.4F * width, -0.62F, 0.88F, 10.0F);
  vice.box({0.0F, 0.0F, 0.07F}, {0.12F, 0.16F, 0.14F}, plain({0.15F, 0.3F, 0.5F}, 0.4F));
  vice.box({0.0F, -0.14F, 0.1F}, {0.14F, 0.04F, 0.1F}, plain({0.15F, 0.3F, 0.5F}, 0.4F));
  vice.rod({0.0F, -0.26F, 0.07F}, {0.0F, 0.0F, 0.07F}, 0.015F, gloss(kIron));
  clutter(b.at(0.1F * width, -0.3F, 0.88F), 0.7F * width, 0.3F, 5, choices);
  b.target({-0.2F * width, -0.35F, 0.95F});
  b.target({0.25F * width, -0.35F, 1.0F});
}

void ladder(const RoomBuilder& place) {
  const RoomBuilder b = place.piece();
  const Material alloy = gloss({0.68F, 0.69F, 0.7F}, 0.9F);
  const RoomBuilder lean = b.at(0.0F, -0.45F, 0.0F).pitched(-12.0F);
  for (const float x : {-0.2F, 0.2F}) lean.box({x, 0.0F, 1.05F}, {0.03F, 0.06F, 2.1F}, alloy);
  for (int i = 0; i < 7; ++i)
    lean.rod({-0.2F, 0.0F, 0.25F + 0.28F * static_cast<float>(i)}, {0.2F, 0.0F, 0.25F + 0.28F * static_cast<float>(i)}, 0.015F, alloy);
}

/// A pillar drill.
void drill(const RoomBuilder& place) {
  const RoomBuilder b = place.piece();
  const Material green = plain({0.18F, 0.4F, 0.28F}, 0.4F);
  b.box({0.0F, -0.3F, 0.05F}, {0.4F, 0.5F, 0.1F}, green);
  b.cylinder({0.0F, -0.15F, 0.1F}, 0.05F, 1.5F, gloss({0.6F, 0.6F, 0.62F}, 0.9F));
  b.box({0.0F, -0.36F, 0.85F}, {0.32F, 0.32F, 0.04F}, plain(kIron, 0.5F));
  b.box({0.0F, -0.28F, 1.5F}, {0.26F, 0.55F, 0.3F}, green);
  b.cylinder({0.0F, -0.42F, 1.15F}, 0.04F, 0.22F, gloss(kIron));
  b.cylinder({0.0F, -0.42F, 1.0F}, 0.008F, 0.16F, gloss({0.7F, 0.7F, 0.7F}));
  for (int i = 0; i < 3; ++i)
    b.at(0.14F, -0.34F, 1.42F)
        .pitched(120.0F * static_cast<float>(i))
        .rod({0.0F, 0.0F, 0.0F}, {0.02F, 0.0F, 0.22F}, 0.01F, plain({0.7F, 0.1F, 0.1F}));
  b.target({0.0F, -0.3F, 1.2F});
}

void barrel(const RoomBuilder& place, const Colour& colour) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.28F, 0.88F, plaster(colour, 0.7F, 0.3F));
  for (const float z : {0.02F, 0.3F, 0.58F, 0.84F}) b.cylinder({0.0F, 0.0F, z}, 0.292F, 0.025F, plain(0.6F * colour));
  b.picture({0.0F, -0.2805F, 0.45F}, 0.18F, 0.2F, print({0.85F, 0.8F, 0.3F}, {0.1F, 0.1F, 0.1F}, 0.03F));
}

void crate_rack(const RoomBuilder& b, Choices& choices) {
  for (const float x : {-0.75F, 0.0F, 0.75F}) {
    for (const float y : {-0.03F, -0.42F}) b.box({x, y, 0.95F}, {0.04F, 0.04F, 1.9F}, plain({0.2F, 0.3F, 0.5F}));
  }
  for (int level = 0; level < 4; ++level) {
    const float z = 0.15F + 0.52F * static_cast<float>(level);
    b.box({0.0F, -0.22F, z}, {1.54F, 0.42F, 0.03F}, wood({0.6F, 0.48F, 0.32F}));
    for (int i = 0; i < 4; ++i) {
      if (choices.chance(0.2F)) continue;
      const float height = choices.between(0.14F, 0.34F);
      const RoomBuilder at = choices.jitter(b.piece().at(-0.54F + 0.36F * static_cast<float>(i), -0.22F, z + 0.015F), 0.02F, 0.0F, 8.0F);
      const Colour colour = choices.colour();
      at.box({0.0F, 0.0F, 0.5F * height}, {0.3F, 0.36F, height}, plain(colour, 0.3F));
      at.picture({0.0F, -0.181F, 0.5F * height}, 0.12F, 0.06F, print({0.9F, 0.9F, 0.9F}, {0.1F, 0.1F, 0.1F}, 0.012F));
    }
  }
  b.target({-0.4F, -0.3F, 1.0F});
  b.target({0.4F, -0.3F, 1.3F});
}

}  // namespace

Room make_workshop() {
  Room room;
  const RoomBuilder world(room);
  Choices choices(7004);
  const Material brick = bricks({0.55F, 0.32F, 0.26F}, {0.62F, 0.6F, 0.56F});
  const Material concrete = plaster({0.62F, 0.61F, 0.58F}, 0.8F, 0.8F);
  world.shell(
      5.2F, 4.4F, 2.9F,
      {carpet({0.5F, 0.49F, 0.47F}, {0.3F, 0.29F, 0.28F}, 0.8F), wood({0.5F, 0.42F, 0.33F}, 0.2F), brick, concrete, brick, concrete});
  world.light({-1.3F, 0.2F, 2.8F}, {1.8F, 1.8F, 1.75F});
  world.light({1.4F, -0.2F, 2.8F}, {1.8F, 1.75F, 1.6F});
  tool_wall(world.against_north(-0.6F), 2.6F, choices);
  workbench(world.against_north(-0.9F), 1.9F, choices);
  workbench(world.against_north(1.15F), 1.6F, choices);
  crate_rack(world.against_east(0.2F), choices);
  barrel(world.at(2.2F, -1.7F, 0.0F, -60.0F), {0.2F, 0.3F, 0.55F});
  barrel(world.at(1.55F, -1.85F, 0.0F, 170.0F), {0.6F, 0.35F, 0.15F});
  drill(world.against_south(-0.6F));
  workbench(world.against_south(0.9F), 1.5F, choices);
  framed_picture(world.against_south(0.9F), 0.9F, 0.6F, 1.75F, choices);
  ladder(world.against_west(0.9F));
  wardrobe(world.against_west(-0.7F), 1.0F, 1.9F, plain({0.35F, 0.45F, 0.42F}, 0.4F), 30);
  world.against_west(-0.1F).target({0.0F, -0.3F, 1.2F});
  for (const float z : {2.3F, 2.5F}) world.rod({-2.6F, 2.1F, z}, {2.6F, 2.1F, z}, 0.03F, plain({0.55F, 0.3F, 0.2F}, 0.4F));
  world.rod({2.5F, 2.1F, 0.0F}, {2.5F, 2.1F, 2.9F}, 0.04F, plain({0.55F, 0.3F, 0.2F}, 0.4F));
  stool(world.at(-0.4F, 0.9F, 0.0F, 20.0F), 0.62F, wood({0.6F, 0.45F, 0.3F}), plain(kIron));
  box_stack(world.at(0.45F, -0.1F, 0.0F), 2, choices);
  bin(world.at(0.2F, 1.6F, 0.0F), {0.5F, 0.5F, 0.2F});
  world.target({0.4F, 0.0F, 0.5F});
  room.eye_low_world = {-1.4F, -0.8F, 1.25F};
  room.eye_high_world = {1.2F, 0.8F, 1.75F};
  return room;
}

}  // namespace foothold::synthetic_detail
