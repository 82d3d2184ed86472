// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/feature_image.h"

#include "features/feature_image_kernels.h"
#include "foothold/base/contract.h"
#include "foothold/base/exec/dispatch.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct FeatureImageAlgorithms<CudaExecutor>;
#endif

void FeatureImage::compute(const Context& context, const Frame& frame, int downscale) {
  constexpr float kMillimetresPerMetre = 1000.0F;
  downscale_ = downscale;
  width_ = frame.depth.width / downscale;
  height_ = frame.depth.height / downscale;
  offset_scale_px_mm_ = frame.calibration.depth.fx / kReferenceFocalPx / static_cast<float>(downscale) * kMillimetresPerMetre;
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  dispatch(context, [&](auto on) {
    FeatureImageAlgorithms<typename decltype(on)::Executor>::pack(context, frame, downscale, view(), pixels_.data());
  });
}

void FeatureImage::relight(const Context& context, const FeatureImage& image, float gain) {
  FOOTHOLD_EXPECTS(&image != this && gain > 0.0F);
  width_ = image.width_;
  height_ = image.height_;
  downscale_ = image.downscale_;
  offset_scale_px_mm_ = image.offset_scale_px_mm_;
  pixels_.resize(image.pixels_.size());
  dispatch(context, [&](auto on) {
    FeatureImageAlgorithms<typename decltype(on)::Executor>::relight(context, {image.pixels_.data(), gain, pixels_.data()}, pixels_.size());
  });
}

}  // namespace foothold
