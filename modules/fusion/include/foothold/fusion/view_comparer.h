// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Asks whether a frame shows what the map says it should show.
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/fusion/raycaster.h"

namespace foothold {

/// How a frame compares with a rendering of the map. Fractions are of the compared pixels with depth.
struct ViewAgreement {
  int num_valid = 0;            ///< compared pixels with depth
  float overlap = 0.0F;         ///< part of them that fall on rendered surface
  float agreement = 0.0F;       ///< part of the overlap whose depths agree
  float in_front = 0.0F;        ///< part of the overlap where the frame sees something in the map's free space
  float behind = 0.0F;          ///< part of the overlap where the frame looks through the map's surface
  float solid_in_front = 0.0F;  ///< part of the overlap far in front, as is its neighbourhood: a thing, neither an edge nor noise
  float solid_behind = 0.0F;    ///< the same of what is behind
  float difference = 0.0F;      ///< mean over the overlap of the depth difference, in tolerances, each at most 3
  /// Normalised cross-correlation of grey values over the agreeing pixels, in [-1, 1]; 0 without texture or colour.
  float colour_correlation = 0.0F;
  /// The same of what is left of the grey values after each of 8 x 8 compared pixels lost its mean: the pattern on surfaces, which tells
  /// equal furniture apart, without the surfaces' own shades and the light.
  float texture_correlation = 0.0F;
  /// Part of the tiles with a pattern, in the frame or in the map, whose patterns differ (correlate at less than 0.4); 0 without any.
  float unlike_texture = 0.0F;
};

/// Compares frames with renderings, at every fourth pixel in both directions.
///
/// Determinism: sums over chunks of fixed size, combined in order.
class ViewComparer {
 public:
  struct Scratch;  ///< buffers of the implementation

  explicit ViewComparer(const Context& context, const DepthRange& range = TsdfSettings{}.depth_range());
  ~ViewComparer();
  /// What was moved from may only be assigned to or destroyed.
  ViewComparer(ViewComparer&&) noexcept;
  /// What was moved from may only be assigned to or destroyed.
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
  DepthRange range_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foothold
