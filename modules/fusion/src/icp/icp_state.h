// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What IcpTracker shares with its kernels: the pyramid, the sums of a step, the progress of an alignment, buffers.
#pragma once

#include "foothold/base/normal_equations.h"
#include "foothold/fusion/icp_tracker.h"

namespace foothold {

inline constexpr int kMaxIcpLevels = 7;

/// Steps at each level, at most; a step shorter than kConvergedStep, rotation [rad] and translation [m] together, is the last (T:
/// fusion_benchmark, kitchen, and office with exact poses; R: 10 at the coarsest).
inline constexpr int kStepsPerLevel = 10;
inline constexpr float kConvergedStep = 1e-4F;
/// Distance at which a residual counts as an outlier [m], at the coarsest and the finest level, and 1 m of depth (T: fusion_benchmark,
/// kitchen).
inline constexpr float kCoarsestOutlierM = 0.15F;
inline constexpr float kFinestOutlierM = 0.01F;
/// Growth of the outlier distance with depth z [m]: 1 + growth * z^2; and of the assumed noise, by whose inverse square residuals are
/// weighted (T: fusion_benchmark, kitchen).
inline constexpr float kOutlierGrowth = 0.3F;
inline constexpr float kNoiseGrowth = 4.0F;

/// The hold under which surfaces leave the camera free, and greys are compared (T: fusion_benchmark; of the frames of kitchen, teddy and
/// office none is below, the least 0.0050, 0.0067 and 0.0067, of those of stairs 43 %).
inline constexpr float kLeastHold = 0.004F;
/// Difference of grey values in [0, 1] that counts as an outlier, and the weight of their squares against those of distances at 1 m
/// (T: fusion_benchmark, stairs, kitchen, teddy).
inline constexpr float kGreyOutlier = 0.1F;
inline constexpr float kGreyWeight = 2e-4F;

/// One pixel of a rendering's grey image: grey in [0, 1], -1 where it is unknown, and its gradient [1 / px].
struct GreyPixel {
  float grey = -1.0F;
  float along_u = 0.0F;
  float along_v = 0.0F;
};

/// A level of the pyramid, by value for kernels.
struct DepthLevel {
  ImageView<const float> depth;
  Intrinsics intrinsics;
};

/// What an alignment step sums over pixels: the upper triangle of H, J^T r, and then these.
inline constexpr int kCostSum = kNumHessian + 6;  ///< the robust cost, 1 for each valid pixel without a partner
inline constexpr int kInlierSum = kCostSum + 1;   ///< pixels with a partner
inline constexpr int kValidSum = kCostSum + 2;    ///< pixels with depth
inline constexpr int kMappedSum = kCostSum + 3;   ///< pixels with depth that land on rendered surface
inline constexpr int kNumDepthSums = kCostSum + 4;
/// The same of grey values, where they are compared: H, J^T r, and then, for a common offset of them is unknown, these.
inline constexpr int kGreySum = kNumDepthSums;
inline constexpr int kGreyWeightSum = kGreySum + kNumHessian + 6;  ///< sum of weights
inline constexpr int kGreyOffsetSum = kGreyWeightSum + 1;          ///< sum of w J, six elements, and of w r
inline constexpr int kNumSums = kGreyOffsetSum + 7;

FOOTHOLD_HD constexpr int num_sums_of(IcpResiduals residuals) { return residuals == IcpResiduals::kDepth ? kNumDepthSums : kNumSums; }

/// The progress of an alignment; lives in the device's memory, so that no step waits for the host.
struct IcpState {
  SE3 world_from_model;
  SE3 model_from_camera;  ///< the best so far
  SE3 trial;              ///< what the next step evaluates
  double sums[kNumSums];  ///< at model_from_camera
  double cost;            ///< mean robust cost there
  float offset;           ///< of the live image's greys, at model_from_camera
  float trial_offset;     ///< at trial
  float damping;
  int converged;  ///< nonzero: the level is done
};

static_assert(sizeof(IcpState) == 696, "copied from the device");

struct IcpTracker::Scratch {
  explicit Scratch(const Memory& memory)
      : guess(memory),
        states(memory),
        world_from_cameras(memory),
        chunk_sums(memory),
        sharp_greys(memory),
        model_greys(memory),
        row_counts(memory),
        row_offsets(memory) {}

  Frame frame;  ///< to be aligned
  DepthLevel levels[kMaxIcpLevels];
  std::vector<Array<float>> depths_m;  ///< of levels 1, 2, ...
  Array<SE3> guess;                    ///< of a single alignment
  Array<IcpState> states;              ///< of each alignment
  Array<SE3> world_from_cameras;       ///< where it ended
  Array<float> chunk_sums;             ///< by alignment, then by chunk
  std::vector<Array<float>> greys;     ///< of the live image, of the finest level and coarser ones
  Array<float> sharp_greys;            ///< of the finest level, before smoothing
  Array<GreyPixel> model_greys;        ///< of each rendering
  Array<std::uint32_t> row_counts;     ///< pixels with depth, by row of the finest level
  Array<std::uint32_t> row_offsets;
  std::vector<IcpState> host_states;  ///< what queue_results() asked for
  std::vector<SE3> host_world_from_cameras;
};

}  // namespace foothold
