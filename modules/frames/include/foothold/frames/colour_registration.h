// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Registration of colour to depth for a host whose images may live anywhere.
#pragma once

#include <cstdint>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"

namespace foothold {

/// Does what register_colour() does, in host and in CUDA memory, and keeps its buffers from frame to frame.
///
/// Images in CUDA memory are registered by the host: they are copied there, and the colour back, which waits for the device twice.
class ColourRegistration {
 public:
  /// @return The frame with registered colour, valid until the next call. The frame itself if it is registered already, or lacks an image,
  ///         which is for its consumer to find out.
  /// @throws ContractViolation for a malformed frame; CudaError if the device fails.
  Frame apply(const Frame& frame);

 private:
  Frame apply_on_device(const Frame& frame);

  Image<Rgb8> registered_;
  Image<float> depth_m_;
  Array<std::uint8_t> colour_;
  Array<std::uint8_t> device_colour_;
};

}  // namespace foothold
