// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/frames/colour_registration.h"

#include "foothold/frames/register_colour.h"

namespace foothold {

Frame ColourRegistration::apply(const Frame& frame) {
  const bool is_whole = !frame.depth.empty() && !frame.colour.empty() && frame.depth.memory == frame.colour.memory;
  if (!is_whole || is_registered(frame)) return frame;
  return frame.depth.memory == MemoryKind::kHost ? register_colour(frame, registered_) : apply_on_device(frame);
}

Frame ColourRegistration::apply_on_device(const Frame& frame) {
  const Memory& device = frame.depth.memory;
  Frame on_host = frame;
  if (depth_m_.width() != frame.depth.width || depth_m_.height() != frame.depth.height) {
    depth_m_ = Image<float>(frame.depth.width, frame.depth.height);
  }
  detail::copy_memory(MemoryKind::kHost, depth_m_.data(), device, frame.depth.data, depth_m_.size() * sizeof(float));
  on_host.depth = depth_m_.view();
  const std::size_t num_pixels = static_cast<std::size_t>(frame.colour.width) * static_cast<std::size_t>(frame.colour.height);
  colour_.resize(num_pixels * static_cast<std::size_t>(frame.colour.bytes_per_pixel));
  detail::copy_memory(MemoryKind::kHost, colour_.data(), device, frame.colour.data, colour_.size());
  on_host.colour.data = colour_.data();
  on_host.colour.memory = MemoryKind::kHost;
  Frame result = register_colour(on_host, registered_);
  if (device_colour_.memory() != device) device_colour_ = Array<std::uint8_t>(device);
  device_colour_.assign({result.colour.data, registered_.size() * sizeof(Rgb8)});
  result.depth = frame.depth;
  result.colour.data = device_colour_.data();
  result.colour.memory = device;
  return result;
}

}  // namespace foothold
