// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Maps with the pose of their camera: what is accepted is saved again as the same, is rendered and meshed, and the camera goes on in it.
#include <sstream>

#include "checked_file.h"
#include "foothold/fusion/surface_mesh.h"
#include "small_fusion.h"

FOOTHOLD_FUZZ_TARGET(map) {
  using namespace foothold;
  fuzz::attempt([&] {
    FusionPipeline pipeline(fuzz::one_thread(), fuzz::small_fusion_settings(), nullptr);
    const std::string file = fuzz::mended(fuzz::text_of(data, size));
    std::istringstream stream(file);
    pipeline.load(stream);
    std::ostringstream saved;
    pipeline.save(saved);
    fuzz::require(saved.str() == file.substr(0, saved.str().size()));
    for (const auto& triangle : extract_mesh(pipeline.volume()).triangles) fuzz::require(triangle[0] >= 0);
    for (const int index : {0, 1}) {
      const FusionFrameResult result = pipeline.process(fuzz::small_frame(index).view());
      if (result.world_from_camera.has_value()) fuzz::require(is_rigid(*result.world_from_camera));
    }
  });
  return 0;
}
