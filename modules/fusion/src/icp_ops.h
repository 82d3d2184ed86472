// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The steps of IcpTracker that run on a device.
#pragma once

#include "dispatch.h"
#include "foothold/fusion/icp_tracker.h"

namespace foothold {

inline constexpr int kMaxIcpLevels = 7;

/// A level of the pyramid, by value for kernels.
struct DepthLevel {
  ImageView<const float> depth;
  Intrinsics intrinsics;
};

/// What an alignment step sums over pixels: the upper triangle of H, J^T r, the robust cost, inliers, valid pixels.
inline constexpr int kNumHessian = 21;
inline constexpr int kNumSums = kNumHessian + 6 + 3;

/// SE3 in the form that an Array holds: trivially copyable.
struct PackedPose {
  float rotation[9];  ///< column by column
  float translation[3];

  FOOTHOLD_HD static PackedPose pack(const SE3& pose) {
    PackedPose packed{};
    for (int i = 0; i < 9; ++i) packed.rotation[i] = pose.rotation(i % 3, i / 3);
    for (int i = 0; i < 3; ++i) packed.translation[i] = pose.translation[i];
    return packed;
  }
  FOOTHOLD_HD SE3 unpack() const {
    SE3 pose;
    for (int i = 0; i < 9; ++i) pose.rotation(i % 3, i / 3) = rotation[i];
    for (int i = 0; i < 3; ++i) pose.translation[i] = translation[i];
    return pose;
  }
};

/// The progress of an alignment; lives in the device's memory, so that no step waits for the host.
struct IcpState {
  PackedPose model_from_camera;  ///< the best so far
  PackedPose trial;              ///< what the next step evaluates
  double sums[kNumSums];         ///< at model_from_camera
  double cost;                   ///< mean robust cost there
  float damping;
  int converged;  ///< nonzero: the level is done
};

static_assert(sizeof(IcpState) == 352, "copied from the device");

struct IcpTracker::Scratch {
  explicit Scratch(MemoryKind memory) : state(memory, 1), chunk_sums(memory) {}

  DepthLevel levels[kMaxIcpLevels];
  std::vector<Array<float>> depths_m;  ///< of levels 1, 2, ...
  Array<IcpState> state;
  Array<float> chunk_sums;
};

template <Device kDevice>
struct IcpOps {
  using Scratch = IcpTracker::Scratch;

  /// Halves level `level - 1` into `level`, for every level up to the coarsest.
  static void build_pyramid(const Context& context, const IcpSettings& settings, Scratch& scratch);
  /// Runs all levels; returns the final state.
  static IcpState align(const Context& context, const IcpSettings& settings, const SurfaceMap& model, const SE3& model_from_camera,
                        Scratch& scratch);
};

}  // namespace foothold
