// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// device_benchmark: what a device makes of a recording, how fast, and whether it does so again and again. Needs neither OpenCV nor an
/// app's libraries, so that it runs on machines that have no packages.
#include <cstdio>
#include <fstream>

#include "benchmark_frames.h"
#include "device_rig.h"
#include "foothold/base/error.h"
#include "packed_recording.h"

namespace foothold::benchmark {
namespace {

void pack(const Options& options) {
  std::ofstream stream(options.out, std::ios::binary);
  if (!stream) throw FileError(options.out + ": cannot be written; does its folder exist?");
  pack_recording(*open_recording(options.sequence, options.num_frames), options.num_frames, stream);
}

int run(const std::vector<std::string>& arguments) {
  const std::optional<Options> options = parse_options(arguments);
  if (!options) return 0;
  if (options->action == "compare") return compare_devices(*options) ? 0 : 1;
  if (options->action == "soak") return soak(*options) ? 0 : 1;
  if (options->action == "pack") {
    pack(*options);
  } else {
    time_calls(*options);
  }
  return 0;
}

}  // namespace
}  // namespace foothold::benchmark

int main(int argc, char** argv) {
  try {
    return foothold::benchmark::run({argv + 1, argv + argc});
  } catch (const foothold::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unexpected: %s\n", error.what());
    return 1;
  }
}
