// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Protocol: tracking lost at every frame of a sequence that is being learnt.
#pragma once

#include "foothold/evaluation/protocol.h"

namespace foothold {

/// For each frame i after the first: relocalises it with what was learnt from the frames before it, notes the result, then learns it with
/// its true pose. No frame is ever tested by a relocaliser that has seen it or a later one.
///
/// With a gap of N frames the test is frame i + N, by what was learnt up to frame i - 1: the camera has moved on since it was last sure.
/// The gap counts the frames that the input plays; N frames are held in memory.
///
/// @param relocaliser  Freshly made or reset.
/// Frames without a true pose are left out, frames without depth are not found and teach nothing; the log counts both.
/// @throws FileError  naming the frame if one is malformed, or if the input has fewer than gap + 2 frames with a true pose. Reference:
/// [Cavallari2017] Sec. 4.2.
RunLog run_tracking_loss(Relocaliser& relocaliser, const EvaluationInput& input, int gap, const ProtocolOptions& options = {});

}  // namespace foothold
