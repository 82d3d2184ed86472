// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Asks whether a frame shows what the map says it should show.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/base/settings.h"
#include "foothold/fusion/raycaster.h"

namespace foothold {

struct ViewComparerSettings {
  /// Every so many pixels of the frame are compared, in both directions.
  int stride_px = 4;
  /// Depths that differ by at most base + growth * z^2 agree [m].
  float tolerance_m = 0.02F;
  float tolerance_growth = 0.003F;
  /// Depth outside [min_depth_m, max_depth_m] is ignored.
  float min_depth_m = 0.2F;
  float max_depth_m = 5.0F;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ViewComparerSettings::stride_px, "stride_px", "Every so many pixels are compared (T: train_quality_gate).", Range{1, 64});
    v(&ViewComparerSettings::tolerance_m, "tolerance_m", "Depths closer than this agree [m] (T: train_quality_gate).", Range{1e-3, 1.0});
    v(&ViewComparerSettings::tolerance_growth, "tolerance_growth", "Growth of the tolerance with squared depth [1/m]: a Kinect's noise.",
      Range{0.0, 1.0});
    v(&ViewComparerSettings::min_depth_m, "min_depth_m", "Nearer depth is ignored [m] (R).", Range{0.01, 10.0});
    v(&ViewComparerSettings::max_depth_m, "max_depth_m", "Farther depth is ignored [m].", Range{0.1, 100.0});
  }
  void validate() const;
};

/// How a frame compares with a rendering of the map. Fractions are of the compared pixels with depth.
struct ViewAgreement {
  int num_valid = 0;        ///< compared pixels with depth
  float overlap = 0.0F;     ///< part of them that fall on rendered surface
  float agreement = 0.0F;   ///< part of the overlap whose depths agree
  float in_front = 0.0F;    ///< part of the overlap where the frame sees something in the map's free space
  float behind = 0.0F;      ///< part of the overlap where the frame looks through the map's surface
  float difference = 0.0F;  ///< mean over the overlap of the depth difference, in tolerances, each at most 3
  /// Normalised cross-correlation of grey values over the agreeing pixels, in [-1, 1]; 0 without texture or colour.
  float colour_correlation = 0.0F;
  /// The same of what is left of the grey values after each of 8 x 8 compared pixels lost its mean: the pattern on surfaces, which tells
  /// equal furniture apart, without the surfaces' own shades and the light.
  float texture_correlation = 0.0F;
};

/// Compares frames with renderings, at a stride.
///
/// Determinism: sums over chunks of fixed size, combined in order.
class ViewComparer {
 public:
  struct Scratch;  ///< buffers of the implementation

  /// @throws InvalidSettings
  explicit ViewComparer(const Context& context, const ViewComparerSettings& settings = {});
  ~ViewComparer();
  ViewComparer(ViewComparer&&) noexcept;
  ViewComparer& operator=(ViewComparer&&) noexcept;

  /// Takes depth, and for each pixel its colour, from a frame. @pre describe_frame_error(frame) is empty; images live in the context's
  /// memory.
  void set_frame(const Frame& frame);

  /// Compares the frame, as taken from a pose, with a rendering from the same pose or one nearby. Without colours in the rendering,
  /// colour_correlation is 0.
  /// @pre set_frame() was called.
  ViewAgreement compare(const SurfaceMap& model, const SE3& world_from_camera);

  /// Compares the frame with each of several renderings, each from a pose of its own, and does not wait for the device.
  /// @pre As for compare(); there are as many poses as renderings, in the context's memory.
  void compare_all(const SurfaceMap& models, const Array<SE3>& world_from_cameras);
  /// Asks for what results() then says, once the reads were waited for.
  void queue_results(HostReads& reads);
  /// One for each rendering; see compare().
  std::vector<ViewAgreement> results() const;

 private:
  Context context_;
  ViewComparerSettings settings_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foothold
