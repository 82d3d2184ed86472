// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The README's example, compiled; tests/checks/documents.py compares the two.
// clang-format off
// [begin]
#include "foothold/relocalisation/forest_relocaliser.h"

foothold::ForestRelocaliser relocaliser{foothold::Context{}};

void after_tracking(const foothold::Frame& frame, bool tracked, foothold::SE3& world_from_camera) {
  if (tracked) {
    relocaliser.train(frame, world_from_camera);
  } else if (const auto found = relocaliser.relocalise(frame); !found.empty() && found[0].confidence >= relocaliser.acceptance_threshold()) {
    world_from_camera = found[0].world_from_camera;  // then refine it by tracking as usual
  }
  relocaliser.update();  // spare time
}
// [end]
