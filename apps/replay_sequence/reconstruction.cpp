// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "reconstruction.h"

#include "foothold/relocalisation/forest_relocaliser.h"

namespace foothold::replay {
namespace {

Forest make_forest(const std::string& choice, const ReplaySettings& settings) {
  if (choice == "default") return default_forest();
  if (choice == "random") return make_random_forest(settings.random_forest);
  return load_forest(choice);
}

template <class Kind>
std::unique_ptr<Relocaliser> copy_of(const Relocaliser& relocaliser) {
  return std::make_unique<Kind>(static_cast<const Kind&>(relocaliser));
}

}  // namespace

Reconstruction::Reconstruction(const Context& context, const ReplayOptions& options, const ReplaySettings& settings)
    : context_(context), uploader_(context) {
  if (options.method == "forest") {
    relocaliser_ = std::make_unique<ForestRelocaliser>(context, make_forest(options.forest, settings), settings.forest);
    copy_relocaliser_ = copy_of<ForestRelocaliser>;
  } else if (options.method == "ferns") {
    relocaliser_ = std::make_unique<KeyframeRelocaliser>(context, settings.ferns);
    copy_relocaliser_ = copy_of<KeyframeRelocaliser>;
  }
  pipeline_ = std::make_unique<FusionPipeline>(context, settings.fusion, relocaliser_.get());
}

Reconstruction::Reconstruction(const Reconstruction& other)
    : context_(other.context_),
      relocaliser_(other.relocaliser_ == nullptr ? nullptr : other.copy_relocaliser_(*other.relocaliser_)),
      copy_relocaliser_(other.copy_relocaliser_),
      pipeline_(std::make_unique<FusionPipeline>(*other.pipeline_, relocaliser_.get())),
      uploader_(context_) {}

FusionFrameResult Reconstruction::process(const Frame& frame_host) { return pipeline_->process(uploader_.upload(frame_host)); }

double Reconstruction::mapped_fraction(const Frame& frame_host, const SE3& world_from_camera) {
  const Frame frame = uploader_.upload(frame_host);
  const FusionSettings& settings = pipeline_->settings();
  SurfaceMap rendering(context_.memory());
  const RenderCamera camera{frame.calibration.depth, frame.depth.width, frame.depth.height, world_from_camera};
  Raycaster(context_, settings.raycaster).render(pipeline_->volume(), camera.reduced(settings.render_divisor), rendering, true);
  ViewCheck check(context_, settings.refiner.check);
  check.set_frame(frame);
  return static_cast<double>(check.compare(rendering, world_from_camera).overlap);
}

}  // namespace foothold::replay
