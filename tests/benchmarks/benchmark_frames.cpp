// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "benchmark_frames.h"

#include <algorithm>
#include <future>
#include <thread>

#include "foothold/base/error.h"
#include "foothold/frames/raw_sequence.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "packed_recording.h"

namespace foothold::benchmark {
std::unique_ptr<Sequence> open_recording(const std::string& sequence, int num_frames) {
  if (is_synthetic_spec(sequence)) {
    SyntheticSequenceSettings settings = parse_synthetic_spec(sequence);
    settings.frames = std::min(settings.frames, num_frames);
    return make_synthetic_sequence(settings, Context{});
  }
  return is_packed_recording(sequence) ? open_packed_recording(sequence) : open_raw_sequence(sequence);
}

std::vector<RgbdFrame> load_frames(const std::string& sequence, int num_frames, int min_frames) {
  const std::unique_ptr<Sequence> recording = open_recording(sequence, num_frames);
  const int num_loaded = std::min(num_frames, recording->num_frames());
  const int num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<RgbdFrame> loaded(static_cast<std::size_t>(num_loaded));
  std::vector<std::future<void>> loading;
  for (int first = 0; first < num_threads; ++first) {
    loading.push_back(std::async(std::launch::async, [&, first] {
      for (int i = first; i < num_loaded; i += num_threads) loaded[static_cast<std::size_t>(i)] = recording->load(i);
    }));
  }
  for (std::future<void>& part : loading) part.get();
  loaded.erase(std::remove_if(loaded.begin(), loaded.end(), [](const RgbdFrame& frame) { return !frame.world_from_camera; }), loaded.end());
  if (static_cast<int>(loaded.size()) < min_frames) {
    throw InvalidSettings(sequence + ": got " + std::to_string(loaded.size()) + " frames with poses, expected at least " +
                          std::to_string(min_frames));
  }
  return loaded;
}

}  // namespace foothold::benchmark
