// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scenes: recordings to learn and others, of the same place, to test.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "foothold/evaluation/protocol.h"
#include "options.h"
#include "run_methods.h"

namespace foothold::benchmark {

struct Scene {
  std::string name;
  std::vector<EvaluationInput> training;
  std::vector<EvaluationInput> tests;
};

/// What experiments on scenes take.
struct SceneOptions {
  CommonOptions common;
  std::vector<std::string> scenes;
  int num_settling_updates = 0;
};

/// --scene and --settle.
void add_scene_options(apps::CommandLine& command, SceneOptions& options, bool scene_required = true);

/// Opens all scenes, and checks of each recording that it is complete and has poses, before anything runs.
///
/// A scene is [NAME=]FOLDER of a 7-Scenes scene with its official split, [NAME=]synthetic:ROOM for the room's two trajectories, or
/// [NAME=]TRAINING,TEST,... for recordings in one world, of which the first is learnt. @throws FileError, InvalidSettings
std::vector<Scene> open_scenes(const SceneOptions& options);

/// Learns a scene's training recordings and tests its test recordings.
Protocol train_test_protocol(const Scene& scene, int num_settling_updates);

/// The options of describe_options() and those of scenes.
std::vector<std::pair<std::string, std::string>> describe_scene_options(const SceneOptions& options);

/// One method, with one forest, on one scene.
struct SceneRun {
  std::string forest;  ///< by the name of the row; empty for a method without one
  std::string scene;
  MethodResult result;
};

}  // namespace foothold::benchmark
