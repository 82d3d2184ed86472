// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/learning/quality_examples.h"

#include <algorithm>

#include "foothold/synthetic/synthetic_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

std::unique_ptr<Sequence> room(const char* spec) { return make_synthetic_sequence(parse_synthetic_spec(spec), Context()); }

/// Few, small steps: frames take longer to render than to try.
QualityExampleSettings few_examples() {
  QualityExampleSettings settings;
  settings.frame_stride = 5;
  settings.starts_per_frame = 6;
  settings.mined_starts = 1;
  settings.mined_from = 3;
  settings.view_stride = 20;
  settings.foreign_stride = 20;
  return settings;
}

TEST_CASE("collect_quality_examples: both kinds for both classifiers, labelled by the error of the result") {
  const auto office = room("synthetic:office?frames=40");
  const auto views = room("synthetic:office?frames=40&trajectory=test");
  const auto lounge = room("synthetic:lounge?frames=40");
  const QualityExampleSettings settings = few_examples();
  const QualityRecording recording{office.get(), views.get(), lounge.get(), 1};
  QualityExamples examples;
  int num_done = 0;
  collect_quality_examples(Context(), recording, {}, settings, examples, [&](int done) {
    REQUIRE(done == num_done + 1);
    num_done = done;
    return true;
  });
  REQUIRE(num_done == num_example_frames(recording, settings));
  const auto check = [&](const std::vector<ClassifierExample>& list, std::size_t num_values) {
    int num_right = 0;
    for (const ClassifierExample& example : list) {
      REQUIRE(example.values.size() == num_values);
      REQUIRE(example.group == 1);
      num_right += example.positive ? 1 : 0;
      if (!example.positive) continue;
      REQUIRE(example.distance_m < settings.right_m + settings.drift_m);
      REQUIRE(example.angle_deg < settings.right_deg + settings.drift_deg);
    }
    REQUIRE(num_right > 3);
    REQUIRE(static_cast<int>(list.size()) - num_right > 3);
  };
  check(examples.tracking, quality_feature_names().size());
  check(examples.acceptance, acceptance_feature_names().size());

  QualityExamples again;
  collect_quality_examples(Context(), recording, {}, settings, again);
  REQUIRE(again.acceptance.size() == examples.acceptance.size());
  for (std::size_t i = 0; i < again.acceptance.size(); ++i) REQUIRE(again.acceptance[i].values == examples.acceptance[i].values);
}

TEST_CASE("collect_quality_examples: right poses in half-mapped views are among the examples") {
  const auto office = room("synthetic:office?frames=40");
  const auto views = room("synthetic:office?frames=40&trajectory=test");
  QualityExampleSettings settings = few_examples();
  settings.try_stride = 1000;
  settings.spoilt_part = 0.0F;
  settings.view_stride = 4;
  settings.frame_stride = 4;
  const auto num_half_mapped = [&](int partial_maps) {
    settings.partial_maps = partial_maps;
    const QualityRecording recording{office.get(), views.get(), nullptr, 0};
    QualityExamples examples;
    int num_done = 0;
    collect_quality_examples(Context(), recording, {}, settings, examples, [&](int done) {
      num_done = done;
      return true;
    });
    REQUIRE(num_done == num_example_frames(recording, settings));
    return std::count_if(examples.acceptance.begin(), examples.acceptance.end(), [](const ClassifierExample& example) {
      constexpr std::size_t kOverlap = 0;  // of acceptance_features()
      return example.positive && example.values[kOverlap] > 0.3F && example.values[kOverlap] < 0.7F;
    });
  };
  REQUIRE(num_half_mapped(3) > num_half_mapped(0) + 3);
}

TEST_CASE("collect_quality_examples: stops when told to, and nothing of another world is right") {
  const auto office = room("synthetic:office?frames=6");
  const auto lounge = room("synthetic:lounge?frames=40");
  QualityExampleSettings settings = few_examples();
  settings.try_stride = 1000;
  QualityExamples examples;
  collect_quality_examples(Context(), {office.get(), nullptr, lounge.get(), 0}, {}, settings, examples);
  for (const auto* list : {&examples.tracking, &examples.acceptance}) {
    REQUIRE(std::none_of(list->begin(), list->end(), [](const ClassifierExample& example) { return example.positive; }));
  }
  int num_done = 0;
  collect_quality_examples(Context(), {office.get(), nullptr, lounge.get(), 0}, {}, settings, examples, [&](int done) {
    num_done = done;
    return false;
  });
  REQUIRE(num_done == 1);
}

}  // namespace
}  // namespace foothold
