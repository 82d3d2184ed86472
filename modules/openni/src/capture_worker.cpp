// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "capture_worker.h"

#include <algorithm>
#include <utility>

#include "camera_device.h"
#include "device_choice.h"
#include "frame_pairer.h"
#include "messages.h"
#include "runtime.h"

namespace foothold::capture {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(100);   ///< how late a missed notification may be noticed
constexpr auto kRetryInterval = std::chrono::milliseconds(500);  ///< between attempts to open a camera that will not
constexpr int kImagesBeforeDistrust =
    10;  ///< so many depth and colour images without a single pair, and the stamps must come from two clocks

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }
int ms_since(Clock::time_point start) { return static_cast<int>(1e3 * seconds_since(start)); }

/// Tells the worker about cameras that come and go.
HotplugListener::Callbacks hotplug_callbacks(const std::shared_ptr<CaptureState>& state) {
  HotplugListener::Callbacks callbacks;
  callbacks.connected = [state](const std::string& uri) {
    const std::lock_guard<std::mutex> lock(state->mutex);
    state->newcomers.push_back(uri);
  };
  callbacks.disconnected = [state](const std::string& uri) {
    const std::lock_guard<std::mutex> lock(state->mutex);
    state->newcomers.erase(std::remove(state->newcomers.begin(), state->newcomers.end(), uri), state->newcomers.end());
    if (uri != state->status.device.uri) return;
    state->disconnected = true;
    state->for_worker.notify_one();
  };
  callbacks.ended = [state](const std::string& uri) {
    const std::lock_guard<std::mutex> lock(state->mutex);
    if (uri != state->status.device.uri) return;
    state->recording_ended = true;
    state->for_worker.notify_one();
  };
  return callbacks;
}

/// What ended a stretch of streaming.
enum class Ending { kStop, kUnplugged, kSilent, kRecordingOver };

class Worker {
 public:
  explicit Worker(std::shared_ptr<CaptureState> state) : state_(std::move(state)), settings_(state_->settings) {}
  void run();

 private:
  using Pairer = FramePairer<openni::VideoFrameRef>;

  std::unique_ptr<CameraDevice> open(const std::string& uri);
  std::unique_ptr<CameraDevice> reopen(const Runtime& runtime);
  std::string look_for_camera(const Runtime& runtime);
  void stream_and_recover(std::unique_ptr<CameraDevice> camera, const Runtime& runtime);
  Ending stream(CameraDevice& camera);
  void collect(CameraDevice& camera, Pairer& pairer);
  void distrust_stamps(Pairer& pairer);
  void publish(const CameraDevice& camera, const Pairer::Pair& pair);
  bool wait(std::chrono::milliseconds time, const bool& news);

  const std::shared_ptr<CaptureState> state_;
  const OpenNISettings& settings_;
  OpenNIDeviceInfo device_;
  bool synchronise_ = true;
  RgbdFrame frame_;            // filled here, swapped into the state
  double last_time_s_ = -1.0;  // of the last pair, on the source's clock

  // Since the camera was opened:
  bool stamps_trusted_ = true;
  std::int64_t num_pairs_ = 0;
  double clock_offset_s_ = 0.0;  // from the camera's clock to the source's
  // Since the last pair:
  Clock::time_point last_pair_;
  int num_depth_ = 0;
  int num_colour_ = 0;
};

/// Waits until there is news or the source wants to stop. @return True to go on.
bool Worker::wait(std::chrono::milliseconds time, const bool& news) {
  std::unique_lock<std::mutex> lock(state_->mutex);
  state_->activity.clear();
  state_->for_worker.wait_for(lock, time, [&] { return news || state_->stop || state_->disconnected || state_->recording_ended; });
  return !state_->stop;
}

std::unique_ptr<CameraDevice> Worker::open(const std::string& uri) {
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    device_.uri = uri;
    state_->disconnected = false;
    state_->image_arrived = false;
    state_->status.device.uri = uri;
  }
  const std::shared_ptr<CaptureState> state = state_;
  CameraDevice::Options options{settings_, state_->calibration, settings_.synchronise && synchronise_, {}, {}, {}};
  options.wake = [state] {
    const std::lock_guard<std::mutex> lock(state->mutex);
    state->image_arrived = true;
    state->for_worker.notify_one();
  };
  options.is_doing = [state](const std::string& activity) { state->set_activity(activity); };
  options.warn = [state](const std::string& text) { state->warn(text); };
  auto camera = std::make_unique<CameraDevice>(uri, options);
  const std::lock_guard<std::mutex> lock(state_->mutex);
  device_ = camera->info();
  state_->status.device = device_;
  state_->status.registered = camera->is_registered();
  return camera;
}

std::string Worker::look_for_camera(const Runtime& runtime) {
  state_->set_activity("looking for the camera");
  const std::vector<OpenNIDeviceInfo> devices = runtime.devices();
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return find_again(device_, devices, state_->newcomers, settings_.device.empty());
}

/// Tries until the camera is open again. @return Null if the source is to stop.
std::unique_ptr<CameraDevice> Worker::reopen(const Runtime& runtime) {
  const bool nothing = false;
  do {
    const std::string uri = look_for_camera(runtime);
    if (uri.empty()) {
      state_->set_state(OpenNIState::kWaitingForDevice, unplugged_message(device_.uri));
      continue;
    }
    const OpenNIDeviceInfo before = device_;
    try {
      auto camera = open(uri);
      const std::lock_guard<std::mutex> lock(state_->mutex);
      ++state_->status.num_reopened;
      state_->newcomers.clear();
      return camera;
    } catch (const Error& error) {
      device_ = before;
      state_->set_state(OpenNIState::kWaitingForDevice, error.what());
    }
  } while (wait(kRetryInterval, nothing));
  return nullptr;
}

/// Makes a frame of a pair and puts it where the reader finds it.
void Worker::publish(const CameraDevice& camera, const Pairer::Pair& pair) {
  if (!camera.convert(pair.depth, pair.colour, frame_)) return;
  const double now_s = seconds_since(state_->start);
  if (num_pairs_++ == 0) clock_offset_s_ = now_s - pair.depth_time_s;
  last_time_s_ = std::max(pair.depth_time_s + clock_offset_s_, std::nextafter(last_time_s_, now_s + 1e9));
  last_pair_ = Clock::now();
  num_depth_ = num_colour_ = 0;
  frame_.timestamp_s = last_time_s_;
  frame_.world_from_camera.reset();
  const std::lock_guard<std::mutex> lock(state_->mutex);
  frame_.index = state_->status.num_pairs++;
  if (state_->has_newest) ++state_->status.num_skipped;
  if (state_->status.state != OpenNIState::kStreaming)
    state_->messages.emplace_back(LogLevel::kInfo, "camera '" + device_.uri + "' sends again");
  state_->status.state = OpenNIState::kStreaming;
  state_->status.message.clear();
  std::swap(frame_, state_->newest);
  state_->has_newest = true;
  state_->for_reader.notify_all();
}

/// Takes the images that have arrived and publishes the pairs among them.
void Worker::collect(CameraDevice& camera, Pairer& pairer) {
  state_->set_activity("reading images");
  const auto time_s = [&](const openni::VideoFrameRef& image) {
    return stamps_trusted_ ? 1e-6 * static_cast<double>(image.getTimestamp()) : seconds_since(state_->start);
  };
  const std::int64_t dropped_before = pairer.num_dropped();
  if (const auto depth = camera.take_depth()) {
    ++num_depth_;
    if (!camera.has_colour()) {
      publish(camera, {*depth, openni::VideoFrameRef(), time_s(*depth)});
    } else if (const auto pair = pairer.add_depth(time_s(*depth), *depth))
      publish(camera, *pair);
  }
  if (const auto colour = camera.has_colour() ? camera.take_colour() : std::nullopt) {
    ++num_colour_;
    if (const auto pair = pairer.add_colour(time_s(*colour), *colour)) publish(camera, *pair);
  }
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->status.num_unmatched += pairer.num_dropped() - dropped_before;
}

/// Some drivers stamp depth and colour with clocks that have nothing in common; the time of arrival has to do for them.
void Worker::distrust_stamps(Pairer& pairer) {
  stamps_trusted_ = false;
  pairer.clear();
  state_->warn("camera '" + device_.uri + "' stamps depth and colour with different clocks; pairing them by the time of arrival");
}

Ending Worker::stream(CameraDevice& camera) {
  const double tolerance_s = settings_.pair_tolerance_ms > 0 ? 1e-3 * settings_.pair_tolerance_ms : 0.5 / settings_.fps;
  Pairer pairer(tolerance_s);
  const Clock::time_point opened = last_pair_ = Clock::now();
  stamps_trusted_ = true;
  num_pairs_ = num_depth_ = num_colour_ = 0;
  bool locked = false;
  while (wait(kPollInterval, state_->image_arrived)) {
    {
      const std::lock_guard<std::mutex> lock(state_->mutex);
      state_->image_arrived = false;
      if (state_->recording_ended) return Ending::kRecordingOver;
      if (state_->disconnected) return Ending::kUnplugged;
    }
    collect(camera, pairer);
    if (stamps_trusted_ && num_pairs_ == 0 && std::min(num_depth_, num_colour_) >= kImagesBeforeDistrust) distrust_stamps(pairer);
    if (!locked && ms_since(opened) >= settings_.settle_ms) {
      locked = true;
      camera.lock_exposure();
    }
    if (ms_since(last_pair_) < settings_.silence_timeout_ms) continue;
    return Ending::kSilent;
  }
  return Ending::kStop;
}

/// Streams until the source stops, and opens the camera again whenever it has gone. @throws FileError for a recording without images.
void Worker::stream_and_recover(std::unique_ptr<CameraDevice> camera, const Runtime& runtime) {
  while (camera != nullptr) {
    const Ending ending = stream(*camera);
    if (ending == Ending::kStop) return;
    if (is_recording(settings_.device)) {
      if (num_pairs_ == 0) throw FileError(recording_message(settings_.device, "no images came out of it"));
      state_->set_state(OpenNIState::kEnded, "");
      return;
    }
    if (ending == Ending::kUnplugged) state_->set_state(OpenNIState::kWaitingForDevice, unplugged_message(device_.uri));
    if (ending == Ending::kSilent) {
      state_->set_state(OpenNIState::kSilent, silence_message(num_depth_ > 0, num_colour_ > 0, settings_.silence_timeout_ms));
      synchronise_ = false;  // a synchronised camera sends nothing at all if one sensor fails, and hides which
    }
    camera.reset();
    camera = reopen(runtime);
  }
}

void Worker::run() {
  state_->set_activity("loading OpenNI2's drivers");
  const Runtime runtime;
  const HotplugListener listener(hotplug_callbacks(state_));
  std::unique_ptr<CameraDevice> camera = open(choose_device(settings_.device, runtime.devices()));
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->opened = true;
    state_->for_reader.notify_all();
  }
  stream_and_recover(std::move(camera), runtime);
  state_->set_activity("shutting OpenNI2 down");
}

}  // namespace

void run_capture(const std::shared_ptr<CaptureState>& state) {
  std::exception_ptr error;
  try {
    Worker(state).run();
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(state->mutex);
  state->activity.clear();
  state->error = error;
  state->finished = true;
  state->for_reader.notify_all();
}

}  // namespace foothold::capture
