// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "scenes.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "foothold/base/error.h"
#include "foothold/evaluation/train_test.h"
#include "foothold/io/sequence.h"
#include "foothold/synthetic/synthetic_sequence.h"

namespace foothold::benchmark {
namespace {

/// Test frames of the official splits. Reference: [Shotton2013].
const std::map<std::string, int>& official_test_frames() {
  static const std::map<std::string, int> counts = {{"chess", 2000},   {"fire", 2000},       {"heads", 1000}, {"office", 4000},
                                                    {"pumpkin", 2000}, {"redkitchen", 5000}, {"stairs", 1000}};
  return counts;
}

/// Splits "NAME=REST"; the name is empty without one. Paths and room settings may hold '=' too, but behind one of "/:?".
std::pair<std::string, std::string> split_name(const std::string& text) {
  const std::size_t end = text.find_first_of("=/:?");
  if (end == std::string::npos || text[end] != '=') return {"", text};
  return {text.substr(0, end), text.substr(end + 1)};
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text + ",");
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

/// A name for a scene that was given none.
std::string default_name(const std::string& spec) {
  if (is_synthetic_spec(spec)) return parse_synthetic_spec(spec).room;
  const std::filesystem::path path(spec);
  const std::string last = path.filename().string();
  return last.empty() ? path.parent_path().filename().string() : last;
}

/// The spec of a room with one of its two trajectories.
std::string room_spec(const std::string& spec, const std::string& trajectory) {
  SyntheticSequenceSettings settings = parse_synthetic_spec(spec);
  settings.trajectory = trajectory;
  return synthetic_spec(settings);
}

/// Opens recordings and looks at the first frames of each, which tell most of what can be wrong with all.
std::vector<EvaluationInput> open_recordings(const CommonOptions& options, const std::vector<std::string>& specs) {
  std::vector<EvaluationInput> inputs;
  for (const std::string& spec : specs) {
    inputs.push_back(open_input(options, spec));
    RgbdFrame frame;
    const std::unique_ptr<FrameSource> source = inputs.back().open();
    while (!frame.world_from_camera.has_value()) {
      if (source->read(frame) != ReadStatus::kFrame)
        throw FileError(spec + ": no pose in any of its frames; expected true poses, by which experiments learn and judge");
    }
  }
  return inputs;
}

int num_frames_of(const std::vector<EvaluationInput>& inputs) {
  int sum = 0;
  for (const EvaluationInput& input : inputs) sum += input.num_frames;
  return sum;
}

/// An incomplete download is worth a word, though not an error: a part of a scene may be wanted. The data set comes without calibration
/// files, by which other scenes of the same name differ.
void warn_if_incomplete(const CommonOptions& options, const Scene& scene, const std::string& folder) {
  const auto official = official_test_frames().find(default_name(folder));
  const int num_frames = num_frames_of(scene.tests);
  if (official == official_test_frames().end() || options.stride != 1 || num_frames == official->second) return;
  if (std::filesystem::exists(std::filesystem::path(scene.tests.front().name) / "camera-intrinsics.txt")) return;
  apps::log_to_stderr()(LogLevel::kWarning, folder + ": " + std::to_string(num_frames) + " test frames, but the official split of " +
                                                official->first + " has " + std::to_string(official->second) +
                                                "; is every sequence unpacked?");
}

Scene open_scene(const CommonOptions& options, const std::string& text) {
  const auto [given_name, spec] = split_name(text);
  if (spec.empty())
    throw InvalidSettings("--scene: got '" + text + "', expected [NAME=]FOLDER, [NAME=]synthetic:ROOM or [NAME=]TRAINING,TEST,...");
  const std::vector<std::string> parts = split_at_commas(spec);
  Scene scene;
  scene.name = given_name.empty() ? default_name(parts.front()) : given_name;
  if (parts.size() > 1) {
    scene.training = open_recordings(options, {parts.front()});
    scene.tests = open_recordings(options, {parts.begin() + 1, parts.end()});
  } else if (is_synthetic_spec(spec)) {
    scene.training = open_recordings(options, {room_spec(spec, "train")});
    scene.tests = open_recordings(options, {room_spec(spec, "test")});
  } else {
    scene.training = open_recordings(options, read_split(spec, "train"));
    scene.tests = open_recordings(options, read_split(spec, "test"));
    warn_if_incomplete(options, scene, spec);
  }
  return scene;
}

}  // namespace

void add_scene_options(apps::CommandLine& command, SceneOptions& options, bool scene_required) {
  options.num_settling_updates = kDefaultSettlingUpdates;
  command
      .add_option(
          "--scene", options.scenes,
          "What to learn and what to test: [NAME=]FOLDER of a 7-Scenes scene, with its official split; [NAME=]synthetic:ROOM, with the "
          "room's two trajectories; or [NAME=]TRAINING,TEST,..., recordings in one world of which the first is learnt. Repeatable")
      .required(scene_required)
      .repeatable();
  command
      .add_option("--settle", options.num_settling_updates, "Calls of update() between training and test, as a live system has idle time")
      .range(0, 1000000)
      .show_default();
}

std::vector<Scene> open_scenes(const SceneOptions& options) {
  std::vector<Scene> scenes;
  for (const std::string& text : options.scenes) {
    scenes.push_back(open_scene(options.common, text));
    const std::string& name = scenes.back().name;
    const auto is_it = [&](const Scene& scene) { return scene.name == name; };
    if (std::count_if(scenes.begin(), scenes.end(), is_it) > 1)
      throw InvalidSettings("--scene: two scenes are called '" + name + "'; give them names, as NAME=" + text);
  }
  return scenes;
}

Protocol train_test_protocol(const Scene& scene, int num_settling_updates) {
  return [&scene, num_settling_updates](Relocaliser& relocaliser, const ProtocolOptions& options) {
    return run_train_test(relocaliser, scene.training, scene.tests, num_settling_updates, options);
  };
}

std::vector<std::pair<std::string, std::string>> describe_scene_options(const SceneOptions& options) {
  std::vector<std::pair<std::string, std::string>> described = describe_options(options.common);
  described.emplace_back("settle", std::to_string(options.num_settling_updates));
  return described;
}

}  // namespace foothold::benchmark
