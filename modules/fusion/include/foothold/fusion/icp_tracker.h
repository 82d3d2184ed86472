// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Tracks the camera: aligns a depth image with a rendering of the map.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/fusion/raycaster.h"

namespace foothold {

/// The levels of the pyramid that alignment goes through, from coarse to fine. Level l is the image halved l times.
struct IcpLevels {
  int coarsest = 3;  ///< the level that alignment begins with
  int finest = 2;    ///< the level that it ends with; 0 is the whole image

  /// Two levels, of which the finest has the pixels of an image reduced by a divisor.
  static IcpLevels for_divisor(int divisor);
};

/// What alignment compares.
enum class IcpResiduals {
  kDepth,        ///< distances from surfaces
  kDepthAndGrey  ///< smoothed grey values, too
};

/// What alignment says about itself; grade_tracking() goes by it. Reference: [Prisacariu2017] Sec. 4.
struct TrackingMeasures {
  /// log det(H n / N_total): how well the pose is determined, over all pixels; meaningless unless well_posed. A small overlap shows here.
  float log_det_total = 0.0F;
  /// log det(H n / N_valid): the same over the pixels with depth.
  float log_det_valid = 0.0F;
  /// Root of the mean robust squared residual [m] of the pixels that land on mapped surface, those without a partner counting as
  /// 0.15 m. Where nothing is mapped, nothing can disagree; but less than a fifth of the pixels with depth counts as a fifth,
  /// the rest of it without partners.
  float residual_m = 0.0F;
  /// Part of those pixels that found a partner, n / max(N_mapped, N_valid / 5).
  float inlier_fraction = 0.0F;
  /// Whether the Hessian is positive definite.
  bool well_posed = false;
};

/// A tracked pose.
struct TrackingResult {
  SE3 world_from_camera;      ///< the pose after alignment
  TrackingMeasures measures;  ///< what the grade of tracking rests on
  int num_inliers = 0;        ///< pixels that found a partner, at the finest level
  int num_valid = 0;          ///< pixels with depth, at the finest level
  int num_mapped = 0;         ///< of these, those that land on rendered surface whose normal is known
  /// The translation that the surfaces resist least, rotation being free to follow: along a table top, a corridor. Unit length, in the
  /// world, either of its two signs; zero unless well_posed.
  Eigen::Vector3f loosest_world = Eigen::Vector3f::Zero();
  /// How well the surfaces hold the camera along it, 0 (not at all) to 1/3 (as well as along any other): the mean, over weighted pixels,
  /// of the squared cosine between it and the surface normal, less what rotation can follow. Zero unless well_posed.
  float hold = 0.0F;
};

/// Projective point-to-plane ICP, coarse to fine, with robust weights and Levenberg-Marquardt damping.
///
/// Each pixel of the live image is moved into the rendering's camera and compared with the surface at the pixel where it lands:
/// r = n . (q - m), weighted by Tukey's function. H = sum w J J^T with J = (q x n, n).
///
/// Where surfaces leave the camera free, along equal steps or a corridor, and the rendering has colour, smoothed grey values are compared,
/// too: r = I_model - I_live - b with a common offset b. Their weight is small, so that they decide only there. Measures are of depth
/// alone.
///
/// Determinism: sums are taken over chunks of fixed size and combined in order; identical for any number of threads.
/// Reference: [Blais1995] projective association, [Chen1992] point-to-plane, [Newcombe2011] Sec. 3.5, [Beaton1974] Tukey's weights;
/// [Steinbruecker2011] grey values, [Whelan2013] both together.
class IcpTracker {
 public:
  struct Scratch;  ///< buffers of the implementation

  /// @pre 0 <= levels.finest <= levels.coarsest <= 6.
  explicit IcpTracker(const Context& context, const IcpLevels& levels = {}, const DepthRange& range = TsdfSettings{}.depth_range());
  ~IcpTracker();
  /// What was moved from may only be assigned to or destroyed.
  IcpTracker(IcpTracker&&) noexcept;
  /// What was moved from may only be assigned to or destroyed.
  IcpTracker& operator=(IcpTracker&&) noexcept;

  /// Prepares the pyramid of a frame's depth; track() may then be called for several models or guesses.
  /// @pre describe_frame_error(frame) is empty, its images live in the context's memory and outlive the calls of track().
  void set_frame(const Frame& frame);

  /// Whether any depth of the frame is in range; waits for the device. Without any, alignment is of no use. @pre set_frame() was called.
  bool sees_depth();

  /// The frame itself as a rendering, in its own camera's frame: what the next frame is tracked against where there is no map.
  /// @param surface  Output; its memory is reused. @pre set_frame() was called; `surface` lives in the context's memory.
  void make_surface(SurfaceMap& surface) const;

  /// Aligns the frame with a rendering, starting from a guess of its pose: by depth and, if needs_greys(), once more by greys, too.
  /// @return The best pose found; measures.well_posed is false where the data did not determine one.
  /// @pre set_frame() was called; `model` lives in the context's memory and is not empty.
  TrackingResult track(const SurfaceMap& model, const SE3& guess_world_from_camera);

  /// Whether an alignment by depth with a rendering may have slid where surfaces leave the camera free, and there is colour to tell.
  static bool needs_greys(const SurfaceMap& model, const TrackingResult& by_depth);

  /// Aligns the frame with each of several renderings, all at once, each from a guess of its own, and does not wait for the device.
  /// @pre As for track(); there are as many guesses as renderings, in the context's memory. Greys need renderings with colour.
  void align_all(const SurfaceMap& models, const Array<SE3>& guesses_world_from_camera, IcpResiduals residuals = IcpResiduals::kDepth);
  /// Where align_all() ended, in the context's memory: poses to render or to compare next, or guesses to go on from.
  const Array<SE3>& world_from_cameras() const;
  /// Asks for what results() then says, once the reads were waited for.
  void queue_results(HostReads& reads);
  /// One for each rendering; see track().
  std::vector<TrackingResult> results() const;

 private:
  Context context_;
  IcpLevels levels_;
  DepthRange range_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foothold
