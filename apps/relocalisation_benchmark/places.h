// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Places: scenes held in memory, each moved to a spot of its own in one world.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "foothold/synthetic/synthetic_sequence.h"
#include "memory_input.h"
#include "scenes.h"

namespace foothold::benchmark {

/// A part of a large world.
struct Place {
  std::string name;
  Eigen::Vector3f origin_world;  ///< where the place's own origin came to be
  FrameList training;
  FrameList tests;
};

/// How the rooms of a world are seen.
struct RoomViews {
  int width = 320;
  int height = 240;
  int num_training = 100;  ///< frames of the room's path "train", every stride-th
  int num_tests = 25;      ///< frames of its path "test", spread over the same time
  int stride = 4;
};

/// Frames of one path, "train" or "test", of a room. They are rendered, on one thread, each time the input is opened.
EvaluationInput path_input(SyntheticSequenceSettings settings, const std::string& trajectory, const std::vector<int>& indices);

/// A room and the frames to learn and to test in it.
/// @param spec  Such as "synthetic:training-100"; paths and numbers of frames are those of the views.
Scene room_scene(const std::string& spec, const RoomViews& views);

/// The k-th field of a square grid that grows with k, in fields from the first: (0, 0), (1, 0), (1, 1), (0, 1), (2, 0), ...
Eigen::Vector2i grid_field(int k);

/// Loads scenes into memory, several at once, and moves each to the next field of a grid in the plane z = 0. Shows progress on stderr.
///
/// @param num_tested   Tests are loaded of this many scenes, the first ones.
/// @param num_threads  As many inputs are read at once; 0 stands for as many as the machine has.
/// @throws Interrupted; FileError naming the frame if one has no true pose, or a scene without frames.
std::vector<Place> load_places(const std::vector<Scene>& scenes, float spacing_m, int num_tested, int num_threads);

/// The place whose learnt camera positions come nearest to a position; 0 without any.
std::size_t nearest_place(const std::vector<Place>& places, const Eigen::Vector3f& position_world);

}  // namespace foothold::benchmark
