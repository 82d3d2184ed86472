// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Brings frames from the host to the device that is to work on them.
#pragma once

#include <cstdint>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"

namespace foothold {

/// Copies frames to a context's memory, which is kept from frame to frame. Free where they are there already, as on the CPU.
class FrameUploader {
 public:
  explicit FrameUploader(const Context& context);

  /// @return The frame in the context's memory, valid for work on the context until the next call. The frame itself if it lives there, or
  /// is
  ///         malformed, which is for its consumer to find out.
  /// @pre The frame lives in the context's memory or the host's.
  Frame upload(const Frame& frame);

 private:
  Context context_;
  Array<float> depth_m_;
  Array<std::uint8_t> colour_;
};

}  // namespace foothold
