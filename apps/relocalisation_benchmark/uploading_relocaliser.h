// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Feeds frames in host memory to a relocaliser that works in its device's.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"

namespace foothold::benchmark {

/// Copies every frame to the memory of a context before it hands it on: the price of recordings, traced as stage "upload".
class UploadingRelocaliser : public Relocaliser {
 public:
  /// @pre The relocaliser works in the context's memory.
  UploadingRelocaliser(const Context& context, std::unique_ptr<Relocaliser> relocaliser);

  void train(const Frame& frame, const SE3& world_from_camera) override;
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override { relocaliser_->update(); }
  void reset() override { relocaliser_->reset(); }
  std::size_t state_bytes() const override { return relocaliser_->state_bytes(); }
  float acceptance_threshold() const override { return relocaliser_->acceptance_threshold(); }

 private:
  /// The frame in the context's memory, valid until the next call. @pre The frame is in host memory.
  Frame upload(const Frame& frame);

  Context context_;
  std::unique_ptr<Relocaliser> relocaliser_;
  Array<float> depth_;
  Array<std::uint8_t> colour_;
};

}  // namespace foothold::benchmark
