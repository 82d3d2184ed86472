// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the thread that talks to OpenNI2 shares with everybody else.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "foothold/openni/openni_source.h"

namespace foothold::capture {

using Clock = std::chrono::steady_clock;

/// Lives as long as any thread that may touch it, which after a hang is longer than the source. Everything below the mutex is guarded by
/// it.
struct CaptureState {
  CaptureState(const OpenNISettings& s, const std::optional<RgbdCalibration>& c) : settings(s), calibration(c) {}

  const OpenNISettings settings;
  const std::optional<RgbdCalibration> calibration;
  const Clock::time_point start = Clock::now();

  std::mutex mutex;
  std::condition_variable for_reader;  ///< opened, newest, ended, finished
  std::condition_variable for_worker;  ///< stop, image_arrived, disconnected, newcomers

  // From the worker to the reader:
  bool opened = false;
  bool finished = false;     ///< the thread is about to return
  std::exception_ptr error;  ///< broken for good
  bool has_newest = false;
  RgbdFrame newest;
  OpenNIStatus status;
  std::vector<std::pair<LogLevel, std::string>> messages;
  std::string activity;  ///< what the driver has been asked to do; empty while the worker waits here
  Clock::time_point activity_start;

  // From the source and from OpenNI2's threads to the worker:
  bool stop = false;
  bool image_arrived = false;
  bool disconnected = false;
  bool recording_ended = false;
  std::vector<std::string> newcomers;  ///< URIs of cameras plugged in since the last look

  /// Records what the driver is being asked to do, so that somebody can say so if it never returns.
  void set_activity(const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex);
    activity = text;
    activity_start = Clock::now();
  }
  void warn(const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex);
    messages.emplace_back(LogLevel::kWarning, text);
  }
  /// Changes the state that users see, and reports it once.
  void set_state(OpenNIState state, const std::string& message) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!message.empty() && message != status.message) messages.emplace_back(LogLevel::kWarning, message);
    status.state = state;
    status.message = message;
  }
};

}  // namespace foothold::capture
