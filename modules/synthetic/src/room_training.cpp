// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>

#include "furniture.h"
#include "rooms.h"

namespace foothold::synthetic_detail {
namespace {

using Eigen::Vector3f;

// What is drawn at random is drawn in statements of its own: a call's arguments are evaluated in an order that compilers choose.

Material any_wood(float widest_plank_m, Choices& choices) {
  const float contrast = choices.between(0.3F, 0.7F);
  const float plank_m = choices.between(0.08F, widest_plank_m);
  return wood(choices.timber(), plank_m, contrast);
}

Material wall_material(Choices& choices) {
  const Colour colour = choices.muted();
  switch (choices.below(8)) {
    case 0:
      return bricks(0.8F * choices.colour(), colour);
    case 1: {
      const float contrast = choices.between(0.1F, 0.4F);
      return tiles(colour, 0.7F * colour, choices.between(0.1F, 0.3F), contrast);
    }
    case 2:
      return stripes(colour, 0.8F * colour, choices.between(0.03F, 0.2F), 0.4F);
    case 3: {
      const float plank_m = choices.between(0.08F, 0.2F);
      return wood(choices.timber(), plank_m, 0.4F);
    }
    case 4:
      return plain(choices.colour());
    default: {
      const float scale_m = choices.between(0.4F, 1.4F);
      return plaster(colour, choices.between(0.15F, 0.6F), scale_m);
    }
  }
}

Material floor_material(Choices& choices) {
  const float brightness = choices.between(0.4F, 1.0F);
  const Colour colour = choices.muted() * brightness;
  switch (choices.below(6)) {
    case 0:
      return tiles(colour, 0.6F * colour, choices.between(0.2F, 0.6F), 0.3F);
    case 1: {
      const float square_m = choices.between(0.15F, 0.4F);
      return checker(colour, 0.6F * choices.colour(), square_m);
    }
    case 2:
      return stripes(colour, 0.6F * colour, choices.between(0.02F, 0.08F));
    case 3:
      return carpet(colour, 0.5F * choices.colour());
    case 4:
      return speckle(colour, 0.5F * colour, choices.between(0.4F, 1.0F));
    default:
      return any_wood(0.25F, choices);
  }
}

Material furniture_material(Choices& choices) {
  const int kind = choices.below(3);
  if (kind == 2) return any_wood(0.5F, choices);
  const float contrast = choices.between(0.1F, 0.5F);
  return plain(kind == 0 ? choices.colour() : choices.muted(), contrast);
}

Material cover_material(Choices& choices) {
  const Colour colour = choices.colour();
  if (!choices.chance(0.3F)) return fabric(colour, choices.between(0.3F, 0.9F));
  const float stripe_m = choices.between(0.02F, 0.08F);
  return stripes(colour, choices.colour(), stripe_m);
}

void chair(const RoomBuilder& b, Choices& choices) {
  const std::uint32_t seed = choices.seed();
  if (choices.chance(0.5F)) return office_chair(b, cover_material(choices), seed);
  const Material timber = wood(choices.timber());
  wooden_chair(b, timber, choices.chance(0.5F) ? cover_material(choices) : timber, seed);
}

void workplace(const RoomBuilder& b, float width, Choices& choices) {
  constexpr float kDeskZ = 0.73F;
  const Material top = furniture_material(choices);
  const std::uint32_t seed = choices.seed();
  desk(b, width, top, furniture_material(choices), seed);
  const int num_monitors = 1 + choices.below(2);
  for (int i = 0; i < num_monitors; ++i) {
    const float x = -0.3F * width + 0.58F * static_cast<float>(i);
    const float size = choices.between(0.42F, 0.56F);
    const std::uint32_t screen_seed = choices.seed();
    monitor(b.at(x, -0.2F, kDeskZ, choices.between(-15.0F, 15.0F)), size, screen_seed);
  }
  keyboard(b.at(-0.2F, -0.5F, kDeskZ));
  clutter(b.at(0.3F * width, -0.4F, kDeskZ), 0.35F * width, 0.35F, 2 + choices.below(2), choices);
  const float turn_deg = choices.between(-50.0F, 50.0F);
  chair(b.at(-0.1F, -1.05F, 0.0F, turn_deg), choices);
}

void kitchenette(const RoomBuilder& b, float width, Choices& choices) {
  const int count = std::max(1, static_cast<int>(width / 0.6F));
  const Material front = furniture_material(choices);
  const Material worktop = choices.chance(0.5F) ? speckle(choices.muted(), {0.15F, 0.15F, 0.15F}) : wood(choices.timber());
  cabinets(b, count, 0.6F, 0.9F, front, worktop, choices.seed());
  if (choices.chance(0.6F)) wall_cabinets(b, count, 0.6F, 1.45F, front, choices.seed());
  if (count > 2) sink(b.at(-0.5F, 0.0F, 0.0F), 0.9F);
  clutter(b.at(0.2F * width, -0.3F, 0.9F), 0.5F * width, 0.3F, 2 + choices.below(3), choices);
}

void dresser(const RoomBuilder& b, float width, Choices& choices) {
  const float depth = choices.between(0.45F, 0.75F);
  const float height = choices.between(0.5F, 0.95F);
  const Material top = furniture_material(choices);
  const std::uint32_t seed = choices.seed();
  table(b, width, depth, height, top, choices.chance(0.5F) ? top : furniture_material(choices), seed);
  clutter(b.at(0.0F, -0.5F * depth, height), 0.9F * width, 0.5F * depth, 2 + choices.below(4), choices);
  if (choices.chance(0.5F)) box_stack(b.at(0.0F, -0.3F, 0.0F), 1, choices);
}

Material any_material(Choices& choices) {
  const Colour colour = choices.colour();
  switch (choices.below(6)) {
    case 0: {
      const float square_m = choices.between(0.03F, 0.12F);
      return checker(colour, choices.colour(), square_m);
    }
    case 1: {
      const float stripe_m = choices.between(0.015F, 0.08F);
      return stripes(colour, choices.colour(), stripe_m);
    }
    case 2:
      return poster(colour, choices.colour());
    case 3:
      return speckle(colour, choices.colour());
    case 4:
      return cover_material(choices);
    default:
      return furniture_material(choices);
  }
}

/// A pile of boxes, balls and drums in any position, so that not everything stands square on a floor.
void shapes(const RoomBuilder& b, float width, int count, Choices& choices) {
  for (int i = 0; i < count; ++i) {
    const RoomBuilder place = choices.jitter(b.piece(), 0.4F * width, choices.between(0.1F, 0.6F), 180.0F);
    const float tilt_deg = choices.between(-60.0F, 60.0F);
    const RoomBuilder at = place.pitched(tilt_deg).rolled(choices.between(-60.0F, 60.0F));
    const Material material = any_material(choices);
    const float size = choices.between(0.12F, 0.4F);
    switch (choices.below(3)) {
      case 0:
        at.box(Vector3f::Zero(), {size, choices.between(0.1F, 0.4F), choices.between(0.05F, 0.6F)}, material);
        break;
      case 1:
        at.sphere(Vector3f::Zero(), 0.5F * size, material);
        break;
      default:
        at.cylinder(Vector3f::Zero(), 0.4F * size, choices.between(0.1F, 0.7F), material);
        break;
    }
  }
}

/// One piece of furniture at a wall, `width` metres of which are free.
void stand_something(const RoomBuilder& b, float width, Choices& choices) {
  b.target({0.0F, -0.3F, choices.between(0.5F, 1.3F)});
  switch (choices.below(10)) {
    case 9:
      return shapes(b.at(0.0F, -0.4F, 0.0F), width - 0.2F, 4 + choices.below(5), choices);
    case 0: {
      const float height = choices.between(1.1F, 2.1F);
      const float fill = choices.between(0.5F, 1.0F);
      return bookcase(b, width - 0.1F, height, static_cast<int>(height / 0.37F), fill, furniture_material(choices), choices);
    }
    case 1: {
      const float height = choices.between(1.2F, 2.1F);
      const std::uint32_t seed = choices.seed();
      return wardrobe(b, width - 0.1F, height, furniture_material(choices), seed);
    }
    case 2:
    case 3:
      return workplace(b, std::max(1.2F, width - 0.1F), choices);
    case 4: {
      const Material cover = cover_material(choices);
      const Material cushion = cover_material(choices);
      return sofa(b, std::max(1.3F, width - 0.1F), cover, cushion, choices.seed());
    }
    case 5:
      return kitchenette(b, width, choices);
    case 6: {
      const float height = choices.between(0.7F, 1.5F);
      plant(b.at(-0.25F * width, -0.35F, 0.0F), height, choices.colour(), choices);
      return floor_lamp(b.at(0.25F * width, -0.15F, 0.0F), choices.colour());
    }
    case 7: {
      box_stack(b.at(-0.25F * width, -0.3F, 0.0F), 1 + choices.below(3), choices);
      return box_stack(b.at(0.25F * width, -0.35F, 0.0F), 1 + choices.below(4), choices);
    }
    default:
      return dresser(b, width - 0.1F, choices);
  }
}

/// Something on a wall above the furniture.
void hang_something(const RoomBuilder& b, float width, Choices& choices) {
  const float z = choices.between(1.5F, 1.85F);
  switch (choices.below(6)) {
    case 0:
      return window(b, std::min(width, 1.3F), 0.9F, z - 0.4F, choices.seed());
    case 1:
      return whiteboard(b, std::min(width, 1.6F), z, choices.seed());
    case 2: {
      const Material board = furniture_material(choices);
      return wall_shelf(b, std::min(width - 0.1F, 1.2F), z - 0.1F, board, 2 + choices.below(4), choices);
    }
    case 3:
      return;
    default: {
      const float picture = choices.between(0.3F, 0.8F);
      const float shape = choices.between(0.6F, 1.5F);
      return framed_picture(b, picture, std::min(0.9F, picture * shape), z, choices);
    }
  }
}

/// Fills one wall from end to end.
template <class AtWall>
void furnish_wall(const AtWall& at_wall, float low, float high, Choices& choices) {
  float x = low;
  while (high - x > 0.8F) {
    const float width = std::min(choices.between(0.8F, 2.1F), high - x);
    const RoomBuilder b = at_wall(x + 0.5F * width);
    if (width > 1.0F && choices.chance(0.12F)) {
      const Material leaf = furniture_material(choices);
      door(b, leaf, choices.seed());
    } else {
      if (!choices.chance(0.12F)) stand_something(b, width, choices);
      if (choices.chance(0.7F)) hang_something(b, width, choices);
    }
    x += width + choices.between(0.0F, 0.25F);
  }
}

/// A table with chairs in the middle of the room.
void furnish_middle(const RoomBuilder& world, Choices& choices) {
  const float x = choices.between(-0.4F, 0.4F);
  const float y = choices.between(-0.4F, 0.4F);
  const RoomBuilder b = world.at(x, y, 0.0F, choices.between(0.0F, 360.0F));
  const float width = choices.between(0.8F, 1.5F);
  const float depth = choices.between(0.6F, 0.9F);
  const float height = choices.between(0.4F, 0.76F);
  const Material top = furniture_material(choices);
  const std::uint32_t seed = choices.seed();
  table(b.at(0.0F, 0.5F * depth, 0.0F), width, depth, height, top, furniture_material(choices), seed);
  clutter(b.at(0.0F, 0.0F, height), 0.85F * width, 0.5F * depth, 3 + choices.below(4), choices);
  const Material rug =
      choices.chance(0.5F) ? stripes(choices.colour(), {0.7F, 0.65F, 0.6F}, 0.08F) : checker(choices.colour(), {0.4F, 0.35F, 0.3F}, 0.2F);
  if (choices.chance(0.5F)) b.sheet({0.0F, 0.0F, 0.004F}, width + 0.9F, depth + 0.9F, rug);
  if (height > 0.6F) {
    for (const float side : {0.0F, 180.0F}) {
      if (choices.chance(0.8F)) chair(b.at(0.0F, 0.0F, 0.0F, side).at(0.0F, 0.5F * depth + 0.2F, 0.0F), choices);
    }
  }
  b.target({0.0F, 0.0F, height});
  b.target({0.3F, 0.1F, height});
}

void light_room(const RoomBuilder& world, float width, float depth, float height, Choices& choices) {
  const int num_lamps = 2 + choices.below(3);
  const float power = choices.between(2.2F, 4.2F) / static_cast<float>(num_lamps);
  for (int i = 0; i < num_lamps; ++i) {
    const Vector3f place{choices.between(-0.3F, 0.3F) * width, choices.between(-0.3F, 0.3F) * depth,
                         choices.between(0.75F, 0.98F) * height};
    const float warmth = choices.between(-0.12F, 0.18F);
    world.light(place, power * Colour(1.0F + warmth, 1.0F, 1.0F - warmth));
  }
  world.room().ambient = Colour::Constant(choices.between(0.35F, 0.6F));
}

}  // namespace

Room make_training_room(std::uint64_t k) {
  Room room;
  const RoomBuilder world(room);
  Choices choices(derive_seed(k, 0x7261696e));
  const float width = choices.between(3.4F, 5.8F);
  const float depth = choices.between(3.4F, 5.2F);
  const float height = choices.between(2.3F, 3.1F);
  const Material wall = wall_material(choices);
  const auto side = [&] { return choices.chance(0.65F) ? wall : wall_material(choices); };
  world.shell(width, depth, height, {floor_material(choices), plain(choices.muted()), side(), side(), side(), side()});
  light_room(world, width, depth, height, choices);
  furnish_wall([&](float x) { return world.against_north(x); }, -0.5F * width + 0.05F, 0.5F * width - 0.05F, choices);
  furnish_wall([&](float x) { return world.against_south(x); }, -0.5F * width + 0.05F, 0.5F * width - 0.05F, choices);
  furnish_wall([&](float x) { return world.against_east(x); }, -0.5F * depth + 0.75F, 0.5F * depth - 0.75F, choices);
  furnish_wall([&](float x) { return world.against_west(x); }, -0.5F * depth + 0.75F, 0.5F * depth - 0.75F, choices);
  if (choices.chance(0.7F)) furnish_middle(world, choices);
  world.target({0.0F, 0.5F * depth, 1.2F});
  world.target({0.0F, -0.5F * depth, 1.2F});
  const float eye_z = choices.between(1.15F, 1.6F);
  room.eye_low_world = {0.7F - 0.5F * width + 0.25F, 0.7F - 0.5F * depth + 0.25F, eye_z - 0.2F};
  room.eye_high_world = {-0.7F + 0.5F * width - 0.25F, -0.7F + 0.5F * depth - 0.25F, eye_z + 0.25F};
  return room;
}

}  // namespace foothold::synthetic_detail
