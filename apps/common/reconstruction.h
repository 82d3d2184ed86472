// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A fusion pipeline with its relocaliser, to be copied where the camera is kidnapped.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "foothold/evaluation/kidnap.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"

namespace foothold::apps {

/// Takes frames in host memory, whatever the device. Copies are independent in everything.
class Reconstruction {
 public:
  /// Without a relocaliser. @throws InvalidSettings, DeviceError
  Reconstruction(const Context& context, const FusionSettings& settings) : Reconstruction(context, settings, nullptr, nullptr) {}
  /// @tparam Kind  a Relocaliser that can be copied. @throws InvalidSettings, DeviceError
  template <class Kind>
  Reconstruction(const Context& context, const FusionSettings& settings, std::unique_ptr<Kind> relocaliser)
      : Reconstruction(context, settings, std::move(relocaliser),
                       [](const Relocaliser& original) { return std::make_unique<Kind>(static_cast<const Kind&>(original)); }) {}
  Reconstruction(const Reconstruction& other);
  Reconstruction& operator=(const Reconstruction&) = delete;

  FusionPipeline& pipeline() { return *pipeline_; }
  const FusionPipeline& pipeline() const { return *pipeline_; }
  /// Memory of what the relocaliser learnt [bytes]; 0 without one.
  std::size_t relocaliser_bytes() const { return relocaliser_ == nullptr ? 0 : relocaliser_->state_bytes(); }

  FusionFrameResult process(const Frame& frame_host) { return pipeline_->process(uploader_.upload(frame_host)); }
  /// Which part of a frame's depth lies on mapped surface when seen from a pose, in [0, 1].
  double mapped_fraction(const Frame& frame_host, const SE3& world_from_camera);

 private:
  using Copy = std::function<std::unique_ptr<Relocaliser>(const Relocaliser&)>;

  Reconstruction(const Context& context, const FusionSettings& settings, std::unique_ptr<Relocaliser> relocaliser, Copy copy_relocaliser);

  Context context_;
  std::unique_ptr<Relocaliser> relocaliser_;
  Copy copy_relocaliser_;
  std::unique_ptr<FusionPipeline> pipeline_;
  FrameUploader uploader_;
};

/// What the judge of kidnaps needs to know of a frame. A pose is believed when the gate calls it good.
inline PlayedFrame played(const FusionFrameResult& result) {
  const bool believed = result.world_from_camera.has_value() && result.quality == TrackingQuality::kGood;
  return {result.world_from_camera, believed, result.fused, result.total_ms};
}

}  // namespace foothold::apps
