// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Records every frame of a source, however long whoever looks on takes.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>

#include "foothold/api/frame_source.h"
#include "recording_thread.h"

namespace foothold::live {

/// Reads a source in a thread of its own and records what comes; as a source itself, it delivers copies of the newest frames to look at.
class RecordingReader : public FrameSource {
 public:
  /// @param num_frames  Frames after which nothing is recorded any more; 0 for no limit. @pre Source and recording outlive the reader.
  RecordingReader(FrameSource& source, RecordingThread& recording, int num_frames);
  /// Waits for the read under way, which takes a bounded time.
  ~RecordingReader() override;
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  /// Waits for a frame newer than the last, for 50 ms at most. @throws what the source threw.
  ReadStatus read(RgbdFrame& frame) override;
  /// While paused, frames are shown but not recorded.
  void set_paused(bool paused);
  /// Frames handed to the recording.
  std::int64_t num_taken() const;

 private:
  void record_all();
  bool take(RgbdFrame& frame);

  FrameSource& source_;
  RecordingThread& recording_;
  const std::int64_t num_frames_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  RgbdFrame newest_;  // guarded by mutex_, as are those below
  bool has_newest_ = false;
  bool paused_ = false;
  bool stop_ = false;
  bool ended_ = false;
  std::int64_t num_taken_ = 0;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace foothold::live
