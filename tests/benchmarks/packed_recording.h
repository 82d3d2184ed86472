// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings small enough to be carried to a machine without an image library, a twelfth of their size as raw ones.
///
/// Depth is kept in whole millimetres. Colour keeps the upper five bits of each channel, which moves it by up to 4 of 255. Each frame is
/// coded by itself: a pixel's difference from what its neighbours predict, by an adaptive range coder.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "foothold/api/frame_source.h"

namespace foothold::benchmark {

/// Writes the first frames of a sequence, which have one size and calibration. @throws FileError
void pack_recording(const Sequence& sequence, int num_frames, std::ostream& stream);

/// Opens what pack_recording() wrote; frames are decoded when they are loaded. @throws FileError naming the file
std::unique_ptr<Sequence> open_packed_recording(const std::string& path);

bool is_packed_recording(const std::string& path);

}  // namespace foothold::benchmark
