// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/reconstruction.h"

namespace foothold::apps {

Reconstruction::Reconstruction(const Context& context, const FusionSettings& settings, std::unique_ptr<Relocaliser> relocaliser,
                               Copy copy_relocaliser)
    : context_(context),
      relocaliser_(std::move(relocaliser)),
      copy_relocaliser_(std::move(copy_relocaliser)),
      pipeline_(std::make_unique<FusionPipeline>(context, settings, relocaliser_.get())),
      uploader_(context) {}

Reconstruction::Reconstruction(const Reconstruction& other)
    : context_(other.context_),
      relocaliser_(other.relocaliser_ == nullptr ? nullptr : other.copy_relocaliser_(*other.relocaliser_)),
      copy_relocaliser_(other.copy_relocaliser_),
      pipeline_(std::make_unique<FusionPipeline>(*other.pipeline_, relocaliser_.get())),
      uploader_(context_) {}

double Reconstruction::mapped_fraction(const Frame& frame_host, const SE3& world_from_camera) {
  const Frame frame = uploader_.upload(frame_host);
  const FusionSettings& settings = pipeline_->settings();
  SurfaceMap rendering(context_.memory());
  const RenderCamera camera{frame.calibration.depth, frame.depth.width, frame.depth.height, world_from_camera};
  Raycaster(context_).render(pipeline_->volume(), camera.reduced(settings.render_divisor), rendering, true);
  ViewComparer comparer(context_, settings.volume.depth_range());
  comparer.set_frame(frame);
  return static_cast<double>(comparer.compare(rendering, world_from_camera).overlap);
}

}  // namespace foothold::apps
