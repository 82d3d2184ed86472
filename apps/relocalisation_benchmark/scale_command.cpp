// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "foothold/evaluation/train_test.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "growth.h"
#include "outputs.h"
#include "places.h"
#include "scene_tables.h"

namespace foothold::benchmark {
namespace {

/// Rooms that no shipped forest has seen.
constexpr int kFirstRoom = 100;

struct ScaleOptions {
  SceneOptions scenes;
  std::vector<int> amounts = {1, 2, 4, 8, 16, 24};
  std::vector<int> laps;  ///< how often all places are learnt, one run for each number; empty for once, with each number of places
  std::string size = "320x240";
  RoomViews views;
  int first_room = kFirstRoom;
  std::string identical;  ///< the room that all places are; empty for rooms of their own
  double differing = 0.1;
  int num_tested = 4;
  float spacing_m = 9.0F;
};

/// "320x240"
void parse_size(const std::string& text, RoomViews& views) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &views.width, &views.height, &rest) != 2)
    throw InvalidSettings("--size: got '" + text + "', expected WIDTHxHEIGHT, such as 320x240");
}

/// The i-th room. Those that are identical but for some furniture have a third of it moved, a third gone, and a third new.
std::string room_spec(const ScaleOptions& options, int i) {
  if (options.identical.empty()) return "synthetic:training-" + std::to_string(options.first_room + i);
  SyntheticSequenceSettings settings;
  settings.room = options.identical;
  settings.moved = settings.removed = settings.added = static_cast<float>(options.differing / 3.0);
  settings.change_seed = static_cast<std::uint64_t>(i);
  return synthetic_spec(settings);
}

/// The scenes to learn, one after another: the user's recordings, or as many rooms as the largest amount asks for.
std::vector<Scene> scenes_to_learn(ScaleOptions options) {
  const int most = *std::max_element(options.amounts.begin(), options.amounts.end());
  if (!options.scenes.scenes.empty()) {
    const std::vector<Scene> scenes = open_scenes(options.scenes);
    if (most > static_cast<int>(scenes.size()))
      throw InvalidSettings("--rooms: got " + std::to_string(most) + ", expected at most the " + std::to_string(scenes.size()) +
                            " that --scene names");
    return scenes;
  }
  parse_size(options.size, options.views);
  std::vector<Scene> scenes;
  for (int i = 0; i < most; ++i) {
    scenes.push_back(room_scene(room_spec(options, i), options.views));
    if (!options.identical.empty()) scenes.back().name += "-" + std::to_string(i);
  }
  return scenes;
}

/// The frames of all places, lap after lap; from the second on with fresh noise.
std::vector<EvaluationInput> training_laps(const std::vector<Place>& places, int num_laps, std::uint64_t seed) {
  std::vector<EvaluationInput> training;
  for (int lap = 0; lap < num_laps; ++lap) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto& [name, origin_world, frames, tests] = places[i];
      const std::uint64_t noise = derive_seed(derive_seed(seed, static_cast<std::uint64_t>(lap)), i);
      training.push_back(lap == 0 ? memory_input(name, frames) : noisy_input(name, frames, static_cast<int>(frames.size()), noise));
    }
  }
  return training;
}

/// Learns places from nothing, lap after lap, and tests those of them that have tests.
GrowthPoint run_places(const ScaleOptions& options, const Method& method, const MethodInputs& inputs, const std::vector<Place>& places,
                       int num_laps, const std::string& label) {
  const std::vector<EvaluationInput> training = training_laps(places, num_laps, options.scenes.common.seed);
  std::vector<EvaluationInput> tests;
  for (const Place& place : places) {
    if (!place.tests.empty()) tests.push_back(memory_input(place.name, place.tests));
  }
  const Protocol protocol = [&](Relocaliser& relocaliser, const ProtocolOptions& protocol_options) {
    return run_train_test(relocaliser, training, tests, options.scenes.num_settling_updates, protocol_options);
  };
  GrowthPoint point;
  point.amount = static_cast<int>(places.size());
  point.result = run_method(method, inputs, options.scenes.common, protocol, method.name + ", " + label);
  point.beliefs = count_beliefs(point.result.log, places);
  const std::size_t num_trained = point.result.log.train.wall_ms.size();
  point.first_train_ms = train_spread(point.result.log, 0, places.front().training.size());
  point.last_train_ms = train_spread(point.result.log, num_trained - places.back().training.size(), num_trained);
  return point;
}

/// Each tested place learnt and tested by itself: what many places are held against.
GrowthPoint run_alone(const ScaleOptions& options, const Method& method, const MethodInputs& inputs, const std::vector<Place>& places) {
  std::vector<MethodResult> runs;
  GrowthPoint all;
  for (const Place& place : places) {
    if (place.tests.empty()) continue;
    const GrowthPoint one = run_places(options, method, inputs, {place}, 1, place.name + " alone");
    all.beliefs.num_right += one.beliefs.num_right;
    all.beliefs.num_unsure += one.beliefs.num_unsure;
    all.beliefs.num_wrong_here += one.beliefs.num_wrong_here;
    runs.push_back(one.result);
  }
  all.amount = 1;
  all.result = joined(runs);
  all.first_train_ms = all.last_train_ms = all.result.report.train.wall_ms;
  return all;
}

GrowthCurve run_curve(const ScaleOptions& options, const Method& method, const MethodInputs& inputs, const std::vector<Place>& places) {
  GrowthCurve curve;
  curve.method = method.name;
  curve.alone = run_alone(options, method, inputs, places);
  if (options.laps.empty()) {
    for (const int amount : options.amounts) {
      const std::string label = std::to_string(amount) + (amount == 1 ? " place" : " places");
      curve.points.push_back(run_places(options, method, inputs, {places.begin(), places.begin() + amount}, 1, label));
    }
  }
  for (const int laps : options.laps) {
    curve.points.push_back(run_places(options, method, inputs, places, laps, std::to_string(laps) + (laps == 1 ? " lap" : " laps")));
    curve.points.back().amount = laps;
  }
  return curve;
}

Json places_json(const std::vector<Place>& places) {
  Json json = Json::array();
  for (const Place& place : places) {
    json.push_back({{"name", place.name},
                    {"origin_m", Json::array({place.origin_world.x(), place.origin_world.y(), place.origin_world.z()})},
                    {"num_training", place.training.size()},
                    {"num_tests", place.tests.size()}});
  }
  return json;
}

std::vector<std::pair<std::string, std::string>> describe(const ScaleOptions& options) {
  std::vector<std::pair<std::string, std::string>> described = describe_scene_options(options.scenes);
  described.emplace_back("spacing_m", csv_number(static_cast<double>(options.spacing_m)));
  described.emplace_back("tested_places", std::to_string(options.num_tested));
  if (!options.scenes.scenes.empty()) return described;
  if (options.identical.empty()) {
    described.emplace_back("first_room", std::to_string(options.first_room));
  } else {
    described.emplace_back("identical", options.identical);
    described.emplace_back("differing", csv_number(options.differing));
  }
  described.emplace_back("frames", std::to_string(options.views.num_training));
  described.emplace_back("test_frames", std::to_string(options.views.num_tests));
  described.emplace_back("room_stride", std::to_string(options.views.stride));
  described.emplace_back("size", options.size);
  return described;
}

int run_scale(ScaleOptions options) {
  check_outputs(options.scenes.common);
  const std::vector<Method> methods = find_methods(options.scenes.common.methods);
  const MethodInputs inputs = method_inputs(options.scenes.common, methods);
  if (!options.laps.empty() && options.amounts.size() != 1)
    throw InvalidSettings("--laps: got " + std::to_string(options.amounts.size()) + " numbers of places with it, expected one --rooms N");
  const std::vector<Scene> scenes = scenes_to_learn(options);
  const std::string amount_name = options.laps.empty() ? "places" : "laps";
  std::vector<GrowthCurve> curves;
  std::vector<Place> places;
  try {
    places = load_places(scenes, options.spacing_m, options.num_tested, options.scenes.common.device.num_threads);
    for (const Method& method : methods) curves.push_back(run_curve(options, method, inputs, places));
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("Places %g m apart in one world, the first %d of them tested\n\n%s\n%s", static_cast<double>(options.spacing_m),
              std::min(options.num_tested, static_cast<int>(places.size())), growth_table(curves, amount_name).c_str(),
              belief_table(curves, amount_name).c_str());
  Json json = document_head("scale", describe(options));
  json["places"] = places_json(places);
  json["methods"] = growth_json(curves, amount_name);
  std::printf("%s", write_documents(options.scenes.common, json, growth_csv(curves, amount_name)).c_str());
  if (!options.scenes.common.plot_file.empty()) {
    write_growth_plot(options.scenes.common.plot_file, curves, amount_name + " learnt");
    std::printf("picture: %s\n", options.scenes.common.plot_file.c_str());
  }
  return apps::kSuccess;
}

void add_room_options(apps::CommandLine& command, ScaleOptions& options) {
  command.add_option("--rooms", options.amounts, "How many places to learn, one run for each number")
      .comma_separated()
      .range(1, 100000)
      .show_default();
  command
      .add_option(
          "--laps", options.laps,
          "How often to learn the N places of --rooms N, one after another and again, from the second time on with fresh noise; one "
          "run for each number")
      .comma_separated()
      .range(1, 100000);
  command.add_option("--first-room", options.first_room, "Rooms are synthetic:training-K from this K on").range(0, 1000000).show_default();
  command.add_option("--identical", options.identical, "Make all places this room, such as office, differing in some furniture")
      .type_name("ROOM");
  command.add_option("--differing", options.differing, "Share of the furniture in which identical rooms differ")
      .range(0.0, 1.0)
      .show_default();
  command.add_option("--frames", options.views.num_training, "Frames to learn in each room").range(1, 100000).show_default();
  command.add_option("--test-frames", options.views.num_tests, "Frames to test in each tested room, on another path")
      .range(1, 100000)
      .show_default();
  command.add_option("--room-stride", options.views.stride, "Learn every Nth frame of a room's path at 30 frames a second")
      .range(1, 1000)
      .show_default();
  command.add_option("--size", options.size, "Size of the rooms' images").type_name("WIDTHxHEIGHT").show_default();
}

}  // namespace

Command add_scale_command(apps::CommandLine& app) {
  const auto options = std::make_shared<ScaleOptions>();
  apps::CommandLine command = app.add_subcommand("scale", "Recall, time and memory against the number of places learnt in one world");
  add_scene_options(command, options->scenes, false);
  add_room_options(command, *options);
  command.add_option("--tested", options->num_tested, "How many places to test, the first ones").range(1, 100000).show_default();
  command.add_option("--spacing", options->spacing_m, "Distance between neighbouring places [m]").range(0.0, 10000.0).show_default();
  add_forest_option(command, options->scenes.common);
  add_experiment_options(command, options->scenes.common);
  add_plot_option(command, options->scenes.common, "Draw recall, time and memory against the number of places to FILE.png");
  return {command, [options] { return run_scale(*options); }};
}

}  // namespace foothold::benchmark
