// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A fusion pipeline with its relocaliser: what replay_sequence plays frames to.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "foothold/api/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "options.h"

namespace foothold::replay {

/// Takes frames in host memory, whatever the device. Copies are independent in everything.
class Reconstruction {
 public:
  /// @param method  "forest", "ferns" or "none". @throws InvalidSettings, FileError, DeviceError
  Reconstruction(const Context& context, const ReplayOptions& options, const ReplaySettings& settings);
  Reconstruction(const Reconstruction& other);
  Reconstruction& operator=(const Reconstruction&) = delete;

  FusionPipeline& pipeline() { return *pipeline_; }
  const FusionPipeline& pipeline() const { return *pipeline_; }
  /// Memory of what the relocaliser learnt [bytes]; 0 without one.
  std::size_t relocaliser_bytes() const { return relocaliser_ == nullptr ? 0 : relocaliser_->state_bytes(); }

  FusionFrameResult process(const Frame& frame_host);
  /// Which part of a frame's depth lies on mapped surface when seen from a pose, in [0, 1].
  double mapped_fraction(const Frame& frame_host, const SE3& world_from_camera);

 private:
  using Copy = std::function<std::unique_ptr<Relocaliser>(const Relocaliser&)>;

  Context context_;
  std::unique_ptr<Relocaliser> relocaliser_;
  Copy copy_relocaliser_;
  std::unique_ptr<FusionPipeline> pipeline_;
  FrameUploader uploader_;
};

}  // namespace foothold::replay
