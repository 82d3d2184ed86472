// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How far a long task has come, and how long the rest will take.
#pragma once

#include <cstdint>
#include <string>

#include "foothold/base/trace.h"

namespace foothold::apps {

/// Shows progress on stderr: a bar redrawn in place on a terminal, a line every tenth of the way elsewhere, so that logs stay short.
class ProgressBar {
 public:
  /// @param label  what is being done.
  /// @param total  steps in all; 0 shows nothing.
  ProgressBar(std::string label, std::int64_t total);
  /// Ends the line, so that what is printed next begins a new one.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Says that `done` steps are behind us. Cheap enough to call for every one.
  void set(std::int64_t done);
  /// One step more.
  void advance() { set(done_ + 1); }

 private:
  void draw();

  std::string label_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  bool is_terminal_;
  int tenths_shown_ = 0;
  bool drawn_ = false;
  double last_drawn_ms_ = 0.0;
  Stopwatch watch_;
};

/// A duration for people: "12 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

}  // namespace foothold::apps
