// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Follows a FusionPipeline frame by frame and says what its picture shows.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/map_from_above.h"
#include "common/view_contents.h"
#include "foothold/api/frame.h"
#include "foothold/fusion/fusion_pipeline.h"

namespace foothold::apps {

/// The colour in which a state is shown.
ViewState view_state(RecoveryState state);

/// A rendered map as people see it: surfaces in their colour, darker where they turn away.
Image<Rgb8> shaded_picture(const SurfaceMap& map);

/// How the map is rendered for the view.
enum class ModelDetail {
  kCoarse,  ///< what the pipeline rendered for tracking: costs nothing
  kFine     ///< rendered once more, larger: several times as much work as tracking a frame
};

/// Gathers history, trajectory, map from above and timings. Adding frames is cheap, contents() is not. Copies are independent.
class ReconstructionMonitor {
 public:
  /// @param context  The pipeline's.
  explicit ReconstructionMonitor(const Context& context, ModelDetail detail = ModelDetail::kFine);

  /// Takes note of a processed frame.
  /// @param event  Something happened to the camera before this frame: a jump, a covered lens, a forced loss.
  void add(const FusionPipeline& pipeline, const FusionFrameResult& result, bool event = false);
  /// Takes note of what composing and showing the picture took.
  void add_drawing(double ms) { smooth("view", ms); }
  /// Shows a loaded map from above.
  void add_map(const Mesh& mesh) { map_.add_surfaces(mesh); }
  /// How the map is rendered from now on.
  void set_detail(ModelDetail detail) { detail_ = detail; }
  /// Forgets everything, as after FusionPipeline::reset().
  void clear();

  /// What the view shows now. Title, frame_text, notice, counters and keys are the app's to fill in.
  /// @param frame  The frame last processed, in host memory.
  ViewContents contents(const RgbdFrame& frame, const FusionPipeline& pipeline);

 private:
  void smooth(const std::string& stage, double ms);
  void render_model(const RgbdFrame& frame, const FusionPipeline& pipeline, ViewContents& contents);
  std::string state_note() const;

  ModelDetail detail_;
  std::shared_ptr<Raycaster> raycaster_;  // holds nothing but buffers, so copies share it
  Memory memory_;
  MapFromAbove map_;
  std::map<std::string, double> smoothed_ms_;
  double smoothed_total_ms_ = 0.0;
  double smoothed_interval_ms_ = 0.0;
  std::optional<Stopwatch> since_last_;
  std::vector<ViewMoment> history_;
  std::optional<SE3> world_from_camera_;  // the last known
  FusionFrameResult last_;
  int num_lost_ = 0;                   // frames in a row, or before the last recovery
  int frames_since_relocalised_ = -1;  // -1: never
  int num_fused_ = 0;
};

}  // namespace foothold::apps
