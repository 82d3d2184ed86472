// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/learning/forest_training.h"

#include <algorithm>
#include <filesystem>
#include <locale>
#include <sstream>
#include <utility>

#include "foothold/base/checksum.h"
#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "forest_checkpoint.h"
#include "forest_example_collector.h"
#include "forest_examples.h"
#include "forest_grower.h"

namespace foothold {
namespace {

/// Raise it when the same settings and sequences give another forest than before.
constexpr int kTrainerVersion = 1;

/// What frames, the views that pairs are looked for in, and the search for splits take besides the examples.
constexpr double kFixedBytes = 0.15e9;

using Sequences = std::vector<std::shared_ptr<const Sequence>>;
using Stage = ForestTrainingProgress::Stage;

std::int64_t frames_of(const Sequence& sequence, const ForestTrainingSettings& settings) {
  return (sequence.num_frames() + settings.frame_stride - 1) / settings.frame_stride;
}

std::int64_t frames_of(const Sequences& sequences, const ForestTrainingSettings& settings) {
  std::int64_t sum = 0;
  for (const auto& sequence : sequences) sum += frames_of(*sequence, settings);
  return sum;
}

/// Memory that one example takes in all [bytes].
double bytes_per_example(const ForestExamples& examples, const ForestTrainingSettings& settings) {
  // The searches' own lists: half of a node's examples are copied when it is partitioned, in one node per thread, at worst in all trees at
  // once.
  constexpr double kPartition = 1.5;
  const auto in_trees = static_cast<double>(settings.tree_fraction) * settings.num_trees * ForestGrower::kBytesPerExample;
  return static_cast<double>(sizeof(Eigen::Vector3f) + examples.row_size() * sizeof(std::int16_t)) + kPartition * in_trees;
}

/// Examples a frame, so many as the memory limit allows. @throws InvalidSettings if that is none.
int affordable_examples_per_frame(const Context& context, std::int64_t num_views, const ForestExamples& examples,
                                  const ForestTrainingSettings& settings) {
  constexpr double kBytesPerGigabyte = 1e9;
  const double budget = static_cast<double>(settings.memory_limit_gb) * kBytesPerGigabyte - kFixedBytes;
  const double affordable = std::min(budget / bytes_per_example(examples, settings), 4e9) / static_cast<double>(num_views);
  if (affordable < 1.0) {
    throw InvalidSettings("setting memory_limit_gb: got " + detail::to_text(settings.memory_limit_gb) + ", too little for " +
                          std::to_string(num_views) + " frames and rolled copies; raise it or frame_stride");
  }
  if (affordable >= settings.examples_per_frame) return settings.examples_per_frame;
  const int result = static_cast<int>(affordable);
  context.log(LogLevel::kWarning, "the memory limit allows " + std::to_string(result) + " examples a frame instead of " +
                                      std::to_string(settings.examples_per_frame));
  return result;
}

std::string describe(const Sequences& sequences, const ForestTrainingSettings& settings) {
  std::ostringstream text;
  text << "forest trained offline, trainer version " << kTrainerVersion;
  for (const SettingDescription& setting : describe_settings(settings)) text << "\n" << setting.path << " = " << setting.value;
  for (const auto& sequence : sequences) text << "\nsequence = " << sequence->name() << ", " << sequence->num_frames() << " frames";
  return text.str();
}

std::uint64_t hash_of(const ForestExamples& examples) {
  const std::uint64_t hash = fnv1a(kFnvBasis, examples.points_world.data(), examples.points_world.size() * sizeof(Eigen::Vector3f));
  return fnv1a(hash, examples.values.data(), examples.values.size() * sizeof(std::int16_t));
}

/// One training, from its beginning or from a checkpoint.
class Training {
 public:
  Training(const Context& context, const Sequences& sequences, const ForestTrainingSettings& settings, const ForestTrainingRun& run)
      : context_(context),
        sequences_(sequences),
        settings_(settings),
        run_(run),
        features_(draw_training_features(settings)),
        description_(describe(sequences, settings)) {
    examples_.num_features = features_.size();
    examples_.paired = settings.agreement_weight > 0.0F;
    const std::int64_t num_views = frames_of(sequences, settings) * (1 + settings.rolled_copies);
    examples_per_frame_ = affordable_examples_per_frame(context, num_views, examples_, settings);
    const auto most_examples = static_cast<std::size_t>(num_views) * static_cast<std::size_t>(examples_per_frame_);
    examples_.points_world.reserve(most_examples);
    examples_.values.reserve(most_examples * examples_.row_size());
  }

  std::optional<Forest> train() {
    open_checkpoint();
    if (!collect()) return std::nullopt;
    return grow();
  }

 private:
  void open_checkpoint() {
    if (run_.checkpoint.empty()) return;
    const std::uint64_t name = fnv1a(kFnvBasis, description_.data(), description_.size());
    const bool exists = std::filesystem::exists(run_.checkpoint);
    checkpoint_ = run_.resume && exists ? ForestCheckpoint::resume(run_.checkpoint, name, examples_, levels_)
                                        : ForestCheckpoint::create(run_.checkpoint, name);
    if (num_scenes() > sequences_.size())
      throw FileError(run_.checkpoint + ": holds " + std::to_string(num_scenes()) + " scenes, expected at most " +
                      std::to_string(sequences_.size()));
  }

  bool report(Stage stage, std::int64_t done, std::int64_t total) const { return !run_.progress || run_.progress({stage, done, total}); }

  bool collect() {
    const std::int64_t total = frames_of(sequences_, settings_);
    std::int64_t done = 0;
    for (std::size_t i = 0; i < num_scenes(); ++i) done += frames_of(*sequences_[i], settings_);
    if (!report(Stage::kExamples, done, total)) return false;
    ForestExampleCollector collector(context_, settings_, features_, examples_per_frame_);
    while (num_scenes() < sequences_.size()) {
      const Sequence& sequence = *sequences_[num_scenes()];
      const std::size_t size_before = examples_.size();
      const auto frame_done = [&] { return report(Stage::kExamples, ++done, total); };
      if (!collector.collect(sequence, num_scenes(), frame_done, examples_)) return false;
      if (examples_.size() == size_before)
        throw FileError(sequence.name() + ": has nothing to learn from; expected frames with a known pose and valid depth");
      checkpoint_.add_scene(examples_);
    }
    return true;
  }

  std::optional<Forest> grow() {
    ForestGrower grower(context_, examples_, settings_);
    for (const ForestLevel& level : levels_) {
      if (!grower.apply(level)) throw FileError(run_.checkpoint + ": damaged; its levels do not fit its examples");
    }
    while (!grower.is_complete()) {
      if (!report(Stage::kGrowing, grower.num_levels(), settings_.depth)) return std::nullopt;
      const ForestLevel level = grower.decide();
      checkpoint_.add_level(level);
      grower.apply(level);
    }
    report(Stage::kGrowing, settings_.depth, settings_.depth);
    std::ostringstream data;
    data.imbue(std::locale::classic());  // numbers without the host's grouping
    data << "\nexamples = " << examples_.size() << ", " << examples_per_frame_ << " a frame\ndata hash = " << std::hex
         << hash_of(examples_);
    for (const std::string& note : run_.notes) data << "\n" << note;
    return grower.forest(features_, description_ + data.str());
  }

  std::size_t num_scenes() const { return examples_.scene_begins.empty() ? 0 : examples_.scene_begins.size() - 1; }

  const Context& context_;
  const Sequences& sequences_;
  const ForestTrainingSettings& settings_;
  const ForestTrainingRun& run_;
  std::vector<ForestFeature> features_;
  std::string description_;
  int examples_per_frame_ = 0;
  ForestExamples examples_;
  std::vector<ForestLevel> levels_;
  ForestCheckpoint checkpoint_;
};

}  // namespace

void ForestTrainingSettings::validate() const {
  validate_settings(*this);
  if (max_offset_px_m < min_offset_px_m) {
    throw InvalidSettings("setting max_offset_px_m: got " + detail::to_text(max_offset_px_m) +
                          ", expected at least min_offset_px_m = " + detail::to_text(min_offset_px_m));
  }
  if (variance_weight <= 0.0F && agreement_weight <= 0.0F)
    throw InvalidSettings("settings variance_weight and agreement_weight: both are 0, expected at least one above");
}

std::optional<Forest> train_forest(const Context& context, const Sequences& sequences, const ForestTrainingSettings& settings,
                                   const ForestTrainingRun& run) {
  settings.validate();
  FOOTHOLD_EXPECTS(context.device() == Device::kCpu);
  if (sequences.empty()) throw InvalidSettings("no sequence to train a forest with; expected at least one");
  for (const auto& sequence : sequences) FOOTHOLD_EXPECTS(sequence != nullptr);
  return Training(context, sequences, settings, run).train();
}

}  // namespace foothold
