// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/reconstruction_monitor.h"

#include <algorithm>
#include <cmath>

namespace foothold::apps {
namespace {

/// Weight of the newest frame in shown times: numbers that people can read.
constexpr double kNewestWeight = 0.1;
/// Width of the rendered map [px].
constexpr int kRenderedWidth = 320;
/// Every so many fused frames feed the map from above.
constexpr int kMapInterval = 5;
/// For how many frames a relocalisation is news.
constexpr int kNewsFrames = 20;
constexpr std::size_t kMaxHistory = 1000;
/// The stages of a frame in the order in which they are shown.
constexpr const char* kStages[] = {"track", "relocalise", "fuse", "train", "render"};

std::string frames_text(int num_frames) { return std::to_string(num_frames) + (num_frames == 1 ? " frame" : " frames"); }

}  // namespace

Image<Rgb8> shaded_picture(const SurfaceMap& map) {
  const std::vector<SurfacePixel> pixels = map.pixels.to_host();
  const std::vector<Rgb8> colours = map.colours.to_host();
  Image<Rgb8> image(map.camera.width, map.camera.height, Rgb8{28, 33, 40});
  for (std::size_t i = 0; i < image.size() && i < colours.size(); ++i) {
    if (pixels[i].depth_m <= 0.0F) continue;
    const float light = pixels[i].has_normal() ? 0.45F + 0.55F * std::min(1.0F, std::abs(pixels[i].normal_z)) : 0.6F;
    const auto lit = [&](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(light * static_cast<float>(c))); };
    image.data()[i] = {lit(colours[i].r), lit(colours[i].g), lit(colours[i].b)};
  }
  return image;
}

ViewState view_state(RecoveryState state) {
  switch (state) {
    case RecoveryState::kTracking:
      return ViewState::kTracking;
    case RecoveryState::kSettling:
      return ViewState::kSettling;
    case RecoveryState::kLost:
      break;
  }
  return ViewState::kLost;
}

ReconstructionMonitor::ReconstructionMonitor(const Context& context, ModelDetail detail)
    : detail_(detail), raycaster_(std::make_shared<Raycaster>(context)), memory_(context.memory()) {}

void ReconstructionMonitor::smooth(const std::string& stage, double ms) {
  const auto [known, is_new] = smoothed_ms_.try_emplace(stage, ms);
  if (!is_new) known->second += kNewestWeight * (ms - known->second);
}

void ReconstructionMonitor::add(const FusionPipeline& pipeline, const FusionFrameResult& result, bool event) {
  const double stages_ms[] = {result.track_ms, result.relocalise_ms, result.fuse_ms, result.train_ms, result.render_ms};
  for (std::size_t i = 0; i < std::size(stages_ms); ++i) smooth(kStages[i], stages_ms[i]);
  smoothed_total_ms_ += (smoothed_total_ms_ == 0.0 ? 1.0 : kNewestWeight) * (result.total_ms - smoothed_total_ms_);
  if (since_last_.has_value()) {
    const double interval_ms = since_last_->elapsed_ms();
    smoothed_interval_ms_ += (smoothed_interval_ms_ == 0.0 ? 1.0 : kNewestWeight) * (interval_ms - smoothed_interval_ms_);
  }
  since_last_.emplace();

  const ViewState state = view_state(result.state);
  if (result.state == RecoveryState::kLost) {
    num_lost_ = last_.state == RecoveryState::kLost ? num_lost_ + 1 : 1;
  } else if (result.relocalised && last_.state != RecoveryState::kLost) {
    num_lost_ = 0;
  }
  if (frames_since_relocalised_ >= 0) ++frames_since_relocalised_;
  if (result.relocalised) frames_since_relocalised_ = 0;
  if (history_.size() == kMaxHistory) history_.erase(history_.begin());
  history_.push_back({state, result.confidence, result.relocalised, event});
  if (result.world_from_camera.has_value()) {
    const bool joined = last_.world_from_camera.has_value() && !result.relocalised;
    map_.add_stop(*result.world_from_camera, state, result.relocalised, joined);
    world_from_camera_ = result.world_from_camera;
  }
  if (result.fused && num_fused_++ % kMapInterval == 0) map_.add_surfaces(pipeline.rendering());
  last_ = result;
}

void ReconstructionMonitor::clear() {
  map_.clear();
  history_.clear();
  world_from_camera_.reset();
  last_ = FusionFrameResult();
  num_lost_ = 0;
  frames_since_relocalised_ = -1;
  num_fused_ = 0;
}

std::string ReconstructionMonitor::state_note() const {
  if (last_.state == RecoveryState::kLost) return "for " + frames_text(num_lost_);
  if (frames_since_relocalised_ >= 0 && frames_since_relocalised_ < kNewsFrames)
    return num_lost_ == 0 ? "at once" : "after " + frames_text(num_lost_);
  if (last_.state == RecoveryState::kSettling) return "the map waits for steady tracking";
  return {};
}

void ReconstructionMonitor::render_model(const RgbdFrame& frame, const FusionPipeline& pipeline, ViewContents& contents) {
  contents.model_is_current = last_.world_from_camera.has_value();
  contents.model_caption = contents.model_is_current ? "map from the camera" : "map from where the camera was last seen";
  if (!world_from_camera_.has_value() || pipeline.rendering().empty()) return;
  if (detail_ == ModelDetail::kCoarse || !is_valid(frame.calibration.depth) || frame.depth.empty()) {
    contents.model = shaded_picture(pipeline.rendering());
    return;
  }
  const float factor = static_cast<float>(kRenderedWidth) / static_cast<float>(frame.depth.width());
  const RenderCamera camera{frame.calibration.depth.scaled(factor), kRenderedWidth,
                            std::max(1, static_cast<int>(factor * static_cast<float>(frame.depth.height()))), *world_from_camera_};
  SurfaceMap rendering(memory_);
  raycaster_->render(pipeline.volume(), camera, rendering, true);
  contents.model = shaded_picture(rendering);
}

ViewContents ReconstructionMonitor::contents(const RgbdFrame& frame, const FusionPipeline& pipeline) {
  ViewContents contents;
  contents.colour = frame.colour;
  contents.depth_m = frame.depth;
  contents.max_depth_m = pipeline.settings().volume.max_depth_m;
  render_model(frame, pipeline, contents);
  contents.state = history_.empty() ? ViewState::kWaiting : view_state(last_.state);
  contents.relocalised = last_.state != RecoveryState::kLost && frames_since_relocalised_ >= 0 && frames_since_relocalised_ < kNewsFrames;
  contents.state_note = history_.empty() ? std::string() : state_note();
  contents.confidence = last_.confidence;
  for (const char* stage : kStages) {
    const auto found = smoothed_ms_.find(stage);
    if (found != smoothed_ms_.end()) contents.timings.push_back({stage, found->second});
  }
  const auto view = smoothed_ms_.find("view");
  if (view != smoothed_ms_.end()) contents.view_ms = view->second;
  contents.total_ms = smoothed_total_ms_;
  contents.frames_per_second = smoothed_interval_ms_ > 0.0 ? 1000.0 / smoothed_interval_ms_ : 0.0;
  contents.history = history_;
  contents.map = map_.contents();
  if (contents.map.camera.has_value()) contents.map.camera->is_current = contents.model_is_current;
  return contents;
}

}  // namespace foothold::apps
