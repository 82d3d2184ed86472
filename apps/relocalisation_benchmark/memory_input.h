// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Frames held in memory, so that decoding does not disturb what is timed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "foothold/evaluation/protocol.h"

namespace foothold::benchmark {

using FrameList = std::vector<std::shared_ptr<const RgbdFrame>>;

/// Reads all frames of an input that have a true pose into memory, their poses moved.
/// @throws Interrupted; FileError naming the input if it has no such frames.
FrameList read_frames(const EvaluationInput& input, const Eigen::Vector3f& moved_by_m = Eigen::Vector3f::Zero());

/// Inputs to read, one after another, into one list.
struct ReadJob {
  std::vector<EvaluationInput> inputs;
  FrameList* frames = nullptr;
  Eigen::Vector3f moved_by_m = Eigen::Vector3f::Zero();
};

/// Does several jobs at once, showing progress on stderr. The first exception of one ends all, and is thrown as read_frames() does.
/// @param num_threads  0 stands for as many as the machine has.
void read_all(const std::vector<ReadJob>& jobs, int num_threads);

/// Plays frames that are in memory.
EvaluationInput memory_input(const std::string& name, FrameList frames);

/// Plays `num_played` of frames that are in memory, to and fro, each time with fresh noise: a camera that sees again what it saw.
EvaluationInput noisy_input(const std::string& name, FrameList frames, int num_played, std::uint64_t seed);

/// The frame as a camera of `1 / divisor` times the resolution would see it: depth of one pixel of each block, colour averaged.
/// @pre divisor > 0 and at most the frame's smaller side.
RgbdFrame reduce_frame(const RgbdFrame& frame, int divisor);

}  // namespace foothold::benchmark
