// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Frames whose images are missing, cut short or damaged.
#pragma once

#include <mutex>
#include <set>
#include <string>

#include "foothold/base/context.h"
#include "foothold/base/error.h"
#include "found_recording.h"

namespace foothold::io {

/// Which frames of a recording cannot be read. Few in the middle are an ordinary defect, and count as frames without depth; if it is the
/// first, or half of them, the recording is refused. Thread-safe.
class UnreadableFrames {
 public:
  /// Looks at the beginning and the end of every image file, and warns once of those that cannot be read. @throws FileError
  UnreadableFrames(const FoundRecording& found, const Context& context);

  bool contains(int index) const;
  /// Takes note of an image that turned out to be damaged when it was decoded, and warns of the first. @return False if the recording is to
  /// be refused.
  bool add(int index, const FileError& error);

 private:
  bool is_refused() const;

  const Context context_;
  const std::string folder_;
  const std::size_t num_frames_;
  mutable std::mutex mutex_;
  std::set<int> frames_;  // guarded by mutex_, as is the next
  bool has_warned_of_damage_ = false;
};

}  // namespace foothold::io
