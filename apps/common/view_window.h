// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A window on the screen.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace foothold::apps {

/// Shows pictures and takes keys. For the main thread.
class ViewWindow {
 public:
  /// @throws DeviceError if there is no display.
  explicit ViewWindow(std::string title);
  ~ViewWindow();
  ViewWindow(const ViewWindow&) = delete;
  ViewWindow& operator=(const ViewWindow&) = delete;

  /// Shows a picture and waits for a key, at least `wait_ms` > 0 milliseconds.
  /// @return The key as its lower-case character, 27 for Escape, or -1 for none.
  int show(const cv::Mat& picture, int wait_ms = 1);
  /// Waits for a key with the last picture on the screen.
  int wait(int wait_ms);
  /// Whether the user has closed the window.
  bool closed() const { return closed_; }

 private:
  std::string title_;
  bool sized_ = false;
  bool closed_ = false;
};

}  // namespace foothold::apps
