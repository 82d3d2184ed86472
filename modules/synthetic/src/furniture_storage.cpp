// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>

#include "furniture.h"

namespace foothold::synthetic_detail {
namespace {

/// Books side by side on a shelf from x = left, their backs facing -y.
void row_of_books(const RoomBuilder& b, float left, float right, float depth, float clear_height, Choices& choices) {
  float x = left;
  while (true) {
    const float thickness = choices.between(0.025F, 0.065F);
    if (x + thickness > right) return;
    const float height = std::min(clear_height - 0.02F, choices.between(0.19F, 0.31F));
    const float book_depth = std::min(depth - 0.02F, choices.between(0.15F, 0.24F));
    const Colour cover = choices.colour();
    const Colour title = choices.colour();
    b.box({x + 0.5F * thickness, -depth + 0.02F + 0.5F * book_depth, 0.5F * height}, {thickness, book_depth, height}, spine(cover, title));
    x += thickness + 0.001F;
    if (choices.chance(0.04F)) x += choices.between(0.03F, 0.12F);
  }
}

}  // namespace

void bookcase(const RoomBuilder& place, float width, float height, int num_shelves, float fill, const Material& timber, Choices& choices) {
  const RoomBuilder b = place.piece();
  constexpr float kDepth = 0.3F;
  constexpr float kBoard = 0.025F;
  const std::uint32_t seed = choices.seed();
  for (const float side : {-0.5F, 0.5F})
    b.box({side * (width - kBoard), -0.5F * kDepth, 0.5F * height}, {kBoard, kDepth, height}, timber, seed);
  b.box({0.0F, -0.008F, 0.5F * height}, {width - 2.0F * kBoard, 0.016F, height}, timber, seed + 1U);
  const float pitch = (height - kBoard) / static_cast<float>(num_shelves);
  const float inner = 0.5F * width - kBoard - 0.005F;
  for (int i = 0; i <= num_shelves; ++i) {
    const float z = pitch * static_cast<float>(i) + 0.5F * kBoard;
    b.box({0.0F, -0.5F * kDepth, z}, {width - 2.0F * kBoard, kDepth, kBoard}, timber, seed + 2U);
    if (i == num_shelves) break;
    const RoomBuilder shelf = b.at(0.0F, 0.0F, z + 0.5F * kBoard);
    const float end = -inner + 2.0F * inner * std::min(1.0F, fill * choices.between(0.75F, 1.3F));
    row_of_books(shelf, -inner, end, kDepth, pitch - kBoard, choices);
    if (inner - end > 0.2F) small_thing(shelf.at(0.5F * (end + inner), -0.5F * kDepth, 0.0F), choices);
  }
}

void cabinets(const RoomBuilder& b, int count, float unit_m, float height, const Material& front, const Material& worktop,
              std::uint32_t seed) {
  constexpr float kDepth = 0.58F;
  const float width = unit_m * static_cast<float>(count);
  b.box({0.0F, -0.5F * kDepth, 0.05F}, {width, kDepth - 0.1F, 0.1F}, plain({0.12F, 0.12F, 0.12F}));
  b.box({0.0F, -0.5F * kDepth, 0.5F * (height + 0.06F)}, {width, kDepth - 0.02F, height - 0.14F}, front, seed);
  for (int i = 0; i < count; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * unit_m - 0.5F * width;
    const bool drawers = i % 3 == 1;
    const int parts = drawers ? 3 : 1;
    const float part = (height - 0.16F) / static_cast<float>(parts);
    for (int k = 0; k < parts; ++k) {
      const float z = 0.11F + part * (static_cast<float>(k) + 0.5F);
      b.box({x, -kDepth, z}, {unit_m - 0.008F, 0.02F, part - 0.008F}, front, seed + static_cast<std::uint32_t>(1 + k));
      b.rod({x - 0.08F, -kDepth - 0.03F, z + 0.5F * part - 0.06F}, {x + 0.08F, -kDepth - 0.03F, z + 0.5F * part - 0.06F}, 0.007F,
            gloss(kSteel));
    }
  }
  b.box({0.0F, -0.5F * kDepth - 0.01F, height - 0.02F}, {width + 0.02F, kDepth + 0.06F, 0.04F}, worktop, seed + 9U);
}

void wall_cabinets(const RoomBuilder& b, int count, float unit_m, float from_z, const Material& front, std::uint32_t seed) {
  constexpr float kHeight = 0.65F;
  const float width = unit_m * static_cast<float>(count);
  b.box({0.0F, -0.16F, from_z + 0.5F * kHeight}, {width, 0.32F, kHeight}, front, seed);
  for (int i = 0; i < count; ++i) {
    const float x = (static_cast<float>(i) + 0.5F) * unit_m - 0.5F * width;
    b.box({x, -0.33F, from_z + 0.5F * kHeight}, {unit_m - 0.008F, 0.02F, kHeight - 0.008F}, front, seed + 1U);
    b.rod({x + 0.4F * unit_m, -0.36F, from_z + 0.06F}, {x + 0.4F * unit_m, -0.36F, from_z + 0.2F}, 0.007F, gloss(kSteel));
  }
}

void wardrobe(const RoomBuilder& place, float width, float height, const Material& front, std::uint32_t seed) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.28F, 0.5F * height}, {width, 0.56F, height}, front, seed);
  for (const float side : {-0.25F, 0.25F}) {
    b.box({side * width, -0.57F, 0.5F * height + 0.03F}, {0.5F * width - 0.01F, 0.02F, height - 0.1F}, front, seed + 1U);
    b.box({side * 0.16F * width, -0.6F, 0.5F * height}, {0.02F, 0.03F, 0.2F}, gloss(kSteel));
  }
}

void box_stack(const RoomBuilder& place, int count, Choices& choices) {
  const RoomBuilder b = place.piece();
  float z = 0.0F;
  for (int i = 0; i < count; ++i) {
    const float height = choices.between(0.18F, 0.38F);
    const RoomBuilder at = choices.jitter(b, 0.04F, z, 15.0F);
    const Colour cardboard = Colour(0.66F, 0.5F, 0.33F) * choices.between(0.8F, 1.15F);
    const Eigen::Vector3f size{choices.between(0.3F, 0.5F), choices.between(0.28F, 0.42F), height};
    at.box({0.0F, 0.0F, 0.5F * height}, size, choices.chance(0.7F) ? plaster(cardboard, 0.4F, 0.3F) : plain(choices.colour()));
    at.picture({0.05F, -0.5F * size.y() - 0.001F, 0.5F * height}, 0.14F, 0.1F, print({0.9F, 0.9F, 0.88F}, {0.1F, 0.1F, 0.1F}, 0.012F));
    at.sheet({0.0F, 0.0F, height + 0.001F}, size.x(), 0.05F, plain({0.75F, 0.65F, 0.45F}));
    z += height + 0.001F;
  }
}

void wall_shelf(const RoomBuilder& place, float width, float z, const Material& timber, int num_things, Choices& choices) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.12F, z}, {width, 0.24F, 0.03F}, timber);
  for (const float side : {-0.4F, 0.4F}) b.box({side * width, -0.08F, z - 0.08F}, {0.03F, 0.14F, 0.13F}, plain({0.2F, 0.2F, 0.2F}));
  clutter(b.at(0.0F, -0.12F, z + 0.016F), width - 0.1F, 0.06F, num_things, choices);
}

void fridge(const RoomBuilder& place, float height, const Colour& colour, Choices& choices) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, -0.3F, 0.5F * height}, {0.6F, 0.6F, height}, plain(colour));
  const float split = 0.64F * height;
  b.box({0.0F, -0.62F, 0.5F * split + 0.03F}, {0.59F, 0.04F, split - 0.05F}, plain(colour));
  b.box({0.0F, -0.62F, 0.5F * (split + height)}, {0.59F, 0.04F, height - split - 0.02F}, plain(colour));
  b.rod({-0.24F, -0.67F, split - 0.4F}, {-0.24F, -0.67F, split - 0.1F}, 0.012F, gloss(kSteel));
  b.rod({-0.24F, -0.67F, split + 0.06F}, {-0.24F, -0.67F, split + 0.25F}, 0.012F, gloss(kSteel));
  for (int i = 0; i < 5; ++i) {
    const float x = choices.between(-0.1F, 0.22F);
    const float z = choices.between(0.9F, height - 0.15F);
    const float width = choices.between(0.06F, 0.16F);
    const float tilt_deg = choices.between(-12.0F, 12.0F);
    const Material note = choices.chance(0.5F) ? paper() : poster(choices.colour());
    b.at(x, -0.641F, z).rolled(tilt_deg).picture({0.0F, 0.0F, 0.0F}, width, 1.2F * width, note);
  }
}

void oven(const RoomBuilder& b, const Colour& colour) {
  b.box({0.0F, -0.3F, 0.45F}, {0.6F, 0.6F, 0.9F}, plain(colour));
  b.picture({0.0F, -0.601F, 0.42F}, 0.5F, 0.4F, gloss({0.07F, 0.07F, 0.08F}, 0.4F));
  b.rod({-0.24F, -0.64F, 0.66F}, {0.24F, -0.64F, 0.66F}, 0.012F, gloss(kSteel));
  for (int i = 0; i < 5; ++i)
    b.rod({-0.22F + 0.11F * static_cast<float>(i), -0.6F, 0.79F}, {-0.22F + 0.11F * static_cast<float>(i), -0.63F, 0.79F}, 0.022F,
          plain({0.1F, 0.1F, 0.1F}));
  for (const float x : {-0.14F, 0.14F}) {
    for (const float y : {-0.16F, -0.44F}) b.cylinder({x, y, 0.9F}, x * y < 0.0F ? 0.1F : 0.075F, 0.012F, plain({0.1F, 0.1F, 0.11F}));
  }
  b.cylinder({-0.14F, -0.16F, 0.913F}, 0.1F, 0.14F, gloss(kSteel, 0.8F));
  b.rod({-0.14F, -0.27F, 1.02F}, {-0.2F, -0.45F, 1.04F}, 0.012F, plain({0.1F, 0.1F, 0.1F}));
}

void microwave(const RoomBuilder& place, const Colour& colour) {
  const RoomBuilder b = place.piece();
  b.box({0.0F, 0.0F, 0.14F}, {0.48F, 0.34F, 0.28F}, plain(colour));
  b.picture({-0.07F, -0.171F, 0.14F}, 0.3F, 0.2F, gloss({0.08F, 0.08F, 0.09F}, 0.5F));
  b.picture({0.17F, -0.171F, 0.14F}, 0.09F, 0.22F, keys({0.75F, 0.75F, 0.75F}, {0.3F, 0.3F, 0.3F}));
}

void sink(const RoomBuilder& b, float worktop_z) {
  b.sheet({0.0F, -0.3F, worktop_z + 0.001F}, 0.86F, 0.46F, gloss(kSteel, 0.7F));
  b.sheet({-0.18F, -0.3F, worktop_z + 0.002F}, 0.38F, 0.36F, gloss({0.35F, 0.36F, 0.38F}, 0.7F));
  for (int i = 0; i < 6; ++i)
    b.box({0.1F + 0.05F * static_cast<float>(i), -0.3F, worktop_z + 0.004F}, {0.012F, 0.36F, 0.006F}, gloss({0.7F, 0.7F, 0.72F}));
  b.cylinder({-0.18F, -0.09F, worktop_z}, 0.02F, 0.26F, gloss({0.75F, 0.75F, 0.78F}));
  b.rod({-0.18F, -0.09F, worktop_z + 0.26F}, {-0.18F, -0.28F, worktop_z + 0.24F}, 0.014F, gloss({0.75F, 0.75F, 0.78F}));
  b.box({0.25F, -0.32F, worktop_z + 0.09F}, {0.3F, 0.3F, 0.012F}, plain({0.3F, 0.5F, 0.7F}));
  for (int i = 0; i < 4; ++i)
    b.at(0.15F + 0.07F * static_cast<float>(i), -0.32F, worktop_z + 0.1F)
        .rolled(10.0F)
        .pitched(90.0F)
        .cylinder({0.0F, 0.1F, -0.01F}, 0.11F, 0.012F, plain({0.85F, 0.84F, 0.8F}));
}

}  // namespace foothold::synthetic_detail
