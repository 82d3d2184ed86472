// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/api/background_relocaliser.h"

#include "foothold/base/contract.h"

namespace foothold {

Frame BackgroundRelocaliser::copy(const Frame& frame) {
  Frame copied = frame;
  depth_m_.assign(frame.depth.data, frame.depth.data + frame.depth.size());
  colour_.assign(frame.colour.data, frame.colour.data + frame.depth.size() * static_cast<std::size_t>(frame.colour.bytes_per_pixel));
  copied.depth.data = depth_m_.data();
  copied.colour.data = colour_.data();
  return copied;
}

void BackgroundRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  wait();
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
  FOOTHOLD_EXPECTS_NO_ERROR(describe_pose_error(world_from_camera));
  if (!queue_.is_beside() || frame.depth.memory != MemoryKind::kHost) return inner().train(frame, world_from_camera);
  queue_.add([this, copied = copy(frame), world_from_camera] { inner().train(copied, world_from_camera); });
}

std::vector<PoseEstimate> BackgroundRelocaliser::relocalise(const Frame& frame) {
  wait();
  return inner().relocalise(frame);
}

void BackgroundRelocaliser::update() {
  queue_.add([this] { inner().update(); });
}

void BackgroundRelocaliser::reset() {
  wait();
  inner().reset();
}

std::size_t BackgroundRelocaliser::state_bytes() const {
  wait();
  return inner().state_bytes();
}

float BackgroundRelocaliser::acceptance_threshold() const {
  wait();
  return inner().acceptance_threshold();
}

}  // namespace foothold
