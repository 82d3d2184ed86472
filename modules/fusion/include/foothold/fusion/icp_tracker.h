// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Tracks the camera: aligns a depth image with a rendering of the map.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/base/settings.h"
#include "foothold/fusion/raycaster.h"

namespace foothold {

/// How a depth image is aligned with the map. Level l of the pyramid is the image halved l times.
struct IcpSettings {
  /// Level at which alignment begins.
  int coarsest_level = 3;
  /// Level at which alignment ends.
  int finest_level = 2;
  /// Steps at the coarsest level; the levels between are interpolated.
  int coarsest_steps = 10;
  /// Steps at the finest level.
  int finest_steps = 10;
  /// Solve for rotation alone at the coarsest level.
  bool rotation_first = false;
  /// Distance at which a residual counts as an outlier [m], at the coarsest level and 1 m of depth.
  float coarsest_outlier_m = 0.15F;
  /// The same at the finest level.
  float finest_outlier_m = 0.01F;
  /// Growth of the outlier distance with depth z [m]: 1 + growth * z^2.
  float outlier_growth = 0.3F;
  /// Growth of the assumed noise with depth, likewise: residuals are weighted by its inverse square.
  float noise_growth = 4.0F;
  /// Depth readings outside [min_depth_m, max_depth_m] are ignored.
  float min_depth_m = 0.2F;
  float max_depth_m = 5.0F;
  /// A step shorter than this ends its level: rotation [rad] and translation [m] together.
  float converged_step = 1e-4F;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&IcpSettings::coarsest_level, "coarsest_level", "Level of the pyramid at which alignment begins (R).", Range{0, 6});
    v(&IcpSettings::finest_level, "finest_level", "Level of the pyramid at which alignment ends (T: fusion_benchmark, kitchen).",
      Range{0, 6});
    v(&IcpSettings::coarsest_steps, "coarsest_steps", "Steps at the coarsest level (R).", Range{1, 100});
    v(&IcpSettings::finest_steps, "finest_steps", "Steps at the finest level (T: fusion_benchmark, office with exact poses).",
      Range{1, 100});
    v(&IcpSettings::rotation_first, "rotation_first", "Solve for rotation alone at the coarsest level (T: fusion_benchmark, kitchen).");
    v(&IcpSettings::coarsest_outlier_m, "coarsest_outlier_m", "Outlier distance at the coarsest level [m] (T: fusion_benchmark, kitchen).",
      Range{1e-3, 1.0});
    v(&IcpSettings::finest_outlier_m, "finest_outlier_m", "Outlier distance at the finest level [m] (T: fusion_benchmark, kitchen).",
      Range{1e-3, 1.0});
    v(&IcpSettings::outlier_growth, "outlier_growth",
      "Growth of the outlier distance with squared depth [1/m^2] (T: fusion_benchmark, kitchen).", Range{0.0, 100.0});
    v(&IcpSettings::noise_growth, "noise_growth", "Growth of the assumed noise with squared depth [1/m^2] (T: fusion_benchmark, kitchen).",
      Range{0.0, 100.0});
    v(&IcpSettings::min_depth_m, "min_depth_m", "Nearer depth is ignored [m] (R).", Range{0.01, 10.0});
    v(&IcpSettings::max_depth_m, "max_depth_m", "Farther depth is ignored [m] (T: fusion_benchmark, kitchen).", Range{0.1, 100.0});
    v(&IcpSettings::converged_step, "converged_step", "A shorter step ends its level (T: fusion_benchmark, kitchen).", Range{0.0, 1.0});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const;
};

/// What alignment says about itself; grade_tracking() goes by it. Reference: [Prisacariu2017] Sec. 4.
struct TrackingMeasures {
  /// log det(H n / N_total): how well the pose is determined, over all pixels; meaningless unless well_posed. A small overlap shows here.
  float log_det_total = 0.0F;
  /// log det(H n / N_valid): the same over the pixels with depth.
  float log_det_valid = 0.0F;
  /// Root of the mean robust squared residual [m] of the pixels that land on mapped surface, those without a partner counting as
  /// coarsest_outlier_m. Where nothing is mapped, nothing can disagree; but less than a fifth of the pixels with depth counts as a fifth,
  /// the rest of it without partners.
  float residual_m = 0.0F;
  /// Part of those pixels that found a partner, n / max(N_mapped, N_valid / 5).
  float inlier_fraction = 0.0F;
  /// Whether the Hessian is positive definite.
  bool well_posed = false;
};

/// A tracked pose.
struct TrackingResult {
  SE3 world_from_camera;
  TrackingMeasures measures;
  int num_inliers = 0;
  int num_valid = 0;   ///< pixels with depth, at the finest level
  int num_mapped = 0;  ///< of these, those that land on rendered surface whose normal is known
  /// The translation that the surfaces resist least, rotation being free to follow: along a table top, a corridor. Unit length, in the
  /// world, either of its two signs; zero unless well_posed.
  Eigen::Vector3f loosest_world = Eigen::Vector3f::Zero();
};

/// Projective point-to-plane ICP, coarse to fine, with robust weights and Levenberg-Marquardt damping.
///
/// Each pixel of the live image is moved into the rendering's camera and compared with the surface at the pixel where it lands:
/// r = n . (q - m), weighted by Tukey's function. H = sum w J J^T with J = (q x n, n).
///
/// Determinism: sums are taken over chunks of fixed size and combined in order; identical for any number of threads.
/// Reference: [Blais1995] projective association, [Chen1992] point-to-plane, [Newcombe2011] Sec. 3.5, [Beaton1974] Tukey's weights.
class IcpTracker {
 public:
  struct Scratch;  ///< buffers of the implementation

  /// @throws InvalidSettings
  explicit IcpTracker(const Context& context, const IcpSettings& settings = {});
  ~IcpTracker();
  IcpTracker(IcpTracker&&) noexcept;
  IcpTracker& operator=(IcpTracker&&) noexcept;

  /// Prepares the pyramid of a frame's depth; track() may then be called for several models or guesses.
  /// @pre describe_frame_error(frame) is empty, its images live in the context's memory and outlive the calls of track().
  void set_frame(const Frame& frame);

  /// Whether any depth of the frame is in range; waits for the device. Without any, alignment is of no use. @pre set_frame() was called.
  bool sees_depth();

  /// Aligns the frame with a rendering, starting from a guess of its pose.
  /// @return The best pose found; measures.well_posed is false where the data did not determine one.
  /// @pre set_frame() was called; `model` lives in the context's memory and is not empty.
  TrackingResult track(const SurfaceMap& model, const SE3& guess_world_from_camera);

  /// Aligns the frame with each of several renderings, all at once, each from a guess of its own, and does not wait for the device.
  /// @pre As for track(); there are as many guesses as renderings, in the context's memory.
  void align_all(const SurfaceMap& models, const Array<SE3>& guesses_world_from_camera);
  /// Where align_all() ended, in the context's memory: poses to render or to compare next, or guesses to go on from.
  const Array<SE3>& world_from_cameras() const;
  /// Asks for what results() then says, once the reads were waited for.
  void queue_results(HostReads& reads);
  /// One for each rendering; see track().
  std::vector<TrackingResult> results() const;

  const IcpSettings& settings() const { return settings_; }

 private:
  Context context_;
  IcpSettings settings_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foothold
