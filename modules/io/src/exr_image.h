// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Depth in EXR images: one channel of floating-point numbers.
#pragma once

#include <filesystem>
#include <string>

#include "foothold/base/image.h"

namespace foothold::io {

/// True if this build was configured with OpenEXR.
bool reads_exr();

/// Decodes depth in the file's own unit, whatever its numbers are: also NaN. @throws FileError
Image<float> decode_exr(const std::string& bytes, const std::filesystem::path& name);

}  // namespace foothold::io
