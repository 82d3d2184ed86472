// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/refining_relocaliser.h"

namespace foothold {

RefiningRelocaliser::RefiningRelocaliser(Relocaliser& inner, const TsdfVolume& volume, const PoseRefinerSettings& settings)
    : inner_(inner), volume_(volume), refiner_(volume.context(), settings, volume.settings().depth_range()) {}

std::vector<PoseEstimate> RefiningRelocaliser::relocalise(const Frame& frame) {
  const std::vector<PoseEstimate> proposals = inner_.relocalise(frame);
  last_refined_ = refiner_.refine(frame, volume_, proposals);
  if (last_refined_.empty() || !last_refined_.front().accepted) return {};
  return {{last_refined_.front().world_from_camera, last_refined_.front().probability}};
}

}  // namespace foothold
