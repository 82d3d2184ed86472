// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A run of reconstruct_live: from opening the camera to saving what came of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/guide.h"
#include "common/reconstruction_monitor.h"
#include "foothold/openni/openni_source.h"
#include "foothold/reconstruction/reconstruction.h"
#include "live_view.h"
#include "options.h"
#include "recording_reader.h"
#include "recording_thread.h"
#include "run_log.h"

namespace foothold::live {

/// Reads the camera, reconstructs its newest frame, draws, heeds keys, and saves everything in the end, however the end comes.
class LiveRun {
 public:
  /// Loads the scene to go on with, opens the window and then the camera, whose frames are not to wait for it. @throws Error with what to
  /// do if anything is not as it must be.
  LiveRun(const LiveOptions& options, const LiveSettings& settings);

  /// Goes on until the user, a limit or a failure ends it. @return The process's exit code.
  int run();

 private:
  void loop();
  void take(RgbdFrame& frame);
  void hurry();
  void check_recording();
  void follow_camera();
  void press_scripted_keys();
  void obey(int key);
  void reset(const std::string& notice);
  void begin_world(bool is_loaded);
  void save_scene(const std::string& path);
  void load_scene(const std::string& path);
  void save_mesh(const std::string& path);
  void draw();
  apps::ViewContents contents();
  std::string counters() const;
  void say(const std::string& notice);
  bool limit_is_reached();
  std::vector<SettingText> provenance() const;

  template <class Save>
  void attempt(const std::string& path, Save&& save);
  void save_all();
  void save_reconstruction();
  void print_summary(const OpenNIStatus& status) const;

  const LiveOptions options_;
  std::vector<ScriptedKey> keys_;
  Context context_;

  std::unique_ptr<Reconstruction> reconstruction_;  // these two are null if frames are only recorded
  std::unique_ptr<apps::ReconstructionMonitor> monitor_;
  std::unique_ptr<LiveView> view_;
  std::unique_ptr<OpenNISource> source_;
  std::unique_ptr<RecordingThread> recording_;
  std::unique_ptr<RecordingReader> reader_;  // only if frames are only recorded
  RunLog log_;
  apps::Guide guide_;
  bool is_hurried_ = false;  // frames are skipped: nothing is drawn finely any more

  RgbdFrame frame_;       // the newest
  RgbdFrame next_frame_;  // being read; its memory is reused
  bool recording_failed_ = false;
  std::int64_t num_taken_ = 0;
  OpenNIStatus status_;
  std::int64_t num_reopened_ = 0;
  bool event_ = false;  // something happened to the camera since the last frame
  bool paused_ = false;
  bool show_help_ = false;
  std::string notice_;
  std::string scene_path_;  // the scene saved or loaded last
  std::string loaded_scene_;
  std::string ended_by_;
  std::vector<std::string> saved_;
  std::vector<std::string> errors_;
  Stopwatch since_start_;
};

}  // namespace foothold::live
