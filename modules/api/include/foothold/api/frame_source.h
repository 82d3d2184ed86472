// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Where frames come from: recordings with random access, and sources that deliver one frame after another.
#pragma once

#include <Eigen/Core>
#include <string>

#include "foothold/api/frame.h"

namespace foothold {

/// A recording with random access.
class Sequence {
 public:
  virtual ~Sequence() = default;
  /// How messages and reports call it.
  virtual std::string name() const = 0;
  /// How many frames there are.
  virtual int num_frames() const = 0;
  /// Reads one frame. Thread-safe. @pre 0 <= index < num_frames() @throws FileError naming the file that is missing or damaged.
  virtual RgbdFrame load(int index) const = 0;
  /// Where the origin of this sequence's poses lies in the frame that its files use [m]: zero, unless a recording lies so far from its own
  /// origin that single precision would not do. Whoever writes poses down adds it.
  virtual Eigen::Vector3d origin_m() const { return Eigen::Vector3d::Zero(); }

 protected:
  Sequence() = default;
  /// Copies are made by derived classes.
  Sequence(const Sequence&) = default;
  /// Copies are made by derived classes.
  Sequence& operator=(const Sequence&) = default;
};

/// What came of waiting for a frame.
enum class ReadStatus {
  kFrame,     ///< a frame was delivered
  kEnd,       ///< there will be no more
  kTimedOut,  ///< none came in time; the next read may succeed
};

/// Delivers frames in order: a camera, or a recording played back.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Waits for the next frame, for a bounded time. @throws FileError or DeviceError if the source is broken for good.
  virtual ReadStatus read(RgbdFrame& frame) = 0;

 protected:
  FrameSource() = default;
  /// Copies are made by derived classes.
  FrameSource(const FrameSource&) = default;
  /// Copies are made by derived classes.
  FrameSource& operator=(const FrameSource&) = default;
};

}  // namespace foothold
