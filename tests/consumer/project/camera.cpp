// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A host with a camera and no tracker: it reconstructs a walk through a painted room, saves the scene, and finds itself in it again.
#include <cstdio>

#include "foothold/reconstruction/reconstruction.h"
#include "room.h"

namespace {

constexpr int kSteps = 10;

foothold::ReconstructionSettings coarse_settings() {
  foothold::ReconstructionSettings settings;
  settings.fusion.volume.voxel_size_m = 0.02F;
  settings.fusion.volume.truncation_m = 0.08F;
  return settings;
}

/// The walk, looking into a corner: three walls hold a camera that is tracked by their shape, and one does not.
foothold::SE3 pose_at(int step) {
  foothold::Tangent6 turn;
  turn << 0.5F, 0.8F, 0.0F, 0.0F, 0.0F, 0.0F;
  return foothold::se3_exp(turn) * room::pose_at(step);
}

/// How far a pose is from the one at a step, or from any if there is none [m].
float error_m(const foothold::FusionFrameResult& result, int step) {
  if (!result.world_from_camera.has_value()) return 1e9F;
  return foothold::translation_distance_m(*result.world_from_camera, pose_at(step));
}

}  // namespace

int main() {
  const foothold::Context context;
  foothold::Reconstruction first(context, coarse_settings());
  first.start_at(pose_at(0));
  float tracked_m = 0.0F;
  for (int step = 0; step <= kSteps; ++step) tracked_m = error_m(first.process(room::render(pose_at(step)).frame()), step);
  first.save("room.scene", {{"source", "a painted room"}});

  foothold::Reconstruction second(context, coarse_settings());
  second.load("room.scene");
  const float found_m = error_m(second.process(room::render(pose_at(kSteps / 2)).frame()), kSteps / 2);
  std::printf("reconstruction: tracked to %.1f mm, found again to %.1f mm\n", 1e3 * static_cast<double>(tracked_m),
              1e3 * static_cast<double>(found_m));
  return tracked_m < 0.02F && found_m < 0.02F ? 0 : 1;
}
