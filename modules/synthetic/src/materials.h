// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What things are made of.
#pragma once

#include <Eigen/Core>

#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

using Colour = Eigen::Vector3f;

inline Material plain(const Colour& colour, float contrast = 0.12F) {
  return {Texture::kPlain, colour, 0.5F * colour, 0.5F, contrast, 1.0F};
}
inline Material plaster(const Colour& colour, float contrast = 0.3F, float scale_m = 0.9F) {
  return {Texture::kPlaster, colour, 0.72F * colour, scale_m, contrast, 1.0F};
}
inline Material carpet(const Colour& colour, const Colour& accent, float contrast = 0.6F) {
  return {Texture::kPlaster, colour, accent, 0.35F, contrast, 1.0F};
}
inline Material wood(const Colour& colour, float plank_m = 0.12F, float contrast = 0.5F) {
  return {Texture::kWood, colour, 0.5F * colour, plank_m, contrast, 1.0F};
}
inline Material tiles(const Colour& colour, const Colour& joint, float tile_m, float contrast = 0.3F) {
  return {Texture::kTiles, colour, joint, tile_m, contrast, 1.0F};
}
inline Material checker(const Colour& colour, const Colour& accent, float square_m) {
  return {Texture::kChecker, colour, accent, square_m, 0.4F, 1.0F};
}
inline Material stripes(const Colour& colour, const Colour& accent, float stripe_m, float contrast = 0.6F) {
  return {Texture::kStripes, colour, accent, stripe_m, contrast, 1.0F};
}
inline Material paper(const Colour& colour = {0.88F, 0.88F, 0.86F}) {
  return {Texture::kText, colour, {0.12F, 0.12F, 0.15F}, 0.008F, 0.85F, 1.0F};
}
inline Material print(const Colour& colour, const Colour& ink, float line_m) { return {Texture::kText, colour, ink, line_m, 0.9F, 1.0F}; }
inline Material poster(const Colour& colour, const Colour& caption = {0.1F, 0.1F, 0.1F}) {
  return {Texture::kPoster, colour, caption, 0.3F, 0.5F, 1.0F};
}
inline Material spine(const Colour& colour, const Colour& accent) { return {Texture::kSpine, colour, accent, 0.1F, 0.5F, 1.0F}; }
inline Material fabric(const Colour& colour, float contrast = 0.5F, float weave_m = 0.012F) {
  return {Texture::kFabric, colour, 0.5F * colour, weave_m, contrast, 1.0F};
}
inline Material speckle(const Colour& colour, const Colour& accent, float contrast = 0.7F) {
  return {Texture::kSpeckle, colour, accent, 0.012F, contrast, 1.0F};
}
inline Material bricks(const Colour& colour, const Colour& mortar) { return {Texture::kBricks, colour, mortar, 0.22F, 0.6F, 1.0F}; }
inline Material keys(const Colour& colour = {0.2F, 0.2F, 0.22F}, const Colour& gap = {0.06F, 0.06F, 0.07F}) {
  return {Texture::kKeyboard, colour, gap, 0.019F, 0.5F, 1.0F};
}
inline Material screen(const Colour& top, const Colour& bottom) { return {Texture::kScreen, bottom, top, 0.1F, 0.5F, 0.8F}; }
inline Material foliage(const Colour& colour, float leaf_m = 0.07F) {
  return {Texture::kFoliage, colour, 0.35F * colour, leaf_m, 0.9F, 1.0F};
}
/// Polished metal or dark gloss: the depth camera sees it in part.
inline Material gloss(const Colour& colour, float infrared_return = 0.75F) {
  return {Texture::kPlain, colour, 0.5F * colour, 0.5F, 0.25F, infrared_return};
}
/// A window pane with a blurred outdoors behind it.
inline Material glass(const Colour& sky) { return {Texture::kFoliage, sky, {0.4F, 0.5F, 0.38F}, 0.8F, 0.35F, 0.1F}; }

}  // namespace foothold::synthetic_detail
