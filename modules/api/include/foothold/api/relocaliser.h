// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The interface that trackers see.
#pragma once

#include <cstddef>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/se3.h"

namespace foothold {

/// A proposed pose of the depth camera.
struct PoseEstimate {
  SE3 world_from_camera;  ///< maps points of the depth camera to the world [m]
  /// Calibrated probability that the pose is right (within 10 cm and 10 deg), in [0, 1].
  float confidence = 0.0F;
};

/// Finds the pose of a camera that has lost track, in a scene learnt from the frames it saw before.
///
/// Frames are best with colour registered to depth (register_colour()): implementations may take the colour of a depth pixel from the same
/// pixel of the colour image, whatever the calibration says.
///
/// One object serves one thread of control. Frames may live in host or CUDA memory, as the implementation's context demands.
///
/// Every function throws ContractViolation with a text that says what is wrong for a malformed frame or pose (describe_frame_error(),
/// describe_pose_error()), CudaError if the device fails, and std::bad_alloc. None throws because of what the camera sees.
class Relocaliser {
 public:
  virtual ~Relocaliser() = default;

  /// Learns from a frame whose pose is trusted. Bounded work. A frame without valid depth teaches nothing. A pose that mirrors, scales or
  /// shears, or holds numbers that are not finite, is refused; kRigidTolerance says what passes.
  ///
  /// May return before the device has read a frame in CUDA memory: its images may be overwritten by work on the context's stream (see
  /// ContextOptions::cuda_stream), or by anyone once Context::synchronise() has returned. Images in host memory are free at once.
  /// @pre describe_frame_error(frame) and describe_pose_error(world_from_camera) are empty.
  virtual void train(const Frame& frame, const SE3& world_from_camera) = 0;

  /// Proposes camera poses for a frame, best first, each with a confidence; empty when none is plausible, as before any training.
  /// The frame's images are free when it returns.
  /// @pre describe_frame_error(frame) is empty.
  virtual std::vector<PoseEstimate> relocalise(const Frame& frame) = 0;

  /// Spends spare time on upkeep (re-clustering). Call between frames.
  virtual void update() = 0;

  /// Forgets the scene; keeps what was learnt offline.
  virtual void reset() = 0;

  /// Memory held for the scene learnt so far [bytes].
  virtual std::size_t state_bytes() const = 0;

  /// The confidence at and above which a host should believe the first estimate.
  virtual float acceptance_threshold() const = 0;

 protected:
  Relocaliser() = default;
  /// Copies are made by derived classes.
  Relocaliser(const Relocaliser&) = default;
  /// Copies are made by derived classes.
  Relocaliser& operator=(const Relocaliser&) = default;
};

}  // namespace foothold
