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
///
/// Give it the context of those who work on the frames, or a copy of it: all then happens in the order in which it is asked. Contexts that
/// were made apart do not wait for each other, and one would read what the other still writes; what uploads on a context of its own needs
/// Context::wait_for() twice: the worker's for the uploader's before each frame is used, the uploader's for the worker's before the next.
class FrameUploader {
 public:
  /// Uploads to the context's memory, on its stream.
  explicit FrameUploader(const Context& context);

  /// @return The frame in the context's memory, valid for work on the context until the next call. The frame itself if it lives there, or
  ///         is malformed, which is for its consumer to find out.
  /// @pre The frame lives in the context's memory or the host's.
  Frame upload(const Frame& frame);

 private:
  Context context_;
  Array<float> depth_m_;
  Array<std::uint8_t> colour_;
};

}  // namespace foothold
