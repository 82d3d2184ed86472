// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/openni/openni_source.h"

#include <functional>
#include <thread>
#include <utility>

#include "capture_state.h"
#include "capture_worker.h"
#include "device_choice.h"
#include "messages.h"
#include "runtime.h"
#include "usb.h"

namespace foothold {
namespace {

using capture::CaptureState;
using capture::Clock;

/// The cameras with their modes. Blocks as long as the drivers like.
std::vector<OpenNIDeviceInfo> ask_for_devices() {
  const capture::Runtime runtime;
  std::vector<OpenNIDeviceInfo> devices = runtime.devices();
  for (OpenNIDeviceInfo& info : devices) {
    openni::Device device;
    if (device.open(info.uri.c_str()) != openni::STATUS_OK) continue;  // busy, say; it is there all the same
    info.depth_modes = capture::video_modes(device, openni::SENSOR_DEPTH);
    info.colour_modes = capture::video_modes(device, openni::SENSOR_COLOR);
    device.close();
  }
  return devices;
}

}  // namespace

void OpenNISettings::validate() const {
  validate_settings(*this);
  if ((colour_width == 0) != (colour_height == 0)) {
    throw InvalidSettings("setting colour_height: got " + std::to_string(colour_height) + " with a colour_width of " +
                          std::to_string(colour_width) + ", expected both, or 0 for both");
  }
  if (registration != "auto" && registration != "device" && registration != "software" && registration != "off") {
    throw InvalidSettings("setting registration: got '" + registration + "', expected auto, device, software or off");
  }
}

std::vector<OpenNIDeviceInfo> list_openni_devices(int time_limit_ms) {
  struct Result {
    std::mutex mutex;
    std::condition_variable changed;
    bool finished = false;
    std::vector<OpenNIDeviceInfo> devices;
    std::exception_ptr error;
  };
  const auto result = std::make_shared<Result>();
  std::thread thread([result] {
    std::vector<OpenNIDeviceInfo> devices;
    std::exception_ptr error;
    try {
      devices = ask_for_devices();
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(result->mutex);
    result->devices = std::move(devices);
    result->error = error;
    result->finished = true;
    result->changed.notify_all();
  });
  std::unique_lock<std::mutex> lock(result->mutex);
  if (!result->changed.wait_for(lock, std::chrono::milliseconds(time_limit_ms), [&] { return result->finished; })) {
    thread.detach();
    throw DeviceError(capture::not_answering_message("listing the cameras", time_limit_ms));
  }
  lock.unlock();
  thread.join();
  if (result->error) std::rethrow_exception(result->error);
  return result->devices;
}

std::string openni_no_device_advice() { return capture::no_device_advice(capture::find_usb_cameras()); }

struct OpenNISource::Impl {
  Impl(const OpenNISettings& settings, const std::optional<RgbdCalibration>& calibration, LogSink sink)
      : log(std::move(sink)), state(std::make_shared<CaptureState>(settings, calibration)), thread(capture::run_capture, state) {}

  /// Hands the worker's messages to the user's log, on the user's thread.
  void flush_messages() {
    std::vector<std::pair<LogLevel, std::string>> messages;
    {
      const std::lock_guard<std::mutex> lock(state->mutex);
      messages.swap(state->messages);
    }
    if (!log) return;
    for (const auto& [level, message] : messages) log(level, message);
  }

  /// Ends the thread, or leaves it behind if the driver does not let it go.
  void close(int time_limit_ms) {
    bool finished = false;
    {
      std::unique_lock<std::mutex> lock(state->mutex);
      state->stop = true;
      state->for_worker.notify_all();
      finished = state->for_reader.wait_for(lock, std::chrono::milliseconds(time_limit_ms), [this] { return state->finished; });
      if (!finished) state->messages.emplace_back(LogLevel::kWarning, capture::not_answering_message(state->activity, time_limit_ms));
    }
    finished ? thread.join() : thread.detach();
  }

  void wait_until_open() {
    std::unique_lock<std::mutex> lock(state->mutex);
    const int limit_ms = state->settings.open_timeout_ms;
    if (state->for_reader.wait_for(lock, std::chrono::milliseconds(limit_ms), [this] { return state->opened || state->finished; })) {
      if (!state->opened && state->error) std::rethrow_exception(state->error);
      return;
    }
    const std::string& device = state->settings.device;
    if (capture::is_recording(device)) throw DeviceError(capture::recording_message(device, "OpenNI2 does not open it in time"));
    throw DeviceError(capture::not_answering_message(state->activity, limit_ms));
  }

  LogSink log;
  std::shared_ptr<CaptureState> state;
  std::thread thread;
};

OpenNISource::OpenNISource(const OpenNISettings& settings, const std::optional<RgbdCalibration>& calibration, LogSink log) {
  settings.validate();
  if (calibration.has_value() && !(is_valid(calibration->depth) && is_valid(calibration->colour))) {
    throw InvalidSettings("calibration: focal lengths must be positive and every value finite");
  }
  if (settings.registration == "software" && !calibration.has_value()) {
    throw InvalidSettings("setting registration: got 'software', which needs a calibration with the extrinsics of the two cameras");
  }
  impl_ = std::make_unique<Impl>(settings, calibration, std::move(log));
  try {
    impl_->wait_until_open();
  } catch (...) {
    constexpr int kGrace_ms = 100;  // the thread has failed already, or has had its time
    impl_->close(kGrace_ms);
    throw;
  }
  impl_->flush_messages();
}

OpenNISource::~OpenNISource() {
  impl_->close(impl_->state->settings.close_timeout_ms);
  try {
    impl_->flush_messages();
  } catch (...) {  // a log that throws must not end the process
  }
}

ReadStatus OpenNISource::read(RgbdFrame& frame) {
  CaptureState& state = *impl_->state;
  std::unique_lock<std::mutex> lock(state.mutex);
  state.for_reader.wait_for(lock, std::chrono::milliseconds(state.settings.read_timeout_ms),
                            [&] { return state.has_newest || state.finished; });
  lock.unlock();
  impl_->flush_messages();
  lock.lock();
  if (state.has_newest) {
    std::swap(frame, state.newest);
    state.has_newest = false;
    return ReadStatus::kFrame;
  }
  if (state.error) std::rethrow_exception(state.error);
  return state.finished ? ReadStatus::kEnd : ReadStatus::kTimedOut;
}

OpenNIStatus OpenNISource::status() const {
  CaptureState& state = *impl_->state;
  const std::lock_guard<std::mutex> lock(state.mutex);
  OpenNIStatus status = state.status;
  const auto busy_ms = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - state.activity_start).count();
  if (!state.activity.empty() && busy_ms > state.settings.silence_timeout_ms) {
    status.state = OpenNIState::kNotAnswering;
    status.message = capture::not_answering_message(state.activity, static_cast<int>(busy_ms));
  }
  return status;
}

}  // namespace foothold
