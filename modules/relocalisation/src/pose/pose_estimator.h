// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// From leaves to poses: hypotheses, culls, pre-emptive RANSAC and refinement. Reference: [Cavallari2017] Sec. 2.2.3, Eq. 4; [Chum2003].
#pragma once

#include <cstdint>
#include <vector>

#include "clustering/leaf_modes.h"
#include "features/feature_image.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/base/se3.h"
#include "foothold/relocalisation/settings.h"

namespace foothold {

/// A pooled pixel: its camera point, its colour and its modes, which stand together in the pool's mode array.
struct PooledPixel {
  float point_camera[3];  ///< [m]
  std::uint32_t first_mode;
  std::uint16_t num_modes;
  std::uint8_t rgb[3];
  std::uint8_t reserved;
};
static_assert(sizeof(PooledPixel) == 24, "read by kernels");

/// What kernels see of the pool. Its pixels are spread evenly over the image in any prefix, so "n samples" means the first n.
struct CorrespondencePoolView {
  const PooledPixel* pixels = nullptr;
  const Mode* modes = nullptr;
  const std::uint32_t* num_pixels = nullptr;  ///< pixels with at least one mode; in device memory
};

/// A hypothesis that came far, with what its pose explains of the whole pool.
struct PoseCandidate {
  SE3 scene_from_camera;
  float mean_energy = 0.0F;            ///< truncated Mahalanobis distance per pooled pixel, Eq. 4
  float inlier_fraction = 0.0F;        ///< pooled pixels with a mode within kInlierDistanceM, among all pooled pixels with depth
  float fine_fraction = 0.0F;          ///< the same within kFineInlierDistanceM
  float surface_fit = 0.0F;            ///< how well samples lie on the remembered surface, 0 to 1; 0 for candidates that were not aligned
  float contradicted_fraction = 0.0F;  ///< SceneEvidence's; 0 without ranking_points
  float alike_fraction = 0.0F;         ///< SceneEvidence's; 0 without ranking_points
  std::int32_t valid = 0;
};
static_assert(sizeof(PoseCandidate) == 76, "copied from the device");

inline constexpr float kInlierDistanceM = 0.05F;
inline constexpr float kFineInlierDistanceM = 0.025F;

/// A pooled pixel's surface: its averaged camera point and normal; no normal (zero) where the surface is broken or unmeasured.
struct SurfaceSample {
  float point_camera[3];   ///< [m]
  float normal_camera[3];  ///< unit length, towards the camera
};

/// A sample's distance along its normal to the points that one leaf remembers around it, as weighted sums.
struct SurfaceOffset {
  float weight;
  float offset_mm;  ///< times the weight
};

/// The progress of an alignment; in device memory, so that no step waits for the host.
struct AlignmentState {
  SE3 scene_from_camera;
  float misfit;  ///< 0 if every sample lies on the remembered surface, 1 if none has any of it around
  std::int32_t ended;
};
static_assert(sizeof(AlignmentState) == 56, "lives in device memory");

/// A point drawn from all that the leaves remember.
struct RememberedPoint {
  float point_scene[3];  ///< [m]
  std::uint8_t rgb[3];
  std::uint8_t valid;
};
static_assert(sizeof(RememberedPoint) == 16, "lives in device memory");

/// What remembered points say about a pose: counts of those that project to a pixel with depth.
struct SceneEvidence {
  float num_in_view;
  float num_contradicted;  ///< the camera sees through them
  float num_alike;         ///< at the measured depth, and of the measured colour

  FOOTHOLD_HD float contradicted_fraction() const { return num_contradicted / (num_in_view + kPrior); }
  FOOTHOLD_HD float alike_fraction() const { return num_alike / (num_in_view + kPrior); }

 private:
  static constexpr float kPrior = 20.0F;  ///< (T) a few points prove nothing
};
static_assert(sizeof(SceneEvidence) == 12, "lives in device memory");

/// A frame whose camera is to be found, and the scene to find it in.
struct PoseQuery {
  const Frame& frame;
  const FeatureImage& image;
  LeafReservoirsView reservoirs;
  LeafModesView leaf_modes;
};

/// Estimates the camera of a frame from the modes its pixels reach.
///
/// Determinism: a function of the arguments and settings.seed, whatever the number of threads.
/// Cost: O(hypotheses x samples x modes); buffers are kept, so that a second call allocates nothing.
class PoseEstimator {
 public:
  PoseEstimator(const Context& context, const PoseEstimatorSettings& settings);

  /// Chooses the pixels and the remembered points that every estimate of this query uses, however the camera is rolled.
  void prepare(const Context& context, const PoseQuery& query);

  /// Draws a few hypotheses on a few pixels with each forest, and counts those that pass the geometric checks: a cheap sign of which
  /// estimates are worth their cost. From one that counts none, nothing is to be expected.
  /// @param forests  turned to as many rolls of the camera.
  /// @pre prepare() was called last with the same query.
  std::vector<std::uint32_t> count_hypotheses(const Context& context, const PoseQuery& query, const std::vector<ForestView>& forests);

  /// @param forest  turned to a roll of the camera.
  /// @return        Candidates, best first. Empty if no triple passed the geometric checks: a normal outcome, not an error.
  /// @pre prepare() was called last with the same query.
  std::vector<PoseCandidate> estimate(const Context& context, const PoseQuery& query, const ForestView& forest);

  /// Buffers of the algorithm; see pose_estimator_kernels.h.
  struct Buffers {
    explicit Buffers(MemoryKind memory);
    Array<SampledPixel> sampled;
    Array<std::uint32_t> leaves;
    Array<std::uint32_t> mode_counts;
    Array<std::uint32_t> first_modes;
    Array<std::uint32_t> has_modes;
    Array<std::uint32_t> slots;
    Array<PooledPixel> pixels;
    Array<Mode> modes;
    Array<SE3> hypotheses;
    Array<float> energies;
    Array<std::uint32_t> counts;  ///< of count_hypotheses()
    Array<std::uint64_t> order;   ///< sort keys: energy above, hypothesis below
    Array<std::uint64_t> sort_buffer;
    Array<std::uint16_t> nearest;  ///< hypotheses x samples: position of the nearest mode
    Array<SurfaceSample> surfaces;
    Array<AlignmentState> alignment;
    Array<SurfaceOffset> offsets;  ///< alignment samples x trees
    Array<float> misfits;          ///< per candidate, after alignment; 1 for those not aligned
    Array<RememberedPoint> remembered;
    Array<SceneEvidence> evidence;  ///< per hypothesis
    Array<PoseCandidate> candidates;
  };

  /// What the last call of estimate() left behind.
  const Buffers& buffers() const { return buffers_; }

 private:
  void make_room_for(const PoseQuery& query, const ForestView& forest);

  PoseEstimatorSettings settings_;
  Buffers buffers_;
};

}  // namespace foothold
