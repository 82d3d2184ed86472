// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Drawing hypotheses: triples of pixels with one mode each that pass the paper's three checks. Reference: [Cavallari2017] Sec. 2.2.3.
#pragma once

#include <cstring>
#include <limits>

#include "foothold/base/random.h"
#include "foothold/base/span.h"
#include "pose/hypotheses.h"
#include "pose/kabsch.h"
#include "pose/pool.h"
#include "pose/search_plan.h"

namespace foothold {

inline constexpr int kMaxColourDifference = 30;   ///< (R) grey levels, in any channel, of a pixel to its mode
inline constexpr float kMinTripleSpreadM = 0.3F;  ///< (P) between two points of a triple

FOOTHOLD_HD inline Eigen::Vector3f point_of(const PooledPixel& pixel) {
  return {pixel.point_camera[0], pixel.point_camera[1], pixel.point_camera[2]};
}
FOOTHOLD_HD inline Eigen::Vector3f mean_of(const Mode& mode) { return {mode.mean_m[0], mode.mean_m[1], mode.mean_m[2]}; }

/// The largest difference over the channels [grey levels].
FOOTHOLD_HD inline int colour_difference(const std::uint8_t* a, const std::uint8_t* b) {
  int largest = 0;
  for (int k = 0; k < 3; ++k) {
    const int difference = a[k] > b[k] ? a[k] - b[k] : b[k] - a[k];
    largest = difference > largest ? difference : largest;
  }
  return largest;
}

/// Draws one hypothesis: lanes draw triples until one of them passes, and the first in the order of draws is taken, however many lanes
/// there are. The hypothesis' energy starts at zero, or at infinity if every draw failed.
template <class Executor>
struct DrawHypothesis {
  CorrespondencePoolView pool;
  SearchPlan plan;
  HypothesesView hypotheses;
  const std::int32_t* given_up;  ///< nullptr without a trial before

  FOOTHOLD_HD void operator()(const typename Executor::Team& team, std::size_t i) const {
    const std::uint32_t num_pixels = *pool.num_pixels;
    const bool is_hopeless = num_pixels < 3 || (given_up != nullptr && *given_up != 0);
    const int num_draws = is_hopeless ? 0 : plan.max_draws;
    const Random random(plan.seed, i);
    for (int first = 0; first < num_draws; first += team.size()) {
      const int draw = first + team.lane();
      Random sequence = random.ahead(static_cast<std::uint64_t>(draw));
      SE3 scene_from_camera;
      const bool passed = draw < num_draws && draw_triple(sequence, num_pixels, scene_from_camera);
      const int winner = team.lowest(passed ? draw : num_draws);
      if (winner == num_draws) continue;
      if (draw == winner) set(i, scene_from_camera, 0.0F);
      return;
    }
    if (team.lane() == 0) set(i, SE3{}, std::numeric_limits<float>::infinity());
  }

 private:
  FOOTHOLD_HD void set(std::size_t i, const SE3& scene_from_camera, float energy) const {
    hypotheses.poses[i] = scene_from_camera;
    hypotheses.energies[i] = energy;
  }

  FOOTHOLD_HD bool draw_triple(Random& random, std::uint32_t num_pixels, SE3& scene_from_camera) const {
    Eigen::Vector3f camera[3];
    Eigen::Vector3f scene[3];
    for (int k = 0; k < 3; ++k) {
      const PooledPixel& pixel = pool.pixels[random.below(num_pixels)];
      camera[k] = point_of(pixel);
      const Mode* mode = plan.scan_modes && k > 0 ? find_rigid_mode(random, pixel, camera, scene, k)
                                                  : pool.modes + pixel.first_mode + random.below(pixel.num_modes);
      if (mode == nullptr) return false;
      if (k == 0 && colour_difference(pixel.rgb, mode->rgb) > kMaxColourDifference) return false;  // check 1
      scene[k] = mean_of(*mode);
      if (!plan.scan_modes && !is_rigid_with(camera, scene, k)) return false;
    }
    return fit_rigid_to_triple(camera, scene, scene_from_camera);
  }

  /// Checks 2 and 3 of point k against the points before it: far enough apart, and as far apart in the scene as in the camera.
  FOOTHOLD_HD bool is_rigid_with(const Eigen::Vector3f* camera, const Eigen::Vector3f* scene, int k) const {
    for (int j = 0; j < k; ++j) {
      const float in_camera = (camera[k] - camera[j]).norm();
      const float in_scene = (scene[k] - scene[j]).norm();
      if (in_camera < kMinTripleSpreadM || in_scene < kMinTripleSpreadM) return false;
      if (std::fabs(in_camera - in_scene) > plan.max_rigidity_error_m) return false;
    }
    return true;
  }

  /// A mode of the pixel that passes checks 2 and 3, chosen evenly among all that do; nullptr if none does.
  FOOTHOLD_HD const Mode* find_rigid_mode(Random& random, const PooledPixel& pixel, const Eigen::Vector3f* camera, Eigen::Vector3f* scene,
                                          int k) const {
    for (int j = 0; j < k; ++j) {
      if ((camera[k] - camera[j]).norm() < kMinTripleSpreadM) return nullptr;
    }
    const Mode* chosen = nullptr;
    std::uint32_t num_rigid = 0;
    for (std::uint32_t m = 0; m < pixel.num_modes; ++m) {
      const Mode& mode = pool.modes[pixel.first_mode + m];
      scene[k] = mean_of(mode);
      if (!is_rigid_with(camera, scene, k)) continue;
      if (random.below(++num_rigid) == 0) chosen = &mode;
    }
    return chosen;
  }
};

/// Sort key of a hypothesis: its energy's bits order as the energy does, since energies are not negative.
struct MakeEnergyKey {
  HypothesesView hypotheses;
  bool first_time;
  FOOTHOLD_HD void operator()(std::size_t i) const {
    const std::uint32_t hypothesis = first_time ? static_cast<std::uint32_t>(i) : hypotheses.at(i);
    const float energy = hypotheses.energies[hypothesis];  // copied from memory, it would be loaded byte by byte
    std::uint32_t bits = 0;
    memcpy(&bits, &energy, sizeof(bits));
    hypotheses.order[i] = (static_cast<std::uint64_t>(bits) << 32U) | hypothesis;
  }
};

/// Whether poses are nearer to each other than both limits. |A - B|^2 = 8 sin^2(angle / 2), about 2 angle^2.
FOOTHOLD_HD inline bool is_same_pose(const SE3& a, const SE3& b, float distance_m, float angle_rad) {
  return (a.translation - b.translation).squaredNorm() < distance_m * distance_m &&
         (a.rotation - b.rotation).squaredNorm() < 2.0F * angle_rad * angle_rad;
}

/// Gives up if the best hypothesis' energy says that it explains next to nothing. @pre It was scored by kCullSamples.
struct GiveUpHopeless {
  CorrespondencePoolView pool;
  float truncation;
  HypothesesView hypotheses;
  std::int32_t* given_up;

  FOOTHOLD_HD void operator()(std::size_t) const {
    const std::uint32_t num_scored = *pool.num_pixels < kCullSamples ? *pool.num_pixels : kCullSamples;
    const float limit = kHopelessEnergy * truncation * static_cast<float>(num_scored);
    *given_up = hypotheses.energies[hypotheses.at(0)] > limit ? 1 : 0;
  }
};

/// Lets each hypothesis fail that is nearly the same as one before it, whatever became of that one: refined, both would become one.
struct DropRepeats {
  HypothesesView hypotheses;
  float distance_m;
  float angle_rad;

  FOOTHOLD_HD void operator()(std::size_t slot) const {
    const SE3& pose = hypotheses.pose_at(slot);
    for (std::size_t better = 0; better < slot; ++better) {
      if (!is_same_pose(hypotheses.pose_at(better), pose, distance_m, angle_rad)) continue;
      hypotheses.energies[hypotheses.at(slot)] = kFailedEnergy;
      return;
    }
  }
};

/// Orders the first slots by rising energy.
template <class Executor>
void sort_by_energy(const Executor& executor, std::size_t num_slots, Hypotheses& hypotheses) {
  executor.for_each(num_slots, MakeEnergyKey{hypotheses.view(), false});
  executor.sort(Span<std::uint64_t>(hypotheses.order.data(), num_slots), hypotheses.sort_buffer, 32, 64);
}

/// Draws hypotheses, whose order is that of their numbers, but for those that failed, which come last.
/// @param given_up  If not nullptr and not 0, all of them fail.
template <class Executor>
void draw_hypotheses(const Executor& executor, const CorrespondencePoolView& pool, const SearchPlan& plan, const std::int32_t* given_up,
                     Hypotheses& hypotheses) {
  const auto num_hypotheses = static_cast<std::size_t>(plan.num_hypotheses);
  executor.for_each_team(num_hypotheses, DrawHypothesis<Executor>{pool, plan, hypotheses.view(), given_up});
  executor.for_each(num_hypotheses, MakeEnergyKey{hypotheses.view(), true});
  executor.sort(Span<std::uint64_t>(hypotheses.order), hypotheses.sort_buffer, 32, 64);
}

/// Whether a search may end early: where asking costs nothing. Elsewhere what is left of it runs, and does nothing.
template <class Executor>
inline constexpr bool kStopsEarly = Executor::kDevice == Device::kCpu;

/// Whether the search was given up, where asking costs nothing; false elsewhere.
template <class Executor>
bool has_given_up(const Hypotheses& hypotheses) {
  if constexpr (kStopsEarly<Executor>) return *hypotheses.given_up.data() != 0;
  return false;
}

/// How many of the first slots hold hypotheses that have not failed, where asking costs nothing; all of them elsewhere.
/// @pre They are sorted by energy.
template <class Executor>
std::size_t num_alive(const HypothesesView& hypotheses, std::size_t num_slots) {
  if constexpr (kStopsEarly<Executor>) {
    while (num_slots > 0 && hypotheses.has_failed(num_slots - 1)) --num_slots;
  }
  return num_slots;
}

}  // namespace foothold
