// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <string>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "foothold/evaluation/kidnap.h"

namespace foothold {
namespace {

enum RandomStream : std::uint64_t { kOrder = 1, kPlace = 2, kTarget = 3 };

void check(const char* field, int value, int low) {
  if (value >= low) return;
  throw InvalidSettings("kidnaps: " + std::string(field) + " is " + std::to_string(value) + ", expected " + std::to_string(low) +
                        " or more");
}

/// Uniform in [low, high]. @pre low <= high
int between(Random& random, int low, int high) { return low + static_cast<int>(random.below(static_cast<std::uint32_t>(high - low + 1))); }

int teleport_gap(int num_frames, const KidnapOptions& options) { return std::min(options.teleport_gap, std::max(1, num_frames / 4)); }

/// The earliest frame at which a kidnap of a kind may begin.
int earliest(KidnapKind kind, int num_frames, const KidnapOptions& options) {
  const int first = std::max(1, std::min(options.num_first, num_frames / 4));
  return kind == KidnapKind::kTeleport ? std::max(first, teleport_gap(num_frames, options) + options.num_judged) : first;
}

/// Frames of the recording that a kidnap takes up, the judged ones included.
int extent(KidnapKind kind, const KidnapOptions& options) {
  const int left_out = kind == KidnapKind::kRemoved    ? options.removed_length
                       : kind == KidnapKind::kBlackout ? options.blackout_length
                       : kind == KidnapKind::kLeap     ? options.leap_gap
                                                       : 0;
  return left_out + options.num_judged;
}

Kidnap kidnap_at(KidnapKind kind, int from, int num_frames, const KidnapOptions& options, Random& random) {
  switch (kind) {
    case KidnapKind::kRemoved:
      return {kind, from, 0, from + options.removed_length};
    case KidnapKind::kBlackout:
      return {kind, from, options.blackout_length, from + options.blackout_length};
    case KidnapKind::kLeap:
      return {kind, from, 0, between(random, from + options.leap_gap, num_frames - options.num_judged)};
    case KidnapKind::kTeleport:
    case KidnapKind::kReturn:
      break;
  }
  return {kind, from, 0, between(random, 0, std::max(0, from - teleport_gap(num_frames, options) - options.num_judged))};
}

std::vector<KidnapKind> kinds_of(const KidnapOptions& options) {
  std::vector<KidnapKind> kinds(static_cast<std::size_t>(options.num_removed), KidnapKind::kRemoved);
  kinds.insert(kinds.end(), static_cast<std::size_t>(options.num_teleports), KidnapKind::kTeleport);
  kinds.insert(kinds.end(), static_cast<std::size_t>(options.num_blackouts), KidnapKind::kBlackout);
  return kinds;
}

[[noreturn]] void throw_too_short(const std::string& what, int num_frames, int num_needed) {
  throw InvalidSettings(what + " in a recording of " + std::to_string(num_frames) + " frames: expected at least " +
                        std::to_string(num_needed) + "; ask for fewer or shorter ones, or for independent ones");
}

/// Adds a kidnap to a plan with the covered frames and, unless it is a teleport's return, those by which it is judged.
void add_break(const Kidnap& kidnap, KidnapPlan& plan) {
  for (int i = 0; i < kidnap.num_covered; ++i) plan.steps.push_back({kidnap.from + i, true, -1});
  plan.kidnaps.push_back(kidnap);
}

}  // namespace

const char* to_string(KidnapKind kind) {
  switch (kind) {
    case KidnapKind::kRemoved:
      return "removed";
    case KidnapKind::kTeleport:
      return "teleport";
    case KidnapKind::kReturn:
      return "return";
    case KidnapKind::kBlackout:
      return "blackout";
    case KidnapKind::kLeap:
      return "leap";
  }
  return "?";
}

void KidnapOptions::validate() const {
  check("num_removed", num_removed, 0);
  check("removed_length", removed_length, 1);
  check("num_teleports", num_teleports, 0);
  check("teleport_gap", teleport_gap, 1);
  check("num_blackouts", num_blackouts, 0);
  check("blackout_length", blackout_length, 1);
  check("num_leaps", num_leaps, 0);
  check("leap_gap", leap_gap, 1);
  check("num_judged", num_judged, 1);
  check("num_first", num_first, 1);
}

KidnapPlan plan_sequential_kidnaps(int num_frames, const KidnapOptions& options) {
  options.validate();
  if (options.num_leaps > 0) {
    throw InvalidSettings("kidnaps: num_leaps is " + std::to_string(options.num_leaps) + ", expected 0 unless each kidnap is independent");
  }
  std::vector<KidnapKind> kinds = kinds_of(options);
  Random order(options.seed, kOrder);
  for (std::size_t i = kinds.size(); i > 1; --i) std::swap(kinds[i - 1], kinds[order.below(static_cast<std::uint32_t>(i))]);

  int first = std::max(1, std::min(options.num_first, num_frames / 4));
  int num_taken = 0;
  for (const KidnapKind kind : kinds) {
    first = std::max(first, earliest(kind, num_frames, options));
    num_taken += extent(kind, options);
  }
  const int num_spare = num_frames - first - num_taken;
  if (num_spare < 0) throw_too_short(std::to_string(kinds.size()) + " kidnaps", num_frames, first + num_taken);
  Random place(options.seed, kPlace);
  std::vector<int> spare_before;  // of the frames that no kidnap needs, those before each
  for (std::size_t i = 0; i < kinds.size(); ++i) spare_before.push_back(between(place, 0, num_spare));
  std::sort(spare_before.begin(), spare_before.end());

  KidnapPlan plan;
  Random target(options.seed, kTarget);
  int next = 0;          // frame of the recording
  int num_before = 0;    // frames that the kidnaps so far took up
  int judged_from = -1;  // kidnap whose first judged frame comes next
  const auto play_until = [&](int end) {
    for (; next < end; ++next) {
      plan.steps.push_back({next, false, judged_from});
      judged_from = -1;
    }
  };
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const int from = first + spare_before[i] + num_before;
    num_before += extent(kinds[i], options);
    play_until(from);
    const Kidnap kidnap = kidnap_at(kinds[i], from, num_frames, options, target);
    add_break(kidnap, plan);
    judged_from = static_cast<int>(plan.kidnaps.size()) - 1;
    next = kidnap.to;
    if (kidnap.kind != KidnapKind::kTeleport) continue;
    play_until(kidnap.to + options.num_judged);
    add_break({KidnapKind::kReturn, next, 0, from}, plan);
    judged_from = static_cast<int>(plan.kidnaps.size()) - 1;
    next = from;
  }
  play_until(num_frames);
  return plan;
}

std::vector<Kidnap> plan_independent_kidnaps(int num_frames, const KidnapOptions& options) {
  options.validate();
  std::vector<Kidnap> kidnaps;
  Random place(options.seed, kPlace);
  Random target(options.seed, kTarget);
  const auto spread = [&](KidnapKind kind, int num_kidnaps) {
    const int first = earliest(kind, num_frames, options);
    const int last = num_frames - extent(kind, options);  // a teleport's judged frames need no room here, but one frame must remain
    if (num_kidnaps > 0 && last < first) {
      throw_too_short(std::string("a kidnap of kind '") + to_string(kind) + "'", num_frames, first + extent(kind, options));
    }
    for (int i = 0; i < num_kidnaps; ++i) {  // one in each equal part
      const float part = (static_cast<float>(i) + place.uniform()) / static_cast<float>(num_kidnaps);
      kidnaps.push_back(
          kidnap_at(kind, first + static_cast<int>(part * static_cast<float>(last - first + 1)), num_frames, options, target));
    }
  };
  spread(KidnapKind::kRemoved, options.num_removed);
  spread(KidnapKind::kTeleport, options.num_teleports);
  spread(KidnapKind::kBlackout, options.num_blackouts);
  spread(KidnapKind::kLeap, options.num_leaps);
  std::stable_sort(kidnaps.begin(), kidnaps.end(), [](const Kidnap& a, const Kidnap& b) { return a.from < b.from; });
  return kidnaps;
}

std::vector<PlayStep> independent_steps(const Kidnap& kidnap, int num_frames, const KidnapOptions& options) {
  FOOTHOLD_EXPECTS(kidnap.to >= 0 && kidnap.to < num_frames);
  std::vector<PlayStep> steps;
  for (int i = 0; i < kidnap.num_covered; ++i) steps.push_back({kidnap.from + i, true, -1});
  for (int i = 0; i < options.num_judged && kidnap.to + i < num_frames; ++i) steps.push_back({kidnap.to + i, false, i == 0 ? 0 : -1});
  if (kidnap.kind != KidnapKind::kLeap) return steps;
  for (int frame = std::max(0, kidnap.from - options.num_judged); frame < kidnap.from; ++frame) steps.push_back({frame, false, -1});
  return steps;
}

}  // namespace foothold
