// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "memory_input.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "common/app_main.h"
#include "common/progress_bar.h"
#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "foothold/synthetic/sensor_model.h"
#include "run_methods.h"

namespace foothold::benchmark {
namespace {

class MemorySource : public FrameSource {
 public:
  explicit MemorySource(FrameList frames) : frames_(std::move(frames)) {}
  ReadStatus read(RgbdFrame& frame) override {
    if (next_ == frames_.size()) return ReadStatus::kEnd;
    frame = *frames_[next_++];
    return ReadStatus::kFrame;
  }

 private:
  FrameList frames_;
  std::size_t next_ = 0;
};

class NoisySource : public FrameSource {
 public:
  NoisySource(FrameList frames, int num_played, std::uint64_t seed) : frames_(std::move(frames)), num_played_(num_played), seed_(seed) {}

  ReadStatus read(RgbdFrame& frame) override {
    if (next_ == num_played_) return ReadStatus::kEnd;
    const int there_and_back = std::max(1, 2 * static_cast<int>(frames_.size()) - 2);
    const int step = next_ % there_and_back;
    frame = *frames_[static_cast<std::size_t>(std::min(step, there_and_back - step))];
    add_noise(sensor_model(1), seed_, next_, frame.depth, frame.colour);
    frame.index = next_++;
    return ReadStatus::kFrame;
  }

 private:
  FrameList frames_;
  int num_played_;
  std::uint64_t seed_;
  int next_ = 0;
};

/// The mean colour of a block of pixels.
Rgb8 mean_colour(const Image<Rgb8>& colour, int first_u, int first_v, int size) {
  int r = 0;
  int g = 0;
  int b = 0;
  for (int v = first_v; v < first_v + size; ++v) {
    for (int u = first_u; u < first_u + size; ++u) {
      const Rgb8 pixel = colour(u, v);
      r += pixel.r;
      g += pixel.g;
      b += pixel.b;
    }
  }
  const int count = size * size;
  return {static_cast<std::uint8_t>(r / count), static_cast<std::uint8_t>(g / count), static_cast<std::uint8_t>(b / count)};
}

}  // namespace

FrameList read_frames(const EvaluationInput& input, const Eigen::Vector3f& moved_by_m) {
  FrameList frames;
  const std::unique_ptr<FrameSource> source = input.open();
  while (true) {
    if (apps::interrupted()) throw Interrupted{};
    auto frame = std::make_shared<RgbdFrame>();
    const ReadStatus status = source->read(*frame);
    if (status == ReadStatus::kTimedOut) continue;
    if (status == ReadStatus::kEnd) break;
    if (!frame->world_from_camera.has_value()) continue;
    frame->world_from_camera->translation += moved_by_m;
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw FileError(input.name + ": has no frames with a true pose; expected at least one");
  return frames;
}

void read_all(const std::vector<ReadJob>& jobs, int num_threads) {
  apps::ProgressBar bar("frames into memory", static_cast<std::int64_t>(jobs.size()));
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) {
      try {
        for (const EvaluationInput& input : jobs[i].inputs) {
          const FrameList frames = read_frames(input, jobs[i].moved_by_m);
          jobs[i].frames->insert(jobs[i].frames->end(), frames.begin(), frames.end());
        }
        const std::lock_guard<std::mutex> lock(mutex);
        bar.advance();
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (failure == nullptr) failure = std::current_exception();
        next = jobs.size();
      }
    }
  };
  if (num_threads <= 0) num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::thread> threads;
  for (int i = 0; i < num_threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (failure != nullptr) std::rethrow_exception(failure);
}

EvaluationInput memory_input(const std::string& name, FrameList frames) {
  const int num_frames = static_cast<int>(frames.size());
  return {name, num_frames,
          [frames = std::move(frames)]() -> std::unique_ptr<FrameSource> { return std::make_unique<MemorySource>(frames); }};
}

EvaluationInput noisy_input(const std::string& name, FrameList frames, int num_played, std::uint64_t seed) {
  const auto open = [frames = std::move(frames), num_played, seed]() -> std::unique_ptr<FrameSource> {
    return std::make_unique<NoisySource>(frames, num_played, seed);
  };
  return {name, num_played, open};
}

RgbdFrame reduce_frame(const RgbdFrame& frame, int divisor) {
  FOOTHOLD_EXPECTS(divisor > 0 && divisor <= std::min(frame.depth.width(), frame.depth.height()));
  const int width = frame.depth.width() / divisor;
  const int height = frame.depth.height() / divisor;
  RgbdFrame reduced;
  reduced.depth = Image<float>(width, height);
  reduced.colour = Image<Rgb8>(width, height);
  reduced.calibration = frame.calibration;
  reduced.calibration.depth = frame.calibration.depth.scaled(1.0F / static_cast<float>(divisor));
  reduced.calibration.colour = frame.calibration.colour.scaled(1.0F / static_cast<float>(divisor));
  reduced.index = frame.index;
  reduced.timestamp_s = frame.timestamp_s;
  reduced.world_from_camera = frame.world_from_camera;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      reduced.depth(u, v) = frame.depth(u * divisor + divisor / 2, v * divisor + divisor / 2);
      reduced.colour(u, v) = mean_colour(frame.colour, u * divisor, v * divisor, divisor);
    }
  }
  return reduced;
}

}  // namespace foothold::benchmark
