// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where the picture of a run goes: a window, files, both or neither.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <opencv2/core/mat.hpp>
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

  /// Whether the window wants a picture now: not so often that drawing would take most of the time, and not while one is being drawn.
  bool window_is_due() const;
  /// Whether a file is due after so many frames.
  bool file_is_due(std::int64_t num_frames) const;
  /// Draws, and writes a file if one is due. The window's pictures are drawn beside the caller, but for the first. @throws FileError
  void show(apps::ViewContents contents, std::int64_t num_frames);
  /// What drawing the last picture took, showing included.
  double drawing_ms() const { return drawing_ms_; }
  /// Shows what has been drawn. @return The key pressed since the last call, or -1. Call it often: it keeps the window alive.
  int take_key();
  /// Whether the user has closed the window.
  bool closed() const { return window_ != nullptr && window_->closed(); }

 private:
  struct Drawn {
    cv::Mat picture;
    double ms = 0.0;
  };

  static Drawn drawn(const apps::ViewContents& contents);
  void write_file(const Drawn& drawn, std::int64_t num_frames);
  void present(const Drawn& drawn);

  std::string folder_;
  int frames_between_files_;
  std::unique_ptr<apps::ViewWindow> window_;
  int key_ = -1;
  std::int64_t last_file_ = 0;
  double drawing_ms_ = 0.0;
  std::optional<Stopwatch> since_shown_;
  std::future<Drawn> drawing_;  // the window's next picture, if it is being drawn
};

}  // namespace foothold::live
