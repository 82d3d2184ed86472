// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trust_questions.h"

#include <algorithm>

#include "foothold/base/random.h"
#include "foothold/evaluation/view_overlap.h"
#include "foothold/synthetic/turned_frame.h"
#include "foothold/synthetic/view_effects.h"

namespace foothold::benchmark {
namespace {

/// From this share of a view seen in training its place counts as learnt; below the second, as not learnt.
constexpr double kLearntShare = 0.5;
constexpr double kUnlearntShare = 0.1;

constexpr char kLearnt[] = "learnt part";
constexpr char kPartlyLearnt[] = "partly learnt";
constexpr char kUnlearnt[] = "unlearnt part";
constexpr char kUnlearntAlike[] = "unlearnt, alike";
constexpr char kAlikeRooms[] = "alike rooms, learnt";
constexpr char kMirrored[] = "mirrored";
constexpr char kStrangers[] = "another scene";
constexpr char kRolled[] = "rolled";

struct Effect {
  const char* kind;
  ViewEffects effects;
};

/// Strengths that people and cameras meet: dusk, a lamp, a swift turn, sunlight on half the scene, a colleague.
const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = [] {
    std::vector<Effect> list = {{"dark", {}}, {"bright", {}}, {"gamma", {}}, {"warm light", {}},
                                {"blur", {}}, {"holes", {}},  {"person", {}}};
    list[0].effects.exposure = 0.4F;
    list[1].effects.exposure = 1.8F;
    list[2].effects.gamma = 1.6F;
    list[3].effects.warmth = 0.3F;
    list[4].effects.blur_px = 21.0F;
    list[5].effects.holes = 0.5F;
    list[6].effects.person = 0.35F;
    return list;
  }();
  return all;
}

template <class Change>
FrameList changed_frames(const FrameList& frames, const Change& change) {
  FrameList result;
  for (std::size_t i = 0; i < frames.size(); ++i) result.push_back(std::make_shared<const RgbdFrame>(change(*frames[i], i)));
  return result;
}

/// Sorts a subject's views by how much of each was learnt.
void add_own(const TrustSubject& subject, std::vector<QuestionSet>& sets) {
  QuestionSet learnt{kLearnt, false, {}};
  QuestionSet partly{kPartlyLearnt, false, {}};
  QuestionSet unlearnt{subject.repeats_itself ? kUnlearntAlike : kUnlearnt, false, {}};
  for (const auto& frame : subject.own) {
    const double share = share_seen(*frame, subject.training);
    (share >= kLearntShare ? learnt : share >= kUnlearntShare ? partly : unlearnt).frames.push_back(frame);
  }
  for (QuestionSet& set : {std::ref(learnt), std::ref(partly), std::ref(unlearnt)}) sets.push_back(std::move(set));
}

/// The subject's own views, spoilt.
void add_spoilt(const FrameList& frames, std::uint64_t seed, std::vector<QuestionSet>& sets) {
  for (const Effect& effect : effects()) {
    sets.push_back({effect.kind, false, changed_frames(frames, [&](const RgbdFrame& frame, std::size_t i) {
                      RgbdFrame spoilt = frame;
                      apply_effects(effect.effects, derive_seed(seed, i), spoilt);
                      return spoilt;
                    })});
  }
  sets.push_back({kRolled, false, changed_frames(frames, [](const RgbdFrame& frame, std::size_t i) {
                    return turned_frame(frame, 1 + static_cast<int>(i % 3));
                  })});
}

/// Views of all other scenes, evenly chosen.
FrameList strangers(const std::vector<TrustSubject>& subjects, std::size_t map, int count) {
  FrameList all;
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (i != map && !subjects[i].is_many_places) all.insert(all.end(), subjects[i].own.begin(), subjects[i].own.end());
  }
  return some_frames(all, count);
}

}  // namespace

const std::vector<std::string>& question_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> list = {kLearnt, kPartlyLearnt};
    for (const Effect& effect : effects()) list.emplace_back(effect.kind);
    for (const char* kind : {kRolled, "moved 10 %", "moved 30 %", "moved 50 %", "removed 30 %", "added 30 %", kAlikeRooms, kUnlearnt,
                             kUnlearntAlike, kMirrored, kStrangers})
      list.emplace_back(kind);
    return list;
  }();
  return kinds;
}

std::vector<QuestionSet> questions_for(const std::vector<TrustSubject>& subjects, std::size_t map, const TrustAmounts& amounts,
                                       std::uint64_t seed) {
  const TrustSubject& subject = subjects[map];
  if (subject.is_many_places) return {{kAlikeRooms, false, subject.own}};
  std::vector<QuestionSet> sets;
  add_own(subject, sets);
  add_spoilt(some_frames(sets.front().frames, amounts.num_spoilt), derive_seed(seed, map), sets);
  for (const auto& [kind, frames] : subject.changed) sets.push_back({kind, false, frames});
  sets.push_back({kMirrored, true, changed_frames(subject.own, [](const RgbdFrame& frame, std::size_t) { return mirrored_frame(frame); })});
  sets.push_back({kStrangers, true, strangers(subjects, map, amounts.num_strangers)});
  sets.erase(std::remove_if(sets.begin(), sets.end(), [](const QuestionSet& set) { return set.frames.empty(); }), sets.end());
  return sets;
}

}  // namespace foothold::benchmark
