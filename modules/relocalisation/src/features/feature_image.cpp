// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "features/feature_image.h"

#include "features/feature_image_kernels.h"
#include "foothold/base/exec/dispatch.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct FeatureAlgorithms<CudaExecutor>;
#endif

void FeatureImage::compute(const Context& context, const Frame& frame, int downscale) {
  constexpr float kMillimetresPerMetre = 1000.0F;
  downscale_ = downscale;
  width_ = frame.depth.width / downscale;
  height_ = frame.depth.height / downscale;
  offset_scale_px_mm_ = frame.calibration.depth.fx / kReferenceFocalPx / static_cast<float>(downscale) * kMillimetresPerMetre;
  pixels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  dispatch(context,
           [&](auto on) { FeatureAlgorithms<typename decltype(on)::Executor>::pack(context, frame, downscale, view(), pixels_.data()); });
}

void find_leaves(const Context& context, const FeatureImage& image, const ForestView& forest, Span<const SampledPixel> pixels,
                 Span<std::uint32_t> leaves) {
  FOOTHOLD_EXPECTS(leaves.size() == pixels.size() * static_cast<std::size_t>(forest.num_trees));
  dispatch(context, [&](auto on) {
    FeatureAlgorithms<typename decltype(on)::Executor>::find_leaves(context, image.view(), image.downscale(), forest, pixels, leaves);
  });
}

}  // namespace foothold
