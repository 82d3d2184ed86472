// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Frames for benchmarks, all loaded beforehand.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"

namespace foothold::benchmark {

/// Opens a packed recording, a raw one, or a room to render, "synthetic:ROOM?setting=value". @throws FileError, InvalidSettings
std::unique_ptr<Sequence> open_recording(const std::string& sequence, int num_frames);

/// The first frames of a sequence that have poses, at most `num_frames`. @throws InvalidSettings if these are fewer than `min_frames`.
std::vector<RgbdFrame> load_frames(const std::string& sequence, int num_frames, int min_frames);

}  // namespace foothold::benchmark
