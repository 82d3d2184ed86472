// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The forms in which runs on scenes are written.
#pragma once

#include <string>
#include <vector>

#include "json_parts.h"
#include "scenes.h"

namespace foothold::benchmark {

/// What was learnt and tested, a JSON object per scene.
Json scenes_json(const std::vector<Scene>& scenes);
/// A JSON object per run: names, accuracy, novelty, timing.
Json runs_json(const std::vector<SceneRun>& runs);
/// A line per run and tested frame.
std::string runs_csv(const std::vector<SceneRun>& runs, const std::vector<Scene>& scenes);

/// The mean of a recall over the runs of one method with one forest, each scene counting once.
double average_recall(const std::vector<SceneRun>& runs, const std::string& forest, const std::string& method,
                      const PoseThreshold& threshold);

/// A Markdown table for people: a row per forest and method, a column per scene and the average, in percent within the threshold.
std::string adaptation_table(const std::vector<SceneRun>& runs, const std::vector<Scene>& scenes, const PoseThreshold& threshold);

/// Writes the files asked for and returns a line for people about each. @throws FileError
std::string write_documents(const CommonOptions& options, const Json& json, const std::string& csv);

}  // namespace foothold::benchmark
