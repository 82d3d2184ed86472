// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Chooses among proposed poses by aligning each with the map and asking whether the frame shows what the map says.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/settings.h"
#include "foothold/fusion/classifier.h"
#include "foothold/fusion/icp_tracker.h"
#include "foothold/fusion/view_comparer.h"

namespace foothold {

/// How many proposals are refined, in images of which size, and what is believed of them.
struct PoseRefinerSettings {
  /// Of the proposals, how many are refined to the end.
  int num_finalists = 3;
  /// First, candidates are aligned and ranked in images reduced by this divisor; finalists then in images twice as large.
  int coarse_divisor = 8;
  /// A second, different pose that is good enough, too, must leave at least this many times as much of the texture unexplained (1 less its
  /// correlation) as the best, or the place is ambiguous and neither is believed.
  float ambiguity_ratio = 2.0F;
  /// Where nothing is good enough, starts up to this far from the best pose are tried along the translation that its surfaces resist least:
  /// a view half of which is unmapped slides along a table until all of it is mapped.
  float slide_reach_m = 1.2F;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&PoseRefinerSettings::num_finalists, "num_finalists", "Proposals that are refined to the end, at most (T: replay_sequence, kitchen).",
      Range{1, 1000});
    v(&PoseRefinerSettings::coarse_divisor, "coarse_divisor",
      "Reduction of the images in which all candidates are ranked; half of it for those that are rated (T: replay_sequence, kitchen).",
      Range{1, 32});
    v(&PoseRefinerSettings::ambiguity_ratio, "ambiguity_ratio",
      "Lead in unexplained texture over the next different pose (T: relocalisation_benchmark, stairs).", Range{1.0, 100.0});
    v(&PoseRefinerSettings::slide_reach_m, "slide_reach_m",
      "How far from the best pose, to both sides, others are tried [m]; 0 for none (T: relocalisation_benchmark, kitchen).",
      Range{0.0, 10.0});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const { validate_settings(*this); }
};

/// A proposal after refinement.
struct RefinedPose {
  SE3 world_from_camera;      ///< the pose after refinement
  float score = 0.0F;         ///< of the acceptance classifier, which sees frame and map alone; higher is better
  float probability = 0.0F;   ///< calibrated, of the pose being right, given the score and the relocaliser's confidence
  bool contradicted = false;  ///< something solid that the map shows is not there: a place that looks alike, or one that has changed
  bool accepted = false;      ///< probable enough, unambiguous and not contradicted
  TrackingMeasures measures;  ///< what alignment measured
  ViewAgreement agreement;    ///< of the frame with the map there
  int candidate = 0;          ///< index of the proposal
  /// Of TrackingResult: the direction in which alignment may have gone astray.
  Eigen::Vector3f loosest_world = Eigen::Vector3f::Zero();
};

/// Proposals that are looked at, the first ones (R).
inline constexpr std::size_t kMaxProposals = 16;

/// Poses this near to one another are one: the error at which the papers of the field call a relocalisation right.
inline constexpr float kSamePoseM = 0.05F;
/// The same for rotations [deg].
inline constexpr float kSamePoseDeg = 5.0F;

/// However sure a relocaliser is of a proposal, it counts as evidence of this probability at most: equal furniture deceives it, too (T:
/// relocalisation_benchmark, kitchen, teddy and rooms).
inline constexpr float kMaxTrust = 0.97F;

/// Poses from which less than this part of the frame falls on the map are refused outright: what little there is agrees easily (T:
/// train_quality_gate; R: 0.1).
inline constexpr float kMinOverlap = 0.2F;

/// A view from which more than this part of the overlap is seen through in one piece is contradicted. Of right
/// views of two recordings, 95 % have less; of wrong views of equal desks none has (T: docs/experiments/trust.md).
inline constexpr float kMostSolidBehind = 0.01F;

/// The number of acceptance_features().
inline constexpr std::size_t kNumAcceptanceFeatures = 13;

/// What the acceptance classifier looks at: how the frame compares with the rendering, and how alignment went. Of the solid parts, which
/// are small or absent, the square roots.
std::array<float, kNumAcceptanceFeatures> acceptance_features(const TrackingMeasures& measures, const ViewAgreement& agreement);
/// The names of acceptance_features(), in order.
std::array<const char*, kNumAcceptanceFeatures> acceptance_feature_names();

/// Refines proposed poses by ICP on the map, ranks them by rendering, and accepts only what can be believed.
///
/// Every candidate is rendered coarsely, aligned and scored; the best few are rendered finely, aligned twice and rated: depth that agrees,
/// surfaces that the frame looks through, things in the map's free space, too little overlap, colour, residual and Hessian all count. So
/// does the relocaliser's confidence, by Bayes' rule, in a pose that stayed as near to the proposal as the confidence speaks of.
/// Those that looked hopeless coarsely are refined only if none of the others is good enough. If nothing is, the best is moved along the
/// direction in which its surfaces hold it least, and the same is done with what comes of that.
///
/// Cost: all candidates go through each step together, as do the finalists, so that the host waits for the device twice; a third time if
/// hopeless ones are refined, too, and as often again for what slides. Memory for kMaxProposals coarse and num_finalists fine renderings.
class PoseRefiner {
 public:
  /// @param range  As of the volume that poses are refined on. @throws InvalidSettings
  explicit PoseRefiner(const Context& context, const PoseRefinerSettings& settings = {},
                       const DepthRange& range = TsdfSettings{}.depth_range(),
                       const ClassifierModel& classifier = default_acceptance_classifier());

  /// @return The finalists, best first: good ones by texture, then the rest by score. Only the first can be accepted. Empty without
  /// proposals, and for an image with a side shorter than coarse_divisor.
  /// @pre describe_frame_error(frame) is empty; frame and volume live in the context's memory.
  std::vector<RefinedPose> refine(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals);

  /// Aligns one pose to the end, without ranking: the ceiling that refinement is measured against when started from the true pose.
  RefinedPose refine_one(const Frame& frame, const TsdfVolume& volume, const SE3& proposal);

  /// What the acceptance classifier says of a pose that someone else aligned and nobody proposed; all but the pose is filled in.
  RefinedPose rate(const TrackingMeasures& measures, const ViewAgreement& agreement) const;

  /// Whether the view from a pose scores so low that right ones hardly ever do.
  bool is_hopeless(const RefinedPose& pose) const { return pose.score < classifier_.poor_threshold; }

  /// The probability at which poses are accepted.
  float acceptance_probability() const;

 private:
  /// Ranks coarsely, aligns the best finely; these, best first.
  std::vector<RefinedPose> refine_ranked(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals);
  /// Starts along the loosest direction of a pose, nearest first; empty where none is known.
  std::vector<PoseEstimate> slide(const RefinedPose& pose) const;
  /// The distinct proposals, aligned coarsely, best first: at most as many different places as there are finalists.
  std::vector<RefinedPose> rank_coarsely(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals);
  std::vector<RefinedPose> refine_finalists(const Frame& frame, const TsdfVolume& volume, Span<const PoseEstimate> proposals,
                                            Span<const RefinedPose> ranked);
  /// Aligns poses coarsely, or finely, and rates them: one result for each.
  std::vector<RefinedPose> align_coarsely(const Frame& frame, const TsdfVolume& volume, Span<const SE3> proposals);
  std::vector<RefinedPose> align_finely(const Frame& frame, const TsdfVolume& volume, Span<const SE3> proposals);
  /// Notes which proposal a pose came of, and adds the confidence in it to what the map says.
  void attribute(Span<const PoseEstimate> proposals, int candidate, RefinedPose& pose) const;
  /// Rates what was aligned with the renderings in map_.
  std::vector<RefinedPose> rate_rendered(IcpTracker& aligned);
  bool is_good(const RefinedPose& pose) const;
  bool is_better(const RefinedPose& a, const RefinedPose& b) const;
  bool is_rival(const RefinedPose& other, const RefinedPose& best) const;

  Context context_;
  PoseRefinerSettings settings_;
  ClassifierModel classifier_;
  Raycaster raycaster_;
  IcpTracker coarse_icp_;
  IcpTracker fine_icp_;
  ViewComparer comparer_;
  SurfaceMap map_;
  Array<SE3> proposals_;
};

}  // namespace foothold
