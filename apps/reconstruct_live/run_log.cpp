// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "run_log.h"

#include "common/json.h"

#include "common/log.h"
#include "foothold/base/trace.h"

namespace foothold::live {
namespace {

using apps::Json;

constexpr int kFormatVersion = 1;

std::string frames_text(int num_frames) { return std::to_string(num_frames) + (num_frames == 1 ? " frame" : " frames"); }

Json camera_json(const OpenNIStatus& status) {
  return {{"uri", status.device.uri},        {"name", status.device.vendor + " " + status.device.name},
          {"registered", status.registered}, {"pairs", status.num_pairs},
          {"skipped", status.num_skipped},   {"without_partner", status.num_unmatched},
          {"reopened", status.num_reopened}};
}

Json recording_json(const RecordingThread* recording, const std::string& folder) {
  if (recording == nullptr) return nullptr;
  const RecordingThread::Progress progress = recording->progress();
  return {{"folder", folder}, {"written", progress.num_written}, {"dropped", progress.num_dropped}};
}

}  // namespace

std::string RunLog::add(double timestamp_s, const FusionFrameResult& result) {
  const std::int64_t frame = num_frames_++;
  state_ = result.state;
  frame_ms_.push_back(result.total_ms);
  num_fused_ += result.fused ? 1 : 0;
  num_relocalised_ += result.relocalised ? 1 : 0;
  num_blocks_refused_ += result.num_blocks_refused;
  const std::string where = "frame " + std::to_string(frame) + ": ";
  if (!result.world_from_camera.has_value()) {
    const bool is_new = !is_lost_;
    if (is_new) losses_.push_back({frame, timestamp_s, 0, false});
    is_lost_ = true;
    ++losses_.back().num_frames;
    return is_new ? where + "tracking lost" : std::string();
  }
  ++num_with_pose_;
  trajectory_.push_back({timestamp_s, *result.world_from_camera});
  if (!is_lost_ && !result.relocalised) return {};
  const bool is_new = !is_lost_;
  if (is_new) losses_.push_back({frame, timestamp_s, 0, false});
  is_lost_ = false;
  losses_.back().recovered = true;
  const int num_lost = losses_.back().num_frames;
  return where + (is_new ? "tracking lost, " : "") + "relocalised " + (num_lost == 0 ? "at once" : "after " + frames_text(num_lost));
}

void RunLog::begin_world() {
  trajectory_.clear();
  is_lost_ = false;
}

void RunLog::begin_lost() {
  losses_.push_back({num_frames_, 0.0, 0, false});
  is_lost_ = true;
}

std::string RunLog::to_json(const Surroundings& surroundings) const {
  Json losses = Json::array();
  for (const Loss& loss : losses_) {
    losses.push_back(
        {{"frame", loss.frame}, {"timestamp_s", loss.timestamp_s}, {"lost_frames", loss.num_frames}, {"recovered", loss.recovered}});
  }
  Json json{{"format_version", kFormatVersion}, {"program", "reconstruct_live"}, {"ended_by", surroundings.ended_by}};
  json["camera"] = camera_json(surroundings.camera);
  json["frames"] = {{"processed", num_frames_}, {"with_pose", num_with_pose_}, {"fused", num_fused_}, {"relocalised", num_relocalised_}};
  json["losses"] = losses;
  json["final_state"] = to_string(state_);
  json["map_blocks"] = surroundings.num_blocks;
  json["blocks_refused"] = num_blocks_refused_;
  if (!frame_ms_.empty()) json["frame_ms"] = {{"median", quantile(frame_ms_, 0.5)}, {"p95", quantile(frame_ms_, 0.95)}};
  json["recording"] = recording_json(surroundings.recording, surroundings.record_folder);
  json["loaded_scene"] = surroundings.loaded_scene.empty() ? Json(nullptr) : Json(surroundings.loaded_scene);
  json["saved"] = surroundings.saved;
  json["errors"] = surroundings.errors;
  json["warnings"] = apps::warnings();
  return json.dump() + "\n";
}

}  // namespace foothold::live
