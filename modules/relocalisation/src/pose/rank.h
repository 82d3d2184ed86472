// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Points of the whole scene, and what they say about poses.
#pragma once

#include <cstdint>

#include "foothold/base/array.h"

namespace foothold {

/// Points that are drawn (T); candidates are ranked by the first kRankingPoints (T) of them.
inline constexpr int kRememberedPoints = 8192;
inline constexpr int kRankingPoints = 2048;

/// A point drawn from all that the leaves remember.
struct RememberedPoint {
  float point_scene[3];  ///< [m]
  std::uint8_t rgb[3];
  std::uint8_t valid;
};
static_assert(sizeof(RememberedPoint) == 16, "lives in device memory");

inline constexpr float kAgreementPrior = 20.0F;  ///< (T) points in view added to those there are: a few prove nothing

/// What remembered points say about a pose: counts of those that project to a pixel with depth.
struct SceneEvidence {
  float num_in_view;
  float num_contradicted;  ///< the camera sees through them
  float num_alike;         ///< at the measured depth, and of the measured colour

  FOOTHOLD_HD float contradicted_fraction() const { return num_contradicted / (num_in_view + kAgreementPrior); }
  FOOTHOLD_HD float alike_fraction() const { return num_alike / (num_in_view + kAgreementPrior); }
};
static_assert(sizeof(SceneEvidence) == 12, "lives in device memory");

/// What all remembered points say about the best pose, once it is aligned.
struct SceneAgreement {
  float agreeing_fraction;      ///< of the points in view, at the measured depth
  float contradicted_fraction;  ///< of the points in view, seen through
  float colour_correlation;     ///< of the grey values of agreeing points and their pixels; whatever the light
  float shifted_agreement;      ///< agreeing less contradicted fraction from where the camera is not, kShiftM away: the best of kNumShifts
  float rival_agreement;        ///< alike less contradicted fraction of the best candidate elsewhere; -1 without one
  std::int32_t valid;           ///< 0 if there was nothing to confront the pose with
};
static_assert(sizeof(SceneAgreement) == 24, "copied from the device");

/// How far a pose is shifted along the camera's axes, to and fro, to see how distinct the view is (T).
inline constexpr float kShiftM = 0.2F;
inline constexpr int kNumShifts = 6;

/// Owns all of it.
struct Ranking {
  Ranking(const Memory& memory, int num_points, int num_hypotheses)
      : points(memory, static_cast<std::size_t>(num_points)),
        evidence(memory, static_cast<std::size_t>(num_hypotheses)),
        shifted(memory, kNumShifts),
        agreement(memory, 1) {
    evidence.clear_to_zero();
    agreement.clear_to_zero();
  }

  Array<RememberedPoint> points;
  Array<SceneEvidence> evidence;              ///< per hypothesis; of no meaning for those that have failed
  Array<float> shifted;                       ///< agreeing less contradicted fraction of each shift
  Array<SceneAgreement> agreement;            ///< of the best pose
  const std::uint32_t* drawn_from = nullptr;  ///< counts of the reservoirs that the points were drawn from; nullptr for a new query
};

}  // namespace foothold
