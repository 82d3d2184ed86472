// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A host with images of its own: it teaches each relocaliser a walk through a painted room, loses track, and asks where it is.
#include <cstdio>
#include <memory>
#include <vector>

#include "foothold/relocalisation/forest_relocaliser.h"
#include "foothold/relocalisation/keyframe_relocaliser.h"
#include "room.h"

namespace {

using room::pose_at;
using room::render;

bool recovers(foothold::Relocaliser& relocaliser, const char* name) {
  constexpr int kLost = 20;
  for (int step = 0; step <= kLost; ++step) {
    relocaliser.train(render(pose_at(step)).frame(), pose_at(step));
    relocaliser.update();
  }
  const std::vector<foothold::PoseEstimate> estimates = relocaliser.relocalise(render(pose_at(kLost)).frame());
  if (estimates.empty()) {
    std::printf("%s: found nothing\n", name);
    return false;
  }
  const float error_m = foothold::translation_distance_m(estimates.front().world_from_camera, pose_at(kLost));
  std::printf("%s: %zu estimates, the best off by %.1f mm with confidence %.2f\n", name, estimates.size(),
              static_cast<double>(error_m) * 1e3, static_cast<double>(estimates.front().confidence));
  return error_m < 0.25F;
}

}  // namespace

int main() {
  const foothold::Context context;
  std::vector<std::unique_ptr<foothold::Relocaliser>> relocalisers;
  relocalisers.push_back(std::make_unique<foothold::ForestRelocaliser>(context));
  relocalisers.push_back(std::make_unique<foothold::KeyframeRelocaliser>(context));
  return recovers(*relocalisers[0], "forest") && recovers(*relocalisers[1], "ferns") ? 0 : 1;
}
