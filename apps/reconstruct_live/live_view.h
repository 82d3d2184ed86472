// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where the picture of a run goes: a window, files, both or neither.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/view_contents.h"
#include "common/view_window.h"
#include "foothold/base/trace.h"

namespace foothold::live {

/// The keys and what they do.
const std::vector<apps::ViewKey>& live_keys();

class LiveView {
 public:
  /// @param folder  for PNG files; empty for none. @throws DeviceError if there is no display; FileError if the folder cannot be made.
  LiveView(bool with_window, std::string folder, int frames_between_files);

  /// Whether the window wants a picture now: not so often that drawing would take most of the time.
  bool window_is_due() const;
  /// Whether a file is due after so many frames.
  bool file_is_due(std::int64_t num_frames) const;
  /// Draws, and writes a file if one is due. @return Milliseconds that it took. @throws FileError
  double show(const apps::ViewContents& contents, std::int64_t num_frames);
  /// The key pressed since the last call, or -1. Call it often: it keeps the window alive.
  int take_key();
  /// Whether the user has closed the window.
  bool closed() const { return window_ != nullptr && window_->closed(); }

 private:
  std::string folder_;
  int frames_between_files_;
  std::unique_ptr<apps::ViewWindow> window_;
  int key_ = -1;
  std::int64_t last_file_ = 0;
  double drawing_ms_ = 0.0;
  std::optional<Stopwatch> since_drawn_;
};

}  // namespace foothold::live
