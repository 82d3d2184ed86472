// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/learning/forest_training.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fake_sequence.h"
#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

using Sequences = std::vector<std::shared_ptr<const Sequence>>;

Sequences two_walls() {
  return {std::make_shared<test::FakeSequence>("wall-a", 6), std::make_shared<test::FakeSequence>("wall-b", 5, 1.0F)};
}

ForestTrainingSettings small_settings() {
  ForestTrainingSettings settings;
  settings.num_trees = 3;
  settings.depth = 7;
  settings.num_features = 32;
  settings.num_candidates = 48;
  settings.examples_per_frame = 200;
  settings.rolled_copies = 1;
  return settings;
}

std::string bytes_of(const Forest& forest) {
  std::ostringstream stream;
  write_forest(stream, forest);
  return stream.str();
}

Context context_of(int num_threads, LogSink log = {}) {
  ContextOptions options;
  options.num_threads = num_threads;
  options.log = std::move(log);
  return Context(options);
}

/// Trains until progress was reported `num_reports` times. @return Whether it was finished by then.
bool train_for(int num_reports, const std::string& checkpoint, const ForestTrainingSettings& settings) {
  ForestTrainingRun run;
  run.checkpoint = checkpoint;
  run.resume = true;
  run.progress = [&](const ForestTrainingProgress&) { return num_reports-- > 0; };
  return train_forest(context_of(2), two_walls(), settings, run).has_value();
}

}  // namespace

TEST_CASE("train_forest: the forest has the shape that was asked for and says where it comes from") {
  const ForestTrainingSettings settings = small_settings();
  const Forest forest = train_forest(context_of(1), two_walls(), settings).value();
  CHECK(forest.num_trees() == 3);
  CHECK(forest.depth() == 7);
  CHECK(forest.num_leaves() > 3 * 64);
  REQUIRE(forest.features().size() == 32);
  for (std::size_t i = 0; i < 32; ++i) CHECK((forest.features()[i].channel == FeatureChannel::kDepth) == (i < 16));
  CHECK(test::contains(forest.provenance(), "depth = 7"));
  CHECK(test::contains(forest.provenance(), "sequence = wall-b, 5 frames"));
  CHECK(test::contains(forest.provenance(), "data hash = "));
}

TEST_CASE("train_forest: threads do not matter, the seed does") {
  ForestTrainingSettings settings = small_settings();
  settings.agreement_weight = 1.0F;
  const std::string bytes = bytes_of(train_forest(context_of(1), two_walls(), settings).value());
  for (const int num_threads : {2, 4}) CHECK(bytes_of(train_forest(context_of(num_threads), two_walls(), settings).value()) == bytes);
  settings.seed = 43;
  CHECK(bytes_of(train_forest(context_of(2), two_walls(), settings).value()) != bytes);
}

TEST_CASE("train_forest: an interrupted training resumes to the same bytes, wherever it was interrupted") {
  ForestTrainingSettings settings = small_settings();
  settings.agreement_weight = GENERATE(0.0F, 1.0F);
  const std::string expected = bytes_of(train_forest(context_of(2), two_walls(), settings).value());
  const test::TempFolder folder;
  const std::string checkpoint = folder / "checkpoint";
  // 12 reports from 11 frames, one before each of 7 levels.
  for (const int num_reports : {3, 9, 8, 2, 4}) REQUIRE_FALSE(train_for(num_reports, checkpoint, settings));
  ForestTrainingRun run;
  run.checkpoint = checkpoint;
  run.resume = true;
  int num_frames_read = 0;
  run.progress = [&](const ForestTrainingProgress& progress) {
    num_frames_read += progress.stage == ForestTrainingProgress::Stage::kExamples ? 1 : 0;
    return true;
  };
  CHECK(bytes_of(train_forest(context_of(1), two_walls(), settings, run).value()) == expected);
  CHECK(num_frames_read == 1);  // the report before the first frame; none had to be read again
}

TEST_CASE("train_forest: a checkpoint that was cut short anywhere leads to the same bytes") {
  const ForestTrainingSettings settings = small_settings();
  const test::TempFolder folder;
  const std::string checkpoint = folder / "checkpoint";
  ForestTrainingRun run;
  run.checkpoint = checkpoint;
  const std::string expected = bytes_of(train_forest(context_of(2), two_walls(), settings, run).value());
  run.resume = true;
  const auto whole = static_cast<double>(std::filesystem::file_size(checkpoint));
  for (const double share : {0.999, 0.9, 0.3, 0.001}) {
    std::filesystem::resize_file(checkpoint, static_cast<std::uintmax_t>(share * whole));
    CHECK(bytes_of(train_forest(context_of(2), two_walls(), settings, run).value()) == expected);
    CHECK(static_cast<double>(std::filesystem::file_size(checkpoint)) == whole);
  }
}

TEST_CASE("train_forest: refuses the checkpoint of another training") {
  ForestTrainingSettings settings = small_settings();
  const test::TempFolder folder;
  const std::string checkpoint = folder / "checkpoint";
  REQUIRE_FALSE(train_for(9, checkpoint, settings));
  settings.seed = 1;
  const std::string message = test::error_message<FileError>([&] { train_for(9, checkpoint, settings); });
  CHECK(test::contains(message, checkpoint));
  CHECK(test::contains(message, "another training"));
}

TEST_CASE("train_forest: without resume, an old checkpoint is replaced") {
  const test::TempFolder folder;
  const std::string checkpoint = folder / "checkpoint";
  std::ofstream(checkpoint) << "something else";
  ForestTrainingRun run;
  run.checkpoint = checkpoint;
  CHECK(train_forest(context_of(2), two_walls(), small_settings(), run).has_value());
}

TEST_CASE("train_forest: keeps its memory limit with fewer examples a frame, and says so") {
  ForestTrainingSettings settings = small_settings();
  settings.depth = 1;
  settings.num_candidates = 2;
  settings.num_features = 512;
  settings.examples_per_frame = 100000;
  settings.memory_limit_gb = 0.25F;
  std::string message;
  const Context context = context_of(2, [&](LogLevel, const std::string& text) { message = text; });
  const Forest forest = train_forest(context, two_walls(), settings).value();
  CHECK(test::contains(message, "memory limit allows"));
  // 0.1 GB are left for examples of 1 kB each.
  const std::string text = forest.provenance();
  const std::size_t place = text.find("examples = ", text.find("sequence = "));
  REQUIRE(place != std::string::npos);
  const int num_examples = std::stoi(text.substr(place + 11));
  CHECK(num_examples > 80000);
  CHECK(num_examples < 100000);
}

TEST_CASE("train_forest: says what is wrong with its input") {
  const Context context = context_of(1);
  ForestTrainingSettings settings = small_settings();
  SECTION("no sequence") {
    CHECK(test::contains(test::error_message<InvalidSettings>([&] { train_forest(context, {}, settings); }), "at least one"));
  }
  SECTION("no poses") {
    const Sequences sequences{std::make_shared<test::FakeSequence>("lost", 3, 0.0F, false)};
    CHECK(test::contains(test::error_message<FileError>([&] { train_forest(context, sequences, settings); }), "lost"));
  }
  SECTION("memory limit too small for every frame") {
    settings.memory_limit_gb = 0.25F;
    const Sequences sequences{std::make_shared<test::FakeSequence>("endless", 2000000000)};
    CHECK(test::contains(test::error_message<InvalidSettings>([&] { train_forest(context, sequences, settings); }), "memory_limit_gb"));
  }
  SECTION("offsets") {
    settings.min_offset_px_m = 100.0F;
    CHECK(test::contains(test::error_message<InvalidSettings>([&] { train_forest(context, two_walls(), settings); }), "max_offset_px_m"));
  }
  SECTION("no objective") {
    settings.variance_weight = 0.0F;
    CHECK(test::contains(test::error_message<InvalidSettings>([&] { train_forest(context, two_walls(), settings); }), "agreement_weight"));
  }
  SECTION("a field out of range") {
    settings.depth = 21;
    CHECK(test::contains(test::error_message<InvalidSettings>([&] { settings.validate(); }), "depth"));
  }
  SECTION("a checkpoint in a folder that is not there") {
    ForestTrainingRun run;
    run.checkpoint = "/nowhere/at/all";
    CHECK(test::contains(test::error_message<FileError>([&] { train_forest(context, two_walls(), settings, run); }), "/nowhere/at/all"));
  }
}

TEST_CASE("ForestTrainingSettings: the defaults hold the paper's values") {
  const ForestTrainingSettings settings;
  CHECK(settings.num_trees == 5);
  CHECK(settings.depth == 15);
  CHECK(settings.num_features == 256);
  CHECK(settings.num_candidates == 512);
  CHECK(settings.depth_fraction == 0.5F);
  CHECK(settings.variance_weight == 1.0F);
  CHECK(settings.agreement_weight == 0.0F);
  CHECK(settings.rolled_copies == 0);
  CHECK(settings.min_child_fraction == 0.0F);
}

}  // namespace foothold
