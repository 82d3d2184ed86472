// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the tests of module io share: small frames, and the text of expected errors.
#pragma once

#include <fstream>
#include <string>

#include "foothold/api/frame.h"
#include "foothold/base/error.h"
#include "support/error_message.h"
#include "support/temp_folder.h"

namespace foothold::test {

/// Cuts a file to a part of its length.
void truncate_file(const std::string& path, double fraction);

constexpr int kTestWidth = 32;
constexpr int kTestHeight = 24;

/// Frame i of a small recording: every pixel, colour and pose differs from those of other frames. Depths are whole millimetres.
RgbdFrame small_frame(int i);

/// The message of the FileError that opening a recording and loading all its frames throws.
std::string reading_error(const std::string& folder);

/// Writes a 7-Scenes folder of `num_frames` small frames.
void write_small_recording(const std::string& folder, int num_frames);

}  // namespace foothold::test
