// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The view of a replay: in a window, as pictures in a folder, both or neither.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/reconstruction_monitor.h"
#include "common/view_window.h"
#include "options.h"

namespace foothold::replay {

/// Costs nothing if nothing is to be shown.
class ReplayView {
 public:
  /// Opens the window and makes the folder. @throws DeviceError, FileError
  ReplayView(const Context& context, const ReplayOptions& options);

  /// Shows a frame that was processed.
  /// @param event  What happened to the camera before it, in words; empty if nothing did.
  /// @throws FileError if a picture cannot be written.
  void add(const RgbdFrame& frame, const FusionPipeline& pipeline, const FusionFrameResult& result, const std::string& event);
  /// Follows a copy of the reconstruction until end_branch(); then goes on as if nothing had been.
  void begin_branch();
  void end_branch();
  /// Forgets what was shown: another run begins.
  void start_again(const std::string& what);
  /// Whether the user wants to end the replay.
  bool ended() const { return ended_; }

 private:
  bool is_active() const { return window_ != nullptr || !folder_.empty(); }
  void draw(const RgbdFrame& frame, const FusionPipeline& pipeline);
  void heed_keys(int key, apps::ViewContents& contents);

  apps::ReconstructionMonitor monitor_;
  std::optional<apps::ReconstructionMonitor> main_monitor_;  // while following a branch
  std::unique_ptr<apps::ViewWindow> window_;
  std::string folder_;
  std::string title_;
  std::string run_;
  std::string notice_;
  int every_;
  int num_added_ = 0;
  bool show_help_ = false;
  bool ended_ = false;
};

}  // namespace foothold::replay
