// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "features/leaf_lookup.h"

#include "features/leaf_lookup_kernels.h"
#include "foothold/base/exec/dispatch.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct LeafLookupAlgorithms<CudaExecutor>;
#endif

void find_leaves(const Context& context, const FeatureImage& image, const ForestView& forest, Span<const SampledPixel> pixels,
                 Span<std::uint32_t> leaves) {
  FOOTHOLD_EXPECTS(leaves.size() == pixels.size() * static_cast<std::size_t>(forest.num_trees));
  dispatch(context,
           [&](auto on) { LeafLookupAlgorithms<typename decltype(on)::Executor>::find_leaves(context, image, forest, pixels, leaves); });
}

}  // namespace foothold
