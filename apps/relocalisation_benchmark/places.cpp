// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places.h"

#include <cmath>
#include <limits>

#include "foothold/base/contract.h"
#include "foothold/io/sequence_player.h"
#include "foothold/synthetic/synthetic_sequence.h"

namespace foothold::benchmark {
namespace {

std::vector<int> spread_indices(int count, int end) {
  std::vector<int> indices;
  for (int i = 0; i < count; ++i) indices.push_back(static_cast<int>(static_cast<std::int64_t>(i) * end / count));
  return indices;
}

}  // namespace

EvaluationInput path_input(SyntheticSequenceSettings settings, const std::string& trajectory, const std::vector<int>& indices) {
  settings.trajectory = trajectory;
  settings.frames = indices.back() + 1;
  const auto open = [settings, indices]() -> std::unique_ptr<FrameSource> {
    ContextOptions one_thread;
    one_thread.num_threads = 1;
    return std::make_unique<SequencePlayer>(make_synthetic_sequence(settings, Context(one_thread)), indices);
  };
  return {synthetic_spec(settings), static_cast<int>(indices.size()), open};
}

Scene room_scene(const std::string& spec, const RoomViews& views) {
  FOOTHOLD_EXPECTS(views.num_training > 0 && views.num_tests > 0 && views.stride > 0);
  SyntheticSequenceSettings settings = parse_synthetic_spec(spec);
  settings.width = views.width;
  settings.height = views.height;
  const int end = views.num_training * views.stride;
  Scene scene;
  scene.name = settings.room;
  scene.training = {path_input(settings, "train", spread_indices(views.num_training, end))};
  scene.tests = {path_input(settings, "test", spread_indices(views.num_tests, end))};
  return scene;
}

Eigen::Vector2i grid_field(int k) {
  const int shell = static_cast<int>(std::sqrt(static_cast<double>(k)));
  const int along = k - shell * shell;
  return along <= shell ? Eigen::Vector2i(shell, along) : Eigen::Vector2i(2 * shell - along, shell);
}

std::vector<Place> load_places(const std::vector<Scene>& scenes, float spacing_m, int num_tested, int num_threads) {
  std::vector<Place> places(scenes.size());
  std::vector<ReadJob> jobs;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Eigen::Vector2f field = grid_field(static_cast<int>(i)).cast<float>() * spacing_m;
    places[i].name = scenes[i].name;
    places[i].origin_world = {field.x(), field.y(), 0.0F};
    jobs.push_back({scenes[i].training, &places[i].training, places[i].origin_world});
    if (i < static_cast<std::size_t>(num_tested)) jobs.push_back({scenes[i].tests, &places[i].tests, places[i].origin_world});
  }
  read_all(jobs, num_threads);
  return places;
}

std::size_t nearest_place(const std::vector<Place>& places, const Eigen::Vector3f& position_world) {
  std::size_t nearest = 0;
  float nearest_m2 = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const auto& frame : places[i].training) {
      const float distance_m2 = (frame->world_from_camera->translation - position_world).squaredNorm();
      if (distance_m2 >= nearest_m2) continue;
      nearest_m2 = distance_m2;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace foothold::benchmark
