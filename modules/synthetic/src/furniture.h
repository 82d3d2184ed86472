// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Pieces of furniture, each in its own frame: standing on z = 0, middle at x = 0, back at y = 0, facing -y, unless stated.
#pragma once

#include <cstdint>

#include "foothold/base/random.h"
#include "materials.h"
#include "room_builder.h"

namespace foothold::synthetic_detail {

/// Seeds, sizes and colours for one room, drawn one after the other. Draw at most once in an argument list: its order is the compiler's.
class Choices {
 public:
  explicit Choices(std::uint64_t seed) : random_(seed, 0) {}
  std::uint32_t seed() { return random_.bits(); }
  float between(float low, float high) { return random_.uniform(low, high); }
  int below(int n) { return static_cast<int>(random_.below(static_cast<std::uint32_t>(n))); }
  bool chance(float probability) { return random_.uniform() < probability; }
  /// A frame shifted by up to `shift_m` along x and y, put at height z and turned by up to `turn_deg`.
  RoomBuilder jitter(const RoomBuilder& b, float shift_m, float z, float turn_deg);
  /// Any colour, from pale to vivid.
  Colour colour();
  /// A colour of walls and large furniture.
  Colour muted();
  /// A wood between pine and walnut.
  Colour timber();

 private:
  Random random_;
};

/// Handles, rods and taps.
inline const Colour kSteel(0.62F, 0.63F, 0.65F);

// Tables and seats.
void table(const RoomBuilder& b, float width, float depth, float height, const Material& top, const Material& legs, std::uint32_t seed);
void desk(const RoomBuilder& b, float width, const Material& top, const Material& frame, std::uint32_t seed);
/// Middle of the seat at the origin.
void office_chair(const RoomBuilder& b, const Material& cover, std::uint32_t seed);
/// Middle of the seat at the origin.
void wooden_chair(const RoomBuilder& b, const Material& timber, const Material& seat, std::uint32_t seed);
void sofa(const RoomBuilder& b, float width, const Material& cover, const Material& cushion, std::uint32_t seed);
/// Middle at the origin.
void stool(const RoomBuilder& b, float height, const Material& seat, const Material& legs);

// Storage.
/// Shelves filled with books; sparse ones also hold boxes and ornaments.
void bookcase(const RoomBuilder& b, float width, float height, int num_shelves, float fill, const Material& timber, Choices& choices);
/// A row of base cabinets with a worktop.
void cabinets(const RoomBuilder& b, int count, float unit_m, float height, const Material& front, const Material& worktop,
              std::uint32_t seed);
/// A row of cabinets that hang on the wall from a height.
void wall_cabinets(const RoomBuilder& b, int count, float unit_m, float from_z, const Material& front, std::uint32_t seed);
void wardrobe(const RoomBuilder& b, float width, float height, const Material& front, std::uint32_t seed);
/// Boxes stacked about the origin.
void box_stack(const RoomBuilder& b, int count, Choices& choices);
/// An open shelf on the wall with things on it.
void wall_shelf(const RoomBuilder& b, float width, float z, const Material& timber, int num_things, Choices& choices);

// Things: they stand on the origin.
void monitor(const RoomBuilder& b, float width, std::uint32_t picture_seed);
void keyboard(const RoomBuilder& b);
void mug(const RoomBuilder& b, const Colour& colour);
void bottle(const RoomBuilder& b, const Colour& colour, float height);
void desk_lamp(const RoomBuilder& b, const Colour& colour);
void floor_lamp(const RoomBuilder& b, const Colour& shade);
void plant(const RoomBuilder& b, float height, const Colour& pot, Choices& choices);
void bin(const RoomBuilder& b, const Colour& colour);
void books_lying(const RoomBuilder& b, int count, Choices& choices);
/// A thing of random kind that fits within about 25 cm.
void small_thing(const RoomBuilder& b, Choices& choices);
/// Scatters things over a surface of a size whose middle is the origin.
void clutter(const RoomBuilder& b, float width, float depth, int count, Choices& choices);

// On walls.
void door(const RoomBuilder& b, const Material& leaf, std::uint32_t seed);
void window(const RoomBuilder& b, float width, float height, float sill_z, std::uint32_t seed);
void framed_picture(const RoomBuilder& b, float width, float height, float centre_z, Choices& choices);
void whiteboard(const RoomBuilder& b, float width, float centre_z, std::uint32_t seed);
void radiator(const RoomBuilder& b, float width);

// Machines.
void fridge(const RoomBuilder& b, float height, const Colour& colour, Choices& choices);
void oven(const RoomBuilder& b, const Colour& colour);
void microwave(const RoomBuilder& b, const Colour& colour);
void sink(const RoomBuilder& b, float worktop_z);

}  // namespace foothold::synthetic_detail
