// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "recording_thread.h"

#include <utility>

#include "foothold/base/contract.h"

namespace foothold::live {

RecordingThread::RecordingThread(const std::string& folder, int capacity)
    : capacity_(static_cast<std::size_t>(capacity)), writer_(folder), thread_([this] { write_all(); }) {
  FOOTHOLD_EXPECTS(capacity > 0);
}

RecordingThread::~RecordingThread() {
  try {
    finish();
  } catch (...) {  // whoever wanted to know has called finish()
  }
}

bool RecordingThread::add(const RgbdFrame& frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure_ || ending_ || waiting_.size() >= capacity_) {
      ++num_dropped_;
      return false;
    }
  }
  RgbdFrame copy = frame;  // outside the lock; only this thread makes the queue longer
  copy.world_from_camera.reset();
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.push_back(std::move(copy));
  changed_.notify_one();
  return true;
}

RecordingThread::Progress RecordingThread::progress() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {num_written_, static_cast<int>(waiting_.size()), num_dropped_, error_};
}

void RecordingThread::finish() {
  if (thread_.joinable()) {
    end_thread();
    if (!failure_) writer_.finish();
  }
  if (failure_) std::rethrow_exception(failure_);
}

void RecordingThread::end_thread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    changed_.notify_one();
  }
  thread_.join();
}

void RecordingThread::write_all() {
  while (true) {
    RgbdFrame frame;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      frame = std::move(waiting_.front());
      waiting_.pop_front();
    }
    try {
      writer_.write(frame);
    } catch (const std::exception& error) {
      const std::lock_guard<std::mutex> lock(mutex_);
      failure_ = std::current_exception();
      error_ = error.what();
      num_dropped_ += 1 + static_cast<int>(waiting_.size());
      waiting_.clear();
      return;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    ++num_written_;
  }
}

}  // namespace foothold::live
