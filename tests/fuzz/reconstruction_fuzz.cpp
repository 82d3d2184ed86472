// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whole scenes: what is accepted goes on with the camera, and is a scene once saved again.
#include <sstream>

#include "checked_file.h"
#include "foothold/reconstruction/reconstruction.h"
#include "small_forest.h"
#include "small_fusion.h"

FOOTHOLD_FUZZ_TARGET(reconstruction) {
  using namespace foothold;
  static const Reconstruction empty(fuzz::one_thread(), {fuzz::small_fusion_settings(), fuzz::small_forest_settings()},
                                    fuzz::small_forest());
  fuzz::attempt([&] {
    Reconstruction reconstruction = empty;
    std::istringstream stream(fuzz::mended(fuzz::text_of(data, size), fuzz::Chain::kOfPrevious));
    reconstruction.load(stream, "a.scene");
    for (const int index : {0, 1}) {
      const FusionFrameResult result = reconstruction.process(fuzz::small_frame(index).view());
      if (result.world_from_camera.has_value()) fuzz::require(is_rigid(*result.world_from_camera));
    }
    std::stringstream saved;
    reconstruction.save(saved);
    reconstruction.load(saved, "a.scene");
  });
  return 0;
}
