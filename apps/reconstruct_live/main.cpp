// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// reconstruct_live: a camera that OpenNI2 drives, recorded as it goes.
#include <cstdio>
#include <memory>
#include <string>

#include "common/app_main.h"
#include "foothold/openni/openni_source.h"
#include "options.h"
#include "recording_thread.h"

namespace foothold::live {
namespace {

int list_devices() {
  const std::vector<OpenNIDeviceInfo> devices = list_openni_devices();
  if (devices.empty()) throw DeviceError(openni_no_device_advice());
  std::fputs(describe_devices(devices).c_str(), stdout);
  return apps::kSuccess;
}

/// What the run came to, in one line each.
void print_summary(const OpenNIStatus& status, const RecordingThread* recording) {
  std::printf("camera: %lld pairs, %lld skipped, %lld images without a partner, reopened %lld times\n",
              static_cast<long long>(status.num_pairs), static_cast<long long>(status.num_skipped),
              static_cast<long long>(status.num_unmatched), static_cast<long long>(status.num_reopened));
  if (recording == nullptr) return;
  const RecordingThread::Progress progress = recording->progress();
  std::printf("recording: %d frames written, %d dropped\n", progress.num_written, progress.num_dropped);
}

int run(const LiveOptions& options) {
  if (options.list_devices) return list_devices();
  const LiveSettings settings = live_settings(options);
  OpenNISource source(settings.camera, camera_calibration(options), apps::log_to_stderr());
  std::unique_ptr<RecordingThread> recording;
  if (!options.record_folder.empty()) recording = std::make_unique<RecordingThread>(options.record_folder);

  RgbdFrame frame;
  for (int num_frames = 0; !apps::interrupted() && (options.num_frames == 0 || num_frames < options.num_frames);) {
    const ReadStatus result = source.read(frame);
    if (result == ReadStatus::kEnd) break;
    if (result == ReadStatus::kTimedOut) continue;
    ++num_frames;
    if (recording != nullptr) recording->add(frame);
  }
  const OpenNIStatus status = source.status();  // before the camera runs on while the rest of the recording is written
  if (recording != nullptr) recording->finish();
  print_summary(status, recording.get());
  return apps::interrupted() ? apps::kInterrupted : apps::kSuccess;
}

}  // namespace
}  // namespace foothold::live

int main(int argc, char** argv) {
  CLI::App app("Reads a camera that OpenNI2 drives.", "reconstruct_live");
  foothold::live::LiveOptions options;
  foothold::live::add_live_options(app, options);
  return foothold::apps::run_app(app, argc, argv, [&] { return foothold::live::run(options); });
}
