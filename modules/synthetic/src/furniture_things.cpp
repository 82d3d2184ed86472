// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "furniture.h"

namespace foothold::synthetic_detail {
namespace {

const Colour kBlack(0.08F, 0.08F, 0.09F);

}  // namespace

void monitor(const RoomBuilder& place, float width, std::uint32_t picture_seed) {
  const RoomBuilder b = place.piece();
  const float height = 0.6F * width;
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.12F, 0.015F, plain(kBlack));
  b.box({0.0F, 0.02F, 0.12F}, {0.06F, 0.02F, 0.24F}, plain(kBlack));
  b.box({0.0F, 0.0F, 0.12F + 0.5F * height}, {width, 0.04F, height}, plain(kBlack));
  b.picture({0.0F, -0.021F, 0.12F + 0.5F * height}, width - 0.03F, height - 0.03F, screen({0.15F, 0.35F, 0.6F}, {0.4F, 0.6F, 0.65F}),
            picture_seed);
}

void keyboard(const RoomBuilder& place) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, 0.0F, 0.01F}, {0.44F, 0.14F, 0.02F}, keys());
  b.box({0.32F, 0.0F, 0.015F}, {0.06F, 0.1F, 0.03F}, plain({0.15F, 0.15F, 0.16F}));
}

void mug(const RoomBuilder& place, const Colour& colour) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.04F, 0.095F, plain(colour));
  b.cylinder({0.0F, 0.0F, 0.0951F}, 0.034F, 0.001F, plain({0.2F, 0.12F, 0.07F}));
  b.box({0.05F, 0.0F, 0.05F}, {0.03F, 0.012F, 0.055F}, plain(colour));
}

void bottle(const RoomBuilder& place, const Colour& colour, float height) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.15F * height, 0.62F * height, gloss(colour, 0.85F));
  b.cylinder({0.0F, 0.0F, 0.2F * height}, 0.152F * height, 0.25F * height, print({0.9F, 0.88F, 0.8F}, 0.4F * colour, 0.02F));
  b.sphere({0.0F, 0.0F, 0.62F * height}, 0.149F * height, gloss(colour, 0.85F));
  b.cylinder({0.0F, 0.0F, 0.7F * height}, 0.055F * height, 0.3F * height, gloss(0.7F * colour, 0.85F));
}

void desk_lamp(const RoomBuilder& place, const Colour& colour) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.09F, 0.02F, plain(colour));
  b.rod({0.0F, 0.0F, 0.02F}, {0.1F, 0.05F, 0.28F}, 0.012F, gloss(kSteel));
  b.rod({0.1F, 0.05F, 0.28F}, {-0.08F, -0.1F, 0.44F}, 0.012F, gloss(kSteel));
  b.rod({-0.08F, -0.1F, 0.46F}, {-0.13F, -0.16F, 0.37F}, 0.065F, plain(colour));
}

void floor_lamp(const RoomBuilder& place, const Colour& shade) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, -0.2F, 0.0F}, 0.14F, 0.03F, plain(kBlack));
  b.cylinder({0.0F, -0.2F, 0.03F}, 0.014F, 1.45F, gloss(kSteel));
  b.cylinder({0.0F, -0.2F, 1.38F}, 0.2F, 0.28F, fabric(shade, 0.2F));
}

void plant(const RoomBuilder& place, float height, const Colour& pot, Choices& choices) {
  const RoomBuilder b = place.piece();
  const float r = 0.16F * height;
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.75F * r, 0.28F * height, plaster(pot, 0.5F, 0.15F));
  b.cylinder({0.0F, 0.0F, 0.281F * height}, 0.68F * r, 0.002F, speckle({0.25F, 0.18F, 0.12F}, {0.1F, 0.07F, 0.05F}));
  const Colour green = Colour(0.2F, 0.45F, 0.15F) + Colour(0.2F, 0.15F, 0.05F) * choices.between(0.0F, 1.0F);
  for (int i = 0; i < 9; ++i) {
    const float x = choices.between(-1.0F, 1.0F) * r;
    const float y = choices.between(-1.0F, 1.0F) * r;
    const float z = choices.between(0.45F, 0.92F) * height;
    b.sphere({x, y, z}, choices.between(0.35F, 0.7F) * r, foliage(green, 0.04F + 0.05F * height));
    if (i % 3 == 0) b.rod({0.3F * x, 0.3F * y, 0.25F * height}, {x, y, z}, 0.012F, wood({0.4F, 0.3F, 0.2F}));
  }
}

void bin(const RoomBuilder& place, const Colour& colour) {
  const RoomBuilder b = place.piece();
  b.cylinder({0.0F, 0.0F, 0.0F}, 0.14F, 0.32F, plain(colour, 0.4F));
  b.cylinder({0.0F, 0.0F, 0.3201F}, 0.13F, 0.001F, speckle({0.5F, 0.5F, 0.5F}, {0.1F, 0.1F, 0.1F}, 1.0F));
}

void books_lying(const RoomBuilder& place, int count, Choices& choices) {
  const RoomBuilder b = place.piece();
  float z = 0.0F;
  for (int i = 0; i < count; ++i) {
    const float thickness = choices.between(0.015F, 0.045F);
    const RoomBuilder at = choices.jitter(b, 0.02F, z, 25.0F);
    const float width = choices.between(0.16F, 0.22F);
    at.box({0.0F, 0.0F, 0.5F * thickness}, {width, 1.4F * width, thickness}, poster(choices.colour()));
    z += thickness;
  }
}

void small_thing(const RoomBuilder& b, Choices& choices) {
  const RoomBuilder at = b.piece().at(0.0F, 0.0F, 0.0F, choices.between(0.0F, 360.0F));
  const Colour colour = choices.colour();
  const Colour accent = choices.colour();
  const float size = choices.between(0.0F, 1.0F);
  switch (choices.below(10)) {
    case 0:
      return mug(at, colour);
    case 1:
      return bottle(at, colour, 0.2F + 0.14F * size);
    case 2:
      return books_lying(at, 1 + choices.below(5), choices);
    case 3:
      return at.sheet({0.0F, 0.0F, 0.002F}, 0.21F, 0.297F, paper());
    case 4:
      return at.sphere({0.0F, 0.0F, 0.07F}, 0.07F, checker(colour, accent, 0.04F));
    case 5:
      return plant(at, 0.22F + 0.14F * size, colour, choices);
    case 6:
      return at.cylinder({0.0F, 0.0F, 0.0F}, 0.05F, 0.12F, stripes(colour, accent, 0.015F));
    case 7:
      return desk_lamp(at, colour);
    case 8: {
      const float height = 0.05F + 0.15F * size;
      const float width = choices.between(0.08F, 0.26F);
      return at.box({0.0F, 0.0F, 0.5F * height}, {width, 0.8F * width, height}, poster(colour));
    }
    default: {
      at.box({0.0F, 0.02F, 0.09F}, {0.15F, 0.015F, 0.18F}, wood(choices.timber()));
      return at.picture({0.0F, 0.012F, 0.09F}, 0.12F, 0.15F, poster(colour));
    }
  }
}

void clutter(const RoomBuilder& b, float width, float depth, int count, Choices& choices) {
  for (int i = 0; i < count; ++i) {
    // One slot per thing keeps them from standing inside each other.
    const float slot = width / static_cast<float>(count);
    const float x = -0.5F * width + slot * (static_cast<float>(i) + choices.between(0.3F, 0.7F));
    const float y = choices.between(-0.5F, 0.5F) * depth;
    small_thing(b.at(x, y, 0.0F), choices);
  }
}

void door(const RoomBuilder& b, const Material& leaf, std::uint32_t seed) {
  b.box({0.0F, -0.02F, 1.0F}, {0.88F, 0.04F, 2.0F}, leaf, seed);
  const Material frame = plain({0.82F, 0.82F, 0.8F});
  for (const float side : {-0.49F, 0.49F}) b.box({side, -0.03F, 1.04F}, {0.1F, 0.06F, 2.08F}, frame);
  b.box({0.0F, -0.03F, 2.05F}, {0.88F, 0.06F, 0.1F}, frame);
  b.rod({0.36F, -0.04F, 1.02F}, {0.36F, -0.09F, 1.02F}, 0.012F, gloss(kSteel));
  b.rod({0.37F, -0.09F, 1.02F}, {0.25F, -0.09F, 1.02F}, 0.011F, gloss(kSteel));
  b.picture({-0.05F, -0.041F, 1.5F}, 0.2F, 0.1F, print({0.9F, 0.9F, 0.85F}, {0.1F, 0.1F, 0.4F}, 0.03F), seed);
}

void window(const RoomBuilder& b, float width, float height, float sill_z, std::uint32_t seed) {
  const Material frame = plain({0.85F, 0.85F, 0.84F});
  const float middle = sill_z + 0.5F * height;
  b.picture({0.0F, -0.01F, middle}, width, height, glass({0.62F, 0.74F, 0.86F}), seed);
  for (const float x : {-0.5F * width, 0.0F, 0.5F * width}) b.box({x, -0.03F, middle}, {0.07F, 0.06F, height + 0.07F}, frame);
  for (const float z : {sill_z, sill_z + height}) b.box({0.0F, -0.03F, z}, {width, 0.06F, 0.07F}, frame);
  b.box({0.0F, -0.1F, sill_z - 0.05F}, {width + 0.2F, 0.2F, 0.03F}, speckle({0.8F, 0.8F, 0.78F}, {0.5F, 0.5F, 0.5F}, 0.4F), seed);
}

void framed_picture(const RoomBuilder& place, float width, float height, float centre_z, Choices& choices) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.015F, centre_z}, {width + 0.06F, 0.03F, height + 0.06F}, wood(choices.timber()));
  const Colour ground = choices.colour();
  b.picture({0.0F, -0.031F, centre_z}, width, height, poster(ground, choices.colour()));
}

void whiteboard(const RoomBuilder& place, float width, float centre_z, std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.012F, centre_z}, {width, 0.024F, 0.9F}, gloss({0.6F, 0.6F, 0.62F}, 0.9F));
  b.picture({0.0F, -0.025F, centre_z}, width - 0.05F, 0.85F, print({0.9F, 0.9F, 0.92F}, {0.15F, 0.2F, 0.6F}, 0.06F), seed);
  b.box({0.0F, -0.05F, centre_z - 0.46F}, {0.5F * width, 0.08F, 0.02F}, gloss({0.6F, 0.6F, 0.62F}, 0.9F));
  for (const float x : {-0.15F, -0.05F, 0.08F})
    b.rod({x, -0.06F, centre_z - 0.44F}, {x + 0.1F, -0.06F, centre_z - 0.44F}, 0.008F, plain({0.8F - x, 0.1F, 0.2F + x}));
}

void radiator(const RoomBuilder& b, float width) {
  const Material enamel = plain({0.86F, 0.86F, 0.84F});
  b.box({0.0F, -0.06F, 0.42F}, {width, 0.03F, 0.54F}, enamel);
  const int num_ribs = static_cast<int>(width / 0.1F);
  for (int i = 0; i < num_ribs; ++i) {
    b.box({(static_cast<float>(i) + 0.5F) * width / static_cast<float>(num_ribs) - 0.5F * width, -0.09F, 0.42F}, {0.035F, 0.05F, 0.56F},
          enamel);
  }
}

}  // namespace foothold::synthetic_detail
