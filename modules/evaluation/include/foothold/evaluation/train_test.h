// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Protocol: learn some recordings, then find the camera in others.
#pragma once

#include "foothold/evaluation/protocol.h"

namespace foothold {

/// Learns every frame of the training inputs in order, calls update() `num_settling_updates` times, as a live system has idle time, then
/// relocalises every frame of the test inputs without learning from them. All inputs share one world.
///
/// @param relocaliser  Freshly made or reset.
/// Frames without a true pose are left out, frames without depth are not found and teach nothing; the log counts both.
/// @throws FileError  naming the frame if one is malformed; or the input, if it has no frames with a true pose.
/// Reference: [Cavallari2017] Sec. 4.1.
RunLog run_train_test(Relocaliser& relocaliser, const std::vector<EvaluationInput>& training, const std::vector<EvaluationInput>& tests,
                      int num_settling_updates, const ProtocolOptions& options = {});

}  // namespace foothold
