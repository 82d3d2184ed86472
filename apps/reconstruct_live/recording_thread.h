// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Writes frames to disk while others go on.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "foothold/io/seven_scenes_writer.h"

namespace foothold::live {

/// Records frames in the layout of 7-Scenes from a thread of its own. A disk that is too slow costs frames, never memory: what finds the
/// queue full is dropped and counted.
class RecordingThread {
 public:
  /// @param capacity  Frames that may wait; one of 640x480 takes 2.2 MB.
  /// @throws FileError if the folder cannot be made or holds frames already.
  explicit RecordingThread(const std::string& folder, int capacity = 60);
  /// Writes what waits, as finish() does, but keeps errors to itself.
  ~RecordingThread();
  RecordingThread(const RecordingThread&) = delete;
  RecordingThread& operator=(const RecordingThread&) = delete;

  /// Queues a copy of a frame, without its pose if it has one. @return False if it was dropped, because the queue is full or the disk
  /// failed.
  bool add(const RgbdFrame& frame);

  struct Progress {
    int num_written = 0;
    int num_waiting = 0;
    int num_dropped = 0;
    std::string error;  ///< why nothing is written any more; empty if all is well
  };
  Progress progress() const;

  /// Waits until everything is written and completes the recording. @throws FileError if any frame could not be written.
  void finish();

 private:
  void write_all();
  void end_thread();

  const std::size_t capacity_;
  SevenScenesWriter writer_;  // the thread's, until it has ended

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<RgbdFrame> waiting_;  // guarded by mutex_, as are those below
  int num_written_ = 0;
  int num_dropped_ = 0;
  bool ending_ = false;
  std::exception_ptr failure_;
  std::string error_;

  std::thread thread_;
};

}  // namespace foothold::live
