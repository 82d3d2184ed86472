// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The picture of a benchmark: recall over time, and where on the trajectory the camera was found.
#pragma once

#include <string>

#include "foothold/base/image.h"
#include "result.h"

namespace foothold::benchmark {

/// Recall of every method over the tested frames, above one map of the trajectory per method, seen from above.
/// @pre The result has a method, and every method tested the same frames.
Image<Rgb8> draw_result(const BenchmarkResult& result);

/// Writes draw_result() as a PNG file. @throws FileError
void write_plot(const std::string& path, const BenchmarkResult& result);

}  // namespace foothold::benchmark
