// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "protocol_run.h"

#include <algorithm>
#include <limits>

#include "call_meter.h"
#include "foothold/base/error.h"

namespace foothold {
namespace {

/// Reads that may time out in a row before an input counts as dead.
constexpr int kMaxTimeouts = 100;

bool has_depth(const RgbdFrame& frame) { return std::any_of(frame.depth.data(), frame.depth.data() + frame.depth.size(), is_valid_depth); }

}  // namespace

bool FrameReader::read(RgbdFrame& frame) {
  for (int num_timeouts = 0; num_timeouts < kMaxTimeouts;) {
    const ReadStatus status = source_->read(frame);
    if (status == ReadStatus::kEnd) return false;
    if (status == ReadStatus::kTimedOut) {
      ++num_timeouts;
      continue;
    }
    num_timeouts = 0;
    const std::string malformed = describe_frame_error(frame.view());
    if (!malformed.empty()) throw FileError(name_ + ", frame " + std::to_string(frame.index) + ": " + malformed);
    if (frame.world_from_camera.has_value()) {
      num_without_depth_ += has_depth(frame) ? 0 : 1;
      return true;
    }
    ++num_without_pose_;
  }
  throw FileError(name_ + ": delivered no frame in " + std::to_string(kMaxTimeouts) + " attempts");
}

void ProtocolRun::train(const RgbdFrame& frame) {
  if (!has_depth(frame)) return;
  measure_call(log_.train, options_.trace, [&] { relocaliser_.train(frame.view(), *frame.world_from_camera); });
  log_.trained_world_from_camera.push_back(*frame.world_from_camera);
}

void ProtocolRun::test(const RgbdFrame& frame, int input_index) {
  std::vector<PoseEstimate> estimates;
  if (has_depth(frame)) {
    measure_call(log_.relocalise, options_.trace, [&] { estimates = relocaliser_.relocalise(frame.view()); });
  }
  TestRecord record;
  record.input_index = input_index;
  record.frame_index = frame.index;
  record.num_trained = static_cast<int>(log_.trained_world_from_camera.size());
  record.world_from_camera_true = *frame.world_from_camera;
  record.error = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (!estimates.empty()) {
    record.best = estimates.front();
    record.error = pose_error(record.best->world_from_camera, record.world_from_camera_true);
  }
  num_found_ += record.within(kFoundThreshold) ? 1 : 0;
  log_.tests.push_back(record);
}

void ProtocolRun::update() {
  measure_call(log_.update, options_.trace, [&] { relocaliser_.update(); });
}

void ProtocolRun::report(int num_done, int num_total) const {
  if (options_.progress) options_.progress({num_done, num_total, static_cast<int>(log_.tests.size()), num_found_});
}

void ProtocolRun::count(const FrameReader& reader) {
  log_.num_without_pose += reader.num_without_pose();
  log_.num_without_depth += reader.num_without_depth();
}

RunLog ProtocolRun::finish() {
  log_.state_bytes = relocaliser_.state_bytes();
  log_.acceptance_threshold = relocaliser_.acceptance_threshold();
  return std::move(log_);
}

}  // namespace foothold
