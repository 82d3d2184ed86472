// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_checkpoint.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

constexpr std::uint64_t kTraining = 0x1234;

ForestExamples no_examples() {
  ForestExamples examples;
  examples.num_features = 3;
  return examples;
}

/// A file with two scenes and a level.
struct CheckpointFixture {
  test::TempFolder folder;
  std::string path = folder / "checkpoint";
  ForestExamples examples = no_examples();
  ForestLevel level{{{2, -5}, 1}, {{0, 0}, 0}};
  std::string bytes;

  CheckpointFixture() {
    ForestCheckpoint checkpoint = ForestCheckpoint::create(path, kTraining);
    examples.scene_begins = {0};
    for (const std::size_t num : {4U, 2U}) {
      for (std::size_t i = 0; i < num; ++i) {
        examples.points_world.emplace_back(static_cast<float>(i), 2.0F, 3.0F);
        for (int value = 1; value <= 3; ++value) examples.values.push_back(static_cast<std::int16_t>(value));
      }
      examples.scene_begins.push_back(examples.size());
      checkpoint.add_scene(examples);
    }
    checkpoint.add_level(level);
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    bytes = text.str();
  }
  CheckpointFixture(const CheckpointFixture&) = delete;
  CheckpointFixture& operator=(const CheckpointFixture&) = delete;

  void write(const std::string& text) const { std::ofstream(path, std::ios::binary) << text; }
  std::string resume_error(std::uint64_t training = kTraining) const {
    ForestExamples read = no_examples();
    std::vector<ForestLevel> levels;
    return test::error_message<FileError>([&] { ForestCheckpoint::resume(path, training, read, levels); });
  }
};

}  // namespace

TEST_CASE("ForestCheckpoint: reads back what it wrote, and goes on from there") {
  const CheckpointFixture fixture;
  for (const std::size_t num_levels : {1U, 2U}) {
    ForestExamples read = no_examples();
    std::vector<ForestLevel> levels;
    ForestCheckpoint checkpoint = ForestCheckpoint::resume(fixture.path, kTraining, read, levels);
    CHECK(read.values == fixture.examples.values);
    CHECK(read.points_world == fixture.examples.points_world);
    CHECK(read.scene_begins == fixture.examples.scene_begins);
    REQUIRE(levels.size() == num_levels);
    CHECK(levels.back()[0].split.feature == 2);
    CHECK(levels.back()[0].split.threshold == -5);
    CHECK(levels.back()[1].is_split == 0);
    checkpoint.add_level(fixture.level);
  }
}

TEST_CASE("ForestCheckpoint: forgets the record that was being written, whichever byte was the last") {
  const CheckpointFixture fixture;
  for (std::size_t num_bytes = checked_size(sizeof(kTraining)); num_bytes < fixture.bytes.size(); ++num_bytes) {
    fixture.write(fixture.bytes.substr(0, num_bytes));
    ForestExamples read = no_examples();
    std::vector<ForestLevel> levels;
    ForestCheckpoint::resume(fixture.path, kTraining, read, levels);
    CHECK(levels.empty());
    CHECK(read.size() <= 6);
    CHECK(std::filesystem::file_size(fixture.path) <= num_bytes);
  }
}

TEST_CASE("ForestCheckpoint: never takes a damaged record for a whole one") {
  const CheckpointFixture fixture;
  for (std::size_t place = checked_size(sizeof(kTraining)); place < fixture.bytes.size(); ++place) {
    std::string damaged = fixture.bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    fixture.write(damaged);
    ForestExamples read = no_examples();
    std::vector<ForestLevel> levels;
    const std::string message = test::error_message<FileError>([&] { ForestCheckpoint::resume(fixture.path, kTraining, read, levels); });
    CHECK((test::contains(message, "damaged") || levels.empty()));
    if (!message.empty()) CHECK(test::contains(message, fixture.path));
  }
}

TEST_CASE("ForestCheckpoint: refuses files that are none, of another version, or of another training") {
  const CheckpointFixture fixture;
  CHECK(test::contains(fixture.resume_error(kTraining + 1), "another training"));
  std::string other = fixture.bytes;
  other[8] = 9;
  fixture.write(other);
  CHECK(test::contains(fixture.resume_error(), "a checkpoint of a training of version 9, expected version 2; delete the file"));
  fixture.write("FHFOREST and so on, long enough for a header");
  CHECK(test::contains(fixture.resume_error(), "FHFTRAIN"));
  fixture.write("FHFTR");
  CHECK(test::contains(fixture.resume_error(), "ends early"));
}

}  // namespace foothold
