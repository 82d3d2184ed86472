// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trust_subjects.h"

#include <algorithm>
#include <set>

namespace foothold::benchmark {
namespace {

/// Rooms that no shipped forest has seen.
constexpr int kFirstTrainingRoom = 100;
/// A training path repeats after this many frames; only its beginning is learnt.
constexpr int kPathFrames = 1290;
constexpr int kNumAlike = 4;
constexpr float kAlikeSpacing_m = 9.0F;
constexpr float kAlikeDifference = 0.3F;

struct Change {
  const char* name;
  float moved;
  float removed;
  float added;
};
constexpr Change kChanges[] = {{"moved 10 %", 0.1F, 0.0F, 0.0F},
                               {"moved 30 %", 0.3F, 0.0F, 0.0F},
                               {"moved 50 %", 0.5F, 0.0F, 0.0F},
                               {"removed 30 %", 0.0F, 0.3F, 0.0F},
                               {"added 30 %", 0.0F, 0.0F, 0.3F}};

std::vector<int> spread(int count, int begin, int end) {
  std::vector<int> indices;
  for (int i = 0; i < count; ++i) indices.push_back(begin + static_cast<int>(static_cast<std::int64_t>(i) * (end - begin) / count));
  return indices;
}

SyntheticSequenceSettings room_settings(const std::string& room, const RoomViews& views) {
  SyntheticSequenceSettings settings;
  settings.room = room;
  settings.width = views.width;
  settings.height = views.height;
  return settings;
}

/// The beginning of the training path is learnt; half of the other views are of the test path beside it, half of the rest of the path.
void add_room(const std::string& room, const TrustAmounts& amounts, TrustSubject& subject, std::vector<ReadJob>& jobs) {
  static const std::set<std::string> repetitive = {"office", "stairs", "bookshelf", "corridor", "textureless"};
  const SyntheticSequenceSettings settings = room_settings(room, amounts.views);
  const int learnt_end = amounts.views.num_training * amounts.views.stride;
  const int num_beside = (amounts.num_own + 1) / 2;
  subject.name = room;
  subject.repeats_itself = repetitive.count(room) > 0;
  jobs.push_back({{path_input(settings, "train", spread(amounts.views.num_training, 0, learnt_end))}, &subject.training});
  jobs.push_back({{path_input(settings, "test", spread(num_beside, 0, learnt_end)),
                   path_input(settings, "train",
                              spread(std::max(1, amounts.num_own - num_beside), learnt_end, std::max(learnt_end + 1, kPathFrames)))},
                  &subject.own});
  for (const Change& change : kChanges) subject.changed.emplace_back(change.name, FrameList());
  for (std::size_t i = 0; i < std::size(kChanges); ++i) {
    SyntheticSequenceSettings changed = settings;
    changed.moved = kChanges[i].moved;
    changed.removed = kChanges[i].removed;
    changed.added = kChanges[i].added;
    jobs.push_back({{path_input(changed, "test", spread(amounts.num_spoilt, 0, learnt_end))}, &subject.changed[i].second});
  }
}

/// Several offices that differ in some furniture.
void add_alike_rooms(const TrustAmounts& amounts, TrustSubject& subject, std::vector<std::pair<FrameList, FrameList>>& parts,
                     std::vector<ReadJob>& jobs) {
  subject.name = "alike offices";
  subject.is_many_places = true;
  parts.resize(kNumAlike);
  SyntheticSequenceSettings settings = room_settings("office", amounts.views);
  settings.moved = settings.removed = settings.added = kAlikeDifference / 3.0F;
  const int learnt_end = amounts.views.num_training * amounts.views.stride;
  for (int i = 0; i < kNumAlike; ++i) {
    settings.change_seed = static_cast<std::uint64_t>(i);
    const Eigen::Vector2f field = grid_field(i).cast<float>() * kAlikeSpacing_m;
    const Eigen::Vector3f origin_world(field.x(), field.y(), 0.0F);
    auto& [training, tests] = parts[static_cast<std::size_t>(i)];
    jobs.push_back({{path_input(settings, "train", spread(amounts.views.num_training, 0, learnt_end))}, &training, origin_world});
    jobs.push_back({{path_input(settings, "test", spread(amounts.num_own, 0, learnt_end))}, &tests, origin_world});
  }
}

std::vector<std::string> room_names(const TrustAmounts& amounts) {
  const auto count = static_cast<std::size_t>(amounts.num_rooms);
  std::vector<std::string> names;
  if (amounts.first_room < 0) names = synthetic_room_names();
  if (names.size() > count) names.resize(count);
  const int first = amounts.first_room < 0 ? kFirstTrainingRoom : amounts.first_room;
  for (int k = 0; names.size() < count; ++k) names.push_back("training-" + std::to_string(first + k));
  return names;
}

}  // namespace

FrameList some_frames(const FrameList& frames, int count) {
  FrameList some;
  const int size = static_cast<int>(frames.size());
  for (const int i : spread(std::min(count, size), 0, size)) some.push_back(frames[static_cast<std::size_t>(i)]);
  return some;
}

std::vector<TrustSubject> load_subjects(const TrustAmounts& amounts, const std::vector<Scene>& recordings, int num_threads) {
  const std::vector<std::string> rooms = room_names(amounts);
  std::vector<TrustSubject> subjects(rooms.size() + recordings.size() + (rooms.empty() ? 0 : 1));
  std::vector<ReadJob> jobs;
  std::vector<std::pair<FrameList, FrameList>> alike;
  for (std::size_t i = 0; i < rooms.size(); ++i) add_room(rooms[i], amounts, subjects[i], jobs);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    TrustSubject& subject = subjects[rooms.size() + i];
    subject.name = recordings[i].name;
    jobs.push_back({recordings[i].training, &subject.training});
    jobs.push_back({recordings[i].tests, &subject.own});
  }
  if (!rooms.empty()) add_alike_rooms(amounts, subjects.back(), alike, jobs);
  read_all(jobs, num_threads);
  for (const auto& [training, tests] : alike) {
    subjects.back().training.insert(subjects.back().training.end(), training.begin(), training.end());
    subjects.back().own.insert(subjects.back().own.end(), tests.begin(), tests.end());
  }
  for (TrustSubject& subject : subjects) {
    if (!subject.is_many_places) subject.own = some_frames(subject.own, amounts.num_own);
  }
  return subjects;
}

}  // namespace foothold::benchmark
