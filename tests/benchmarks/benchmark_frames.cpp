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
namespace {

template <class T>
Image<T> quarter_turned(const Image<T>& image) {
  Image<T> turned(image.height(), image.width());
  for (int v = 0; v < turned.height(); ++v) {
    for (int u = 0; u < turned.width(); ++u) turned(u, v) = image(image.width() - 1 - v, u);
  }
  return turned;
}

Intrinsics quarter_turned(const Intrinsics& intrinsics, int width) {
  return {intrinsics.fy, intrinsics.fx, intrinsics.cy, static_cast<float>(width - 1) - intrinsics.cx};
}

}  // namespace

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

RgbdFrame quarter_turned(const RgbdFrame& frame) {
  RgbdFrame turned = frame;
  turned.depth = quarter_turned(frame.depth);
  turned.colour = quarter_turned(frame.colour);
  turned.calibration.depth = quarter_turned(frame.calibration.depth, frame.depth.width());
  turned.calibration.colour = quarter_turned(frame.calibration.colour, frame.colour.width());
  SE3 unturned_from_turned;
  unturned_from_turned.rotation << 0.0F, -1.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F;
  turned.calibration.depth_from_colour = unturned_from_turned.inverse() * frame.calibration.depth_from_colour * unturned_from_turned;
  if (frame.world_from_camera) turned.world_from_camera = *frame.world_from_camera * unturned_from_turned;
  return turned;
}

}  // namespace foothold::benchmark
