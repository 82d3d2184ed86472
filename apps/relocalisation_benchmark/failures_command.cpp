// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "common/progress_bar.h"
#include "failure_pictures.h"
#include "foothold/base/angle.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/text_table.h"
#include "foothold/io/image_file.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "outputs.h"
#include "scene_tables.h"
#include "scenes.h"

namespace foothold::benchmark {
namespace {

/// Failures nearer than this in one recording show the same.
constexpr std::int64_t kLeastFramesApart = 15;
const std::vector<std::string> kTableHead = {"sequence", "frame", "cm", "deg", "confidence", "first right of the candidates"};

struct FailuresOptions {
  SceneOptions scene;
  std::string pictures;
  int count = 2;
  float voxel_size_m = 0.02F;
};

/// A test that failed, before it is looked into.
struct Failure {
  std::size_t input_index = 0;
  std::int64_t frame_index = 0;
  PoseError error;
  float confidence = 0.0F;
};

void check_options(const FailuresOptions& options) {
  const std::vector<std::string>& methods = options.scene.common.methods;
  if (methods.size() != 1 || (methods.front() != "forest" && methods.front() != "paper"))
    throw InvalidSettings("--method: failures looks into one forest's leaves; expected forest or paper");
  if (options.scene.scenes.size() != 1)
    throw InvalidSettings("--scene: got " + std::to_string(options.scene.scenes.size()) + " scenes, expected one");
  if (options.scene.common.device.device != "cpu")
    throw InvalidSettings("--device: failures draws on the host, where all numbers are the same; expected cpu");
  check_pictures(options.pictures);
}

/// Calls `use` with every frame of the inputs and the input's index.
template <class Use>
void for_each_frame(const std::vector<EvaluationInput>& inputs, const std::string& label, Use&& use) {
  int num_frames = 0;
  for (const EvaluationInput& input : inputs) num_frames += input.num_frames;
  apps::ProgressBar bar(label, num_frames);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::unique_ptr<FrameSource> source = inputs[i].open();
    RgbdFrame frame;
    while (source->read(frame) == ReadStatus::kFrame) {
      if (apps::interrupted()) throw Interrupted{};
      if (frame.world_from_camera.has_value()) use(i, frame);
      bar.advance();
    }
  }
}

/// The most confident wrong answers, which do most harm, some frames apart; then the frames without an answer are no use to look into.
std::vector<Failure> choose_failures(std::vector<Failure> failures, std::size_t count) {
  std::stable_sort(failures.begin(), failures.end(), [](const Failure& a, const Failure& b) { return a.confidence > b.confidence; });
  std::vector<Failure> chosen;
  for (const Failure& failure : failures) {
    const auto is_near = [&](const Failure& other) {
      return other.input_index == failure.input_index && std::abs(other.frame_index - failure.frame_index) < kLeastFramesApart;
    };
    if (chosen.size() < count && std::none_of(chosen.begin(), chosen.end(), is_near)) chosen.push_back(failure);
  }
  return chosen;
}

Json candidate_json(const FailureCase& failure, const ExplainedCandidate& candidate) {
  const PoseError error = failure.error_of(candidate);
  return {{"mean_energy", static_cast<double>(candidate.mean_energy)},
          {"inlier_fraction", candidate.inlier_fraction},
          {"confidence", candidate.confidence},
          {"translation_error_m", error.translation_m},
          {"rotation_error_deg", kDegPerRad * error.rotation_rad}};
}

/// What a scene's failures are looked into with.
struct Examination {
  const FailuresOptions& options;
  SceneModel& model;
  ForestRelocaliser& relocaliser;
};

/// What was found out about one failure.
struct Examined {
  std::vector<std::string> table_row;
  Json json;
};

/// Looks into one failure and draws it.
Examined examine(const Examination& with, const std::string& sequence, const RgbdFrame& frame, std::size_t number) {
  FailureCase failure{sequence, frame, with.relocaliser.explain(frame.view())};
  const std::vector<ExplainedCandidate>& candidates = failure.explanation.candidates;
  Json json = {{"sequence", sequence}, {"frame", frame.index}};
  json.update(candidate_json(failure, candidates.front()));
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const ExplainedCandidate& c) { return kFoundThreshold.contains(failure.error_of(c)); });
  json["first_right_candidate"] = found == candidates.end() ? Json(nullptr) : Json(1 + (found - candidates.begin()));
  json["candidates"] = Json::array();
  for (const ExplainedCandidate& candidate : candidates) json["candidates"].push_back(candidate_json(failure, candidate));
  const PoseError error = failure.error_of(candidates.front());
  Examined examined;
  examined.table_row = {sequence,
                        std::to_string(frame.index),
                        format_number(100.0 * error.translation_m, 1),
                        format_number(kDegPerRad * error.rotation_rad, 1),
                        format_number(static_cast<double>(candidates.front().confidence), 3),
                        found == candidates.end() ? "none" : std::to_string(1 + (found - candidates.begin()))};
  if (!with.options.pictures.empty()) {
    const std::string prefix = with.options.pictures + "." + std::to_string(number);
    write_png(prefix + ".candidates.png", draw_candidates(failure, with.model));
    write_png(prefix + ".modes.png", draw_modes(failure, with.model));
    json["candidates_picture"] = std::filesystem::path(prefix + ".candidates.png").filename().string();
    json["modes_picture"] = std::filesystem::path(prefix + ".modes.png").filename().string();
  }
  examined.json = std::move(json);
  return examined;
}

int run_failures(const FailuresOptions& options) {
  check_options(options);
  check_outputs(options.scene.common);
  const Method method = find_methods(options.scene.common.methods).front();
  const MethodInputs inputs = method_inputs(options.scene.common, {method});
  const Scene scene = open_scenes(options.scene).front();
  const Context context = apps::make_context(options.scene.common.device);
  TsdfSettings map_settings;
  map_settings.voxel_size_m = options.voxel_size_m;
  map_settings.truncation_m = 4.0F * options.voxel_size_m;
  map_settings.validate();
  SceneModel model(context, map_settings);
  ForestRelocaliser relocaliser(context, *inputs.forest, method.name == "paper" ? inputs.settings.paper : inputs.settings.forest);
  std::vector<Failure> failures;
  Json cases = Json::array();
  std::vector<std::vector<std::string>> table_rows;
  int num_tested = 0;
  int num_lost = 0;
  try {
    for_each_frame(scene.training, "learning " + scene.name, [&](std::size_t, const RgbdFrame& frame) {
      relocaliser.train(frame.view(), *frame.world_from_camera);
      model.add(frame);
    });
    for (int i = 0; i < options.scene.num_settling_updates; ++i) relocaliser.update();
    for_each_frame(scene.tests, "looking for failures", [&](std::size_t input, const RgbdFrame& frame) {
      ++num_tested;
      const std::vector<PoseEstimate> estimates = relocaliser.relocalise(frame.view());
      num_lost += estimates.empty() ? 1 : 0;
      if (estimates.empty()) return;
      const PoseError error = pose_error(estimates.front().world_from_camera, *frame.world_from_camera);
      if (!kFoundThreshold.contains(error)) failures.push_back({input, frame.index, error, estimates.front().confidence});
    });
    const std::vector<Failure> chosen = choose_failures(failures, static_cast<std::size_t>(options.count));
    if (!chosen.empty()) {
      for_each_frame(scene.tests, "drawing", [&](std::size_t input, const RgbdFrame& frame) {
        const auto is_it = [&](const Failure& failure) { return failure.input_index == input && failure.frame_index == frame.index; };
        if (std::none_of(chosen.begin(), chosen.end(), is_it)) return;
        Examined examined = examine({options, model, relocaliser}, scene.tests[input].name, frame, table_rows.size() + 1);
        table_rows.push_back(std::move(examined.table_row));
        cases.push_back(std::move(examined.json));
      });
    }
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("%zu of %d frames of %s were answered wrongly, %d not at all\n\n%s", failures.size(), num_tested, scene.name.c_str(),
              num_lost, table_rows.empty() ? "" : format_table(kTableHead, table_rows).c_str());
  Json json = document_head("failures", describe_scene_options(options.scene));
  json["scenes"] = scenes_json({scene});
  json["num_tested"] = num_tested;
  json["num_wrong"] = failures.size();
  json["num_unanswered"] = num_lost;
  json["cases"] = cases;
  std::string csv = "sequence,frame,translation_error_m,rotation_error_deg,confidence\n";
  for (const Failure& failure : failures) {
    csv += csv_cell(scene.tests[failure.input_index].name) + "," + std::to_string(failure.frame_index) + "," +
           csv_number(failure.error.translation_m) + "," + csv_number(kDegPerRad * failure.error.rotation_rad) + "," +
           csv_number(static_cast<double>(failure.confidence)) + "\n";
  }
  std::printf("%s", write_documents(options.scene.common, json, csv).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_failures_command(apps::CommandLine& app) {
  const auto options = std::make_shared<FailuresOptions>();
  apps::CommandLine command =
      app.add_subcommand("failures", "Draw the hypotheses and leaves behind wrong answers: the paper's supplementary material");
  add_scene_options(command, options->scene);
  command.add_option("--count", options->count, "Failures to look into, the most confident ones first").range(1, 1000).show_default();
  command.add_option("--pictures", options->pictures, "Draw each failure to PREFIX.N.candidates.png and PREFIX.N.modes.png")
      .type_name("PREFIX");
  command.add_option("--voxel-size", options->voxel_size_m, "Voxels of the map that is drawn [m]").range(0.005, 0.1).show_default();
  add_forest_option(command, options->scene.common);
  add_experiment_options(command, options->scene.common);
  return {command, [options] { return run_failures(*options); }};
}

}  // namespace foothold::benchmark
