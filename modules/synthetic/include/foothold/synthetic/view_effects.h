// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What spoils a view: other light, motion, missing depth, somebody in the way. For rendered frames and for recorded ones.
#pragma once

#include <cstdint>

#include "foothold/api/frame.h"
#include "foothold/base/settings.h"

namespace foothold {

/// What happens to frames on top of what the sensor does. The defaults change nothing.
struct ViewEffects {
  float exposure = 1.0F;  ///< factor on brightness
  float gamma = 1.0F;     ///< exponent on brightness in [0, 1]; above 1 darkens middle tones
  float warmth = 0.0F;    ///< red grows by this share, blue shrinks by it
  float blur_px = 0.0F;   ///< length of the smear at a width of 640, in a direction of each frame's own
  float holes = 0.0F;     ///< share of the image without depth, in patches
  float person = 0.0F;    ///< share of the image that somebody standing before the camera covers, about; clothes differ with the seed

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ViewEffects::exposure, "exposure", "Factor on brightness.", Range{0.01, 100});
    v(&ViewEffects::gamma, "gamma", "Exponent on brightness.", Range{0.1, 10});
    v(&ViewEffects::warmth, "warmth", "Share by which red grows and blue shrinks.", Range{-1, 1});
    v(&ViewEffects::blur_px, "blur_px", "Length of motion blur [px at a width of 640].", Range{0, 200});
    v(&ViewEffects::holes, "holes", "Share of the image without depth.", Range{0, 1});
    v(&ViewEffects::person, "person", "Share of the image that a person covers.", Range{0, 0.8});
  }
};

/// Applies the effects to a frame: first the person, then blur, light and holes.
///
/// @param seed  Equal seeds and frame indices give equal results; holes and blur are independent from frame to frame, the person moves
///              smoothly along frame.index.
/// Determinism: a function of its arguments.
void apply_effects(const ViewEffects& effects, std::uint64_t seed, RgbdFrame& frame);

}  // namespace foothold
