// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "recording_reader.h"

#include <chrono>
#include <utility>

namespace foothold::live {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(50);  ///< so that keys are heeded meanwhile

}  // namespace

RecordingReader::RecordingReader(FrameSource& source, RecordingThread& recording, int num_frames)
    : source_(source), recording_(recording), num_frames_(num_frames), thread_([this] { record_all(); }) {}

RecordingReader::~RecordingReader() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  thread_.join();
}

ReadStatus RecordingReader::read(RgbdFrame& frame) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, kPatience, [this] { return has_newest_ || ended_ || failure_; });
  if (has_newest_) {
    std::swap(frame, newest_);
    has_newest_ = false;
    return ReadStatus::kFrame;
  }
  if (failure_) std::rethrow_exception(failure_);
  return ended_ ? ReadStatus::kEnd : ReadStatus::kTimedOut;
}

void RecordingReader::set_paused(bool paused) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = paused;
}

std::int64_t RecordingReader::num_taken() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return num_taken_;
}

/// Records a frame and keeps it for whoever looks on. @return False at the end.
bool RecordingReader::take(RgbdFrame& frame) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (stop_) return false;
  if (!paused_ && (num_frames_ == 0 || num_taken_ < num_frames_)) {
    lock.unlock();
    recording_.add(frame);
    lock.lock();
    ++num_taken_;
  }
  std::swap(newest_, frame);
  has_newest_ = true;
  changed_.notify_all();
  return true;
}

void RecordingReader::record_all() {
  RgbdFrame frame;
  try {
    while (true) {
      const ReadStatus status = source_.read(frame);
      const bool goes_on = status == ReadStatus::kFrame ? take(frame) : status == ReadStatus::kTimedOut;
      const std::lock_guard<std::mutex> lock(mutex_);
      if (goes_on && !stop_) continue;
      ended_ = true;
      changed_.notify_all();
      return;
    }
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_all();
  }
}

}  // namespace foothold::live
