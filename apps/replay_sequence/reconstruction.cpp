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
    : context_(context), depth_(context.memory()), colour_(context.memory()) {
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
      depth_(context_.memory()),
      colour_(context_.memory()) {}

Frame Reconstruction::upload(const Frame& frame_host) {
  if (context_.memory() == MemoryKind::kHost || !describe_frame_error(frame_host).empty()) return frame_host;
  Frame frame = frame_host;
  depth_.assign({frame.depth.data, frame.depth.size()});
  colour_.assign({frame.colour.data, frame.depth.size() * static_cast<std::size_t>(frame.colour.bytes_per_pixel)});
  frame.depth.data = depth_.data();
  frame.depth.memory = context_.memory();
  frame.colour.data = colour_.data();
  frame.colour.memory = context_.memory();
  return frame;
}

FusionFrameResult Reconstruction::process(const Frame& frame_host) { return pipeline_->process(upload(frame_host)); }

double Reconstruction::mapped_fraction(const Frame& frame_host, const SE3& world_from_camera) {
  const Frame frame = upload(frame_host);
  const FusionSettings& settings = pipeline_->settings();
  SurfaceMap rendering(context_.memory());
  const RenderCamera camera{frame.calibration.depth, frame.depth.width, frame.depth.height, world_from_camera};
  Raycaster(context_, settings.raycaster).render(pipeline_->volume(), camera.reduced(settings.render_divisor), rendering, true);
  ViewCheck check(context_, settings.refiner.check);
  check.set_frame(frame);
  return static_cast<double>(check.compare(rendering, world_from_camera).overlap);
}

}  // namespace foothold::replay
