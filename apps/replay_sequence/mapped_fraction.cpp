// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "mapped_fraction.h"

#include "foothold/frames/frame_uploader.h"

namespace foothold::replay {

double mapped_fraction(const Context& context, const FusionPipeline& pipeline, const Frame& frame_host, const SE3& world_from_camera) {
  FrameUploader uploader(context);
  const Frame frame = uploader.upload(frame_host);
  const FusionSettings& settings = pipeline.settings();
  SurfaceMap rendering(context.memory());
  const RenderCamera camera{frame.calibration.depth, frame.depth.width, frame.depth.height, world_from_camera};
  Raycaster(context).render(pipeline.volume(), camera.reduced(settings.render_divisor), rendering, true);
  ViewComparer comparer(context, settings.volume.depth_range());
  comparer.set_frame(frame);
  return static_cast<double>(comparer.compare(rendering, world_from_camera).overlap);
}

}  // namespace foothold::replay
