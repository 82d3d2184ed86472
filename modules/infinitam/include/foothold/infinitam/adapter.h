// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser inside InfiniTAM: wraps a view's pointers, turns poses round, registers colour. Reference: [Prisacariu2017].
///
/// Templates over the host's own types, by the names of their members alone:
///
///   View           depth, rgb: pointers to images with GetData(device) and noDims.x, .y; depth in float metres, rgb in 4 bytes per pixel
///                  calib (object or pointer): intrinsics_d, intrinsics_rgb with projectionParamsSimple.fx, .fy, .px, .py,
///                  and trafo_rgb_to_depth.calib
///   TrackingState  pose_d: a pointer to a pose with GetM() and SetM(); the matrix is camera_from_world
///   matrices       column-major in a member array m[16]
///
/// In the host's engine:
///
///   foothold::ForestRelocaliser forest(context);
///   foothold::infinitam::Adapter adapter(forest, MEMORYDEVICE_CUDA, foothold::MemoryKind::kCuda);
///   ...
///   if (tracking is good) adapter.train(*view, *trackingState);
///   if (tracking failed) found = adapter.relocalise(*view, *trackingState);
///   adapter.update();
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/contract.h"
#include "foothold/frames/colour_registration.h"

namespace foothold::infinitam {

namespace detail {

/// Hosts keep their calibration as a member or behind a pointer.
template <class T>
const T& dereferenced(const T& object) {
  return object;
}
template <class T>
const T& dereferenced(T* pointer) {
  return *pointer;
}

template <class Projection>
Intrinsics intrinsics(const Projection& projection) {
  return {static_cast<float>(projection.fx), static_cast<float>(projection.fy), static_cast<float>(projection.px),
          static_cast<float>(projection.py)};
}

}  // namespace detail

/// Reads a rigid transform from a column-major 4x4 matrix; its rotation is re-orthonormalised, as trackers accumulate rounding.
/// @pre describe_pose_error() of the matrix is empty: it neither mirrors nor scales.
template <class Matrix>
SE3 to_se3(const Matrix& matrix) {
  SE3 result;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) result.rotation(row, column) = matrix.m[4 * column + row];
  }
  for (int row = 0; row < 3; ++row) result.translation[row] = matrix.m[12 + row];
  FOOTHOLD_EXPECTS_NO_ERROR(describe_pose_error(result, "the matrix"));
  result.rotation = nearest_rotation(result.rotation);
  return result;
}

/// Writes a rigid transform as a column-major 4x4 matrix.
template <class Matrix>
Matrix from_se3(const SE3& transform) {
  Matrix matrix;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) matrix.m[4 * column + row] = transform.rotation(row, column);
    matrix.m[4 * column + 3] = 0.0F;
  }
  for (int row = 0; row < 3; ++row) matrix.m[12 + row] = transform.translation[row];
  matrix.m[15] = 1.0F;
  return matrix;
}

/// The camera's pose in a tracking state, which holds its inverse.
template <class TrackingState>
SE3 world_from_camera(const TrackingState& state) {
  return to_se3(state.pose_d->GetM()).inverse();
}

/// Sets the camera's pose in a tracking state.
template <class TrackingState>
void set_world_from_camera(TrackingState& state, const SE3& world_from_camera) {
  using Matrix = std::decay_t<decltype(state.pose_d->GetM())>;
  state.pose_d->SetM(from_se3<Matrix>(world_from_camera.inverse()));
}

/// Views the images of a host's view. They must stay alive, and unchanged, while the frame is used.
///
/// Colour comes as the host has it: registered to depth or not, and of any size. The Adapter registers it.
///
/// @param device  The host's own name for the memory that its images are up to date in, as GetData() takes it.
/// @param memory  The same memory in Foothold's terms.
template <class View, class MemoryDevice>
Frame make_frame(const View& view, MemoryDevice device, const Memory& memory, std::int64_t index = 0) {
  const auto& calibration = detail::dereferenced(view.calib);
  Frame frame;
  frame.depth = {view.depth->GetData(device), view.depth->noDims.x, view.depth->noDims.y, memory};
  frame.colour = {reinterpret_cast<const std::uint8_t*>(view.rgb->GetData(device)), view.rgb->noDims.x, view.rgb->noDims.y,
                  static_cast<int>(sizeof(*view.rgb->GetData(device))), memory};
  frame.calibration.depth = detail::intrinsics(calibration.intrinsics_d.projectionParamsSimple);
  frame.calibration.colour = detail::intrinsics(calibration.intrinsics_rgb.projectionParamsSimple);
  frame.calibration.depth_from_colour = to_se3(calibration.trafo_rgb_to_depth.calib);
  frame.index = index;
  return frame;
}

/// Drives a relocaliser with a host's views and tracking states. Both must outlive it.
///
/// Where the host calibrates its two cameras instead of registering their images, colour is registered to depth first, since a camera is
/// found more surely so: about 1.4 ms for 640x480 pixels, and in CUDA memory two waits for the device (ColourRegistration).
template <class MemoryDevice>
class Adapter {
 public:
  /// @param device  As in make_frame().
  Adapter(Relocaliser& relocaliser, MemoryDevice device, const Memory& memory)
      : relocaliser_(relocaliser), device_(device), memory_(memory) {}

  /// Learns from a view whose pose the host trusts.
  template <class View, class TrackingState>
  void train(const View& view, const TrackingState& state) {
    relocaliser_.train(next_frame(view), world_from_camera(state));
  }

  /// Looks for a lost camera. If the best proposal is confident enough, it is written into the tracking state, for the host to refine by
  /// tracking as usual. @return The accepted proposal; empty if there is none, and the tracking state is as before.
  template <class View, class TrackingState>
  std::optional<PoseEstimate> relocalise(const View& view, TrackingState& state) {
    const std::vector<PoseEstimate> estimates = relocaliser_.relocalise(next_frame(view));
    if (estimates.empty() || estimates.front().confidence < relocaliser_.acceptance_threshold()) return std::nullopt;
    set_world_from_camera(state, estimates.front().world_from_camera);
    return estimates.front();
  }

  /// Spends spare time on the relocaliser's upkeep. Call between frames.
  void update() { relocaliser_.update(); }

  /// Forgets the scene, when the host starts another.
  void reset() { relocaliser_.reset(); }

 private:
  template <class View>
  Frame next_frame(const View& view) {
    return registration_.apply(make_frame(view, device_, memory_, num_frames_++));
  }

  Relocaliser& relocaliser_;
  MemoryDevice device_;
  Memory memory_;
  std::int64_t num_frames_ = 0;
  ColourRegistration registration_;
};

}  // namespace foothold::infinitam
