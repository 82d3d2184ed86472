// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "uploading_relocaliser.h"

#include <utility>

#include "foothold/base/contract.h"

namespace foothold::benchmark {

UploadingRelocaliser::UploadingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser)
    : context_(context), relocaliser_(std::move(relocaliser)), depth_(context.memory()), colour_(context.memory()) {}

void UploadingRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  relocaliser_->train(upload(frame), world_from_camera);
}

std::vector<PoseEstimate> UploadingRelocaliser::relocalise(const Frame& frame) { return relocaliser_->relocalise(upload(frame)); }

Frame UploadingRelocaliser::upload(const Frame& frame) {
  FOOTHOLD_EXPECTS(frame.depth.memory == MemoryKind::kHost && frame.colour.memory == MemoryKind::kHost);
  const ScopedStage stage(context_, "upload");
  const std::size_t num_colour_bytes = frame.depth.size() * static_cast<std::size_t>(frame.colour.bytes_per_pixel);
  depth_.assign({frame.depth.data, frame.depth.size()});
  colour_.assign({frame.colour.data, num_colour_bytes});
  Frame uploaded = frame;
  uploaded.depth.data = depth_.data();
  uploaded.depth.memory = depth_.memory();
  uploaded.colour.data = colour_.data();
  uploaded.colour.memory = colour_.memory();
  return uploaded;
}

}  // namespace foothold::benchmark
