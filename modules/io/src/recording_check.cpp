// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/recording_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "depth_statistics.h"
#include "foothold/base/error.h"
#include "foothold/base/number_text.h"
#include "image_header.h"
#include "near_miss.h"
#include "pose_check.h"
#include "text_file.h"

namespace foothold {
namespace {

using io::FramePair;

constexpr int kNumAnchors = 6;
/// Two frames of a pair are as far apart as this, or as many frames: depth that is a quarter too large then shows clearly.
constexpr float kPairMotion_m = 0.3F;
constexpr float kPairMotion_rad = 0.27F;
constexpr int kMinPairFrames = 3;
constexpr int kMaxPairFrames = 60;
/// Right poses of real recordings agree for most of the points: other readings are not even tried.
constexpr double kGoodAgreement = 0.9;
/// Nothing can fit far better than this.
constexpr double kPerfectAgreement = 0.97;
/// Fewer points that should be seen in the other frame say little.
constexpr double kLeastSeen = 0.3;
/// Other readings are worth a word only if they agree so well. Of units, one that is a third off still agrees for two thirds.
constexpr double kLeastOfUnit = 0.8;
constexpr double kLeastOfConvention = 0.6;
/// Units of depth that people use, per metre, likelier ones first.
constexpr std::array<double, 11> kDepthUnitsPerM{1000.0, 5000.0, 10000.0, 4000.0, 100.0, 1.0, 256.0, 6553.5, 2000.0, 8000.0, 500.0};
/// A hand-held camera moves at least so far between frames [m], if a smaller unit of positions is worth trying.
constexpr double kLeastMotion_m = 0.0005;
/// Another reading fits far better if it leaves less than this part of the disagreement, and fits better by this much.
constexpr double kByFar = 0.5;
constexpr double kLeastGain = 0.1;
/// Poses of which no reading fits are worth a word below this.
constexpr double kDoubtfulAgreement = 0.5;
constexpr double kHardlySeen = 0.1;
/// Recordings with less depth than this are hardly worth the name.
constexpr double kLeastValidFraction = 0.05;

/// Depth in longer steps [m] tells nothing about poses.
constexpr double kCoarseStep_m = 0.05;

bool is_coarse(const RecordingFacts& facts) { return !facts.depth_is_continuous && 1.0 / facts.depth_units_per_m > kCoarseStep_m; }

std::string percent(double fraction) { return std::to_string(std::lround(100.0 * fraction)) + " %"; }

std::string metres(double distance_m) { return general_text(distance_m, 3) + " m"; }

/// The depth of a frame; empty if it cannot be read, which is noted.
std::shared_ptr<const Image<float>> try_depth(const Recording& recording, int index, RecordingCheck& check) {
  try {
    return std::make_shared<Image<float>>(recording.load_depth(index));
  } catch (const FileError& error) {
    if (check.num_unreadable++ == 0) check.first_error = error.what();
    return std::make_shared<Image<float>>();
  }
}

io::RecordedPose in_own_frame(const SE3& pose, const Eigen::Vector3d& origin_m) {
  return {pose.rotation.cast<double>(), pose.translation.cast<double>() + origin_m};
}

/// A frame some motion after another, in units of positions; -1 if no later one has a pose.
int partner_of(int anchor, const std::vector<std::optional<SE3>>& poses, double metres_per_unit) {
  const float motion = kPairMotion_m / static_cast<float>(metres_per_unit);
  int partner = -1;
  const int end = std::min(static_cast<int>(poses.size()), anchor + kMaxPairFrames + 1);
  for (int i = anchor + 1; i < end; ++i) {
    const auto& pose = poses[static_cast<std::size_t>(i)];
    if (!pose.has_value()) continue;
    partner = i;
    const SE3& first = *poses[static_cast<std::size_t>(anchor)];
    const bool moved = translation_distance_m(first, *pose) > motion || rotation_distance_rad(first, *pose) > kPairMotion_rad;
    if (moved && i >= anchor + kMinPairFrames) break;
  }
  return partner;
}

/// Frames with a pose and their partners, spread over the recording.
struct Pairs {
  std::vector<FramePair> frames;
  double motion_m = 0.0;  ///< between consecutive frames, on average
};

Pairs collect_pairs(const Recording& recording, double metres_per_unit, io::DepthStatistics& statistics, RecordingCheck& check) {
  const auto& poses = recording.facts().world_from_camera;
  Pairs pairs;
  double path_m = 0.0;
  int num_steps = 0;
  for (int i = 0; i < kNumAnchors; ++i) {
    const int anchor = static_cast<int>(static_cast<std::size_t>(i) * poses.size() / kNumAnchors);
    const bool has_pose = poses[static_cast<std::size_t>(anchor)].has_value();
    const int partner = has_pose ? partner_of(anchor, poses, metres_per_unit) : -1;
    FramePair pair{nullptr, nullptr, {}, {}, anchor, partner};
    pair.depth_a = try_depth(recording, anchor, check);
    statistics.add(*pair.depth_a);
    if (partner < 0) continue;
    pair.depth_b = try_depth(recording, partner, check);
    statistics.add(*pair.depth_b);
    if (pair.depth_a->empty() || pair.depth_b->empty()) continue;
    pair.world_from_a = in_own_frame(*poses[static_cast<std::size_t>(anchor)], recording.origin_m());
    pair.world_from_b = in_own_frame(*poses[static_cast<std::size_t>(partner)], recording.origin_m());
    path_m += (pair.world_from_b.translation_m - pair.world_from_a.translation_m).norm();
    num_steps += partner - anchor;
    pairs.frames.push_back(std::move(pair));
  }
  if (num_steps > 0) pairs.motion_m = path_m / num_steps;
  return pairs;
}

/// What else might be meant: other conventions whose positions are of a sensible size, and units in which depth is that of a room.
std::vector<io::Reading> other_readings(const RecordingFacts& facts, double motion_m, double median_depth_m) {
  std::vector<io::Reading> readings;
  for (const io::Reading& reading : io::other_conventions()) {
    const double metres_per_unit = reading.convention.metres_per_unit;
    if (metres_per_unit == 1.0 || motion_m * metres_per_unit >= kLeastMotion_m) readings.push_back(reading);
  }
  for (const double units_per_m : kDepthUnitsPerM) {
    const double factor = facts.depth_units_per_m / units_per_m;
    const bool is_room = median_depth_m * factor >= kLeastMedianDepth_m && median_depth_m * factor <= kMostMedianDepth_m;
    if (factor != 1.0 && is_room) readings.push_back({{}, factor});
  }
  return readings;
}

/// How well a reading with smaller units of positions fits pairs that are as far apart in these units as others are in metres: so near that
/// their positions hardly count, anything fits.
io::Agreement agreement_from_afar(const Recording& recording, const io::Reading& reading) {
  io::DepthStatistics unused_statistics;
  RecordingCheck unused_check;
  const Pairs pairs = collect_pairs(recording, reading.convention.metres_per_unit, unused_statistics, unused_check);
  return io::pose_agreement(pairs.frames, recording.facts().calibration.depth, reading);
}

void check_near_misses(const Recording& recording, const Pairs& pairs, RecordingCheck& check) {
  std::vector<std::optional<io::RecordedPose>> poses;
  for (const auto& pose : recording.facts().world_from_camera) {
    poses.push_back(pose.has_value() ? std::optional(in_own_frame(*pose, recording.origin_m())) : std::nullopt);
  }
  const auto miss = io::find_near_miss(pairs.frames, recording.facts().calibration.depth, poses);
  if (!miss.has_value()) return;
  check.better_otherwise = describe(*miss, recording.facts().calibration.depth);
  check.better_agreement = miss->agreement.fraction;
}

void check_poses(const Recording& recording, const Pairs& pairs, RecordingCheck& check) {
  constexpr double kTie = 0.002;  // the likelier reading wins
  check.num_pose_pairs = static_cast<int>(pairs.frames.size());
  if (pairs.frames.empty()) return;
  const RecordingFacts& facts = recording.facts();
  const Intrinsics& camera = facts.calibration.depth;
  const io::Agreement as_read = io::pose_agreement(pairs.frames, camera, {});
  check.pose_agreement = as_read.seen >= kHardlySeen ? as_read.fraction : 0.0;
  if (as_read.fraction >= kGoodAgreement && as_read.seen >= kLeastSeen) {
    const auto score = [&](double depth_factor) { return io::pose_agreement(pairs.frames, camera, {{}, depth_factor}).score; };
    check.poses_fit = as_read.score > std::max(score(0.5), score(2.0)) + kLeastGain;
    if (as_read.fraction < kPerfectAgreement) check_near_misses(recording, pairs, check);
    return;
  }
  if (is_coarse(facts)) return;
  io::Reading best;
  io::Agreement best_agreement;
  for (const io::Reading& reading : other_readings(facts, pairs.motion_m, check.median_depth_m)) {
    const io::Agreement agreement = io::pose_agreement(pairs.frames, camera, reading);
    if (agreement.score <= best_agreement.score + kTie) continue;
    best_agreement = agreement;
    best = reading;
  }
  const double least = best.depth_factor != 1.0 ? kLeastOfUnit : kLeastOfConvention;
  const bool by_far = best_agreement.fraction >= least && 1.0 - best_agreement.fraction < kByFar * (1.0 - check.pose_agreement) &&
                      best_agreement.score > as_read.score + kLeastGain;
  if (!by_far) return check_near_misses(recording, pairs, check);
  if (best.convention.metres_per_unit != 1.0) best_agreement = agreement_from_afar(recording, best);
  if (best_agreement.fraction < least) return;
  check.better_agreement = best_agreement.fraction;
  if (best.depth_factor != 1.0) check.better_depth_units_per_m = facts.depth_units_per_m / best.depth_factor;
  if (best.convention != io::PoseConvention{}) check.better_convention = to_string(best.convention);
}

std::string depth_text(const RecordingFacts& facts, const RecordingCheck& check) {
  return "median depth " + metres(check.median_depth_m) + ", " + percent(check.within_fraction) + " of it between " +
         metres(kLeastMedianDepth_m) + " and " + metres(kMostMedianDepth_m) + ", if it counts " + depth_unit_text(facts) + " (" +
         facts.depth_unit_source + ")";
}

/// A unit that people use, under which the median would be that of a room; 0 if there is none.
double plausible_unit(const RecordingFacts& facts, double median_depth_m) {
  constexpr double kTypical_m = 2.0;
  double best = 0.0;
  double best_ratio = 2.5;  // of the median to that of a typical room, or inverse
  for (const double units_per_m : kDepthUnitsPerM) {
    const double median_m = median_depth_m * facts.depth_units_per_m / units_per_m;
    const double ratio = std::max(median_m / kTypical_m, kTypical_m / median_m);
    if (ratio >= best_ratio) continue;
    best = units_per_m;
    best_ratio = ratio;
  }
  return best;
}

std::string try_unit(double units_per_m, double median_m) {
  return "; with --depth-scale " + io::numbers_text(&units_per_m, 1) + " it would be " + metres(median_m);
}

bool is_unlikely(const RecordingCheck& check) {
  return check.median_depth_m < kLeastMedianDepth_m || check.median_depth_m > kMostMedianDepth_m;
}

void warn_of_depth(const RecordingFacts& facts, RecordingCheck& check) {
  const std::string subject = facts.folder + ": ";
  if (check.num_depth_frames > 0 && check.valid_fraction < kLeastValidFraction) {
    check.warnings.push_back(subject + "only " + percent(check.valid_fraction) + " of the pixels of the " +
                             std::to_string(check.num_depth_frames) + " frames looked at have depth");
  }
  if (check.valid_fraction == 0.0) return;
  if (is_coarse(facts)) {
    check.warnings.push_back(subject + "depth comes in steps of " + metres(1.0 / facts.depth_units_per_m) + " (" + facts.depth_unit_source +
                             "), too coarse to follow or find a camera by");
  }
  const bool unlikely = is_unlikely(check);
  double unit = check.better_depth_units_per_m;
  if (unit == 0.0 && unlikely && !check.poses_fit) unit = plausible_unit(facts, check.median_depth_m);
  if (!unlikely && unit == 0.0) return;
  std::string text = subject + "the unit of depth" + (check.better_depth_units_per_m != 0.0 ? ", or that of positions," : "") +
                     " looks wrong: " + depth_text(facts, check);
  if (check.poses_fit) text += "; yet its poses fit";
  if (unit != 0.0) text += try_unit(unit, check.median_depth_m * facts.depth_units_per_m / unit);
  if (check.better_depth_units_per_m != 0.0) {
    text += ", and " + percent(check.better_agreement) + " instead of " + percent(check.pose_agreement) +
            " of the depth would agree between frames, by their poses";
  }
  check.warnings.push_back(text);
}

void warn_of_poses(const RecordingFacts& facts, RecordingCheck& check) {
  if (check.num_pose_pairs == 0 || is_coarse(facts) || is_unlikely(check) || check.better_depth_units_per_m != 0.0) return;
  const std::string subject =
      facts.folder + ": only " + percent(check.pose_agreement) + " of the depth agrees between frames, by their poses";
  if (!check.better_convention.empty() && facts.pose_convention == "as-is") {
    check.warnings.push_back(subject + "; " + percent(check.better_agreement) + " would with --pose-convention " + check.better_convention);
  } else if (!check.better_otherwise.empty()) {
    check.warnings.push_back(subject + "; " + percent(check.better_agreement) + " would " + check.better_otherwise);
  } else if (check.pose_agreement < kDoubtfulAgreement) {
    const std::string convention = facts.pose_convention == "as-is" ? "" : " (read as " + facts.pose_convention + ")";
    check.warnings.push_back(subject + convention + "; convention of poses, intrinsics or unit of depth may be wrong");
  }
}

}  // namespace

RecordingCheck check_recording(const Recording& recording) {
  RecordingCheck check;
  io::DepthStatistics statistics;
  const Pairs pairs = collect_pairs(recording, 1.0, statistics, check);
  statistics.finish(check);
  check_poses(recording, pairs, check);
  warn_of_depth(recording.facts(), check);
  warn_of_poses(recording.facts(), check);
  return check;
}

}  // namespace foothold
