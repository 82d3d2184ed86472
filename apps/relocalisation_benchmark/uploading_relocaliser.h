// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Feeds frames in host memory to a relocaliser that works in its device's.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/relocaliser_decorator.h"
#include "foothold/base/context.h"
#include "foothold/frames/frame_uploader.h"

namespace foothold::benchmark {

/// Copies every frame to the memory of a context before it hands it on: the price of recordings, traced as stage "upload".
class UploadingRelocaliser : public RelocaliserDecorator {
 public:
  /// @pre The relocaliser works in the context's memory.
  UploadingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser);

  void train(const Frame& frame, const SE3& world_from_camera) override;
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;

 private:
  FrameUploader uploader_;
};

}  // namespace foothold::benchmark
