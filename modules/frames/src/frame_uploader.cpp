// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/frames/frame_uploader.h"

#include "foothold/base/contract.h"

namespace foothold {

FrameUploader::FrameUploader(const Context& context) : context_(context), depth_m_(context.memory()), colour_(context.memory()) {}

Frame FrameUploader::upload(const Frame& frame) {
  if (frame.depth.memory == context_.memory() || !describe_frame_error(frame).empty()) return frame;
  FOOTHOLD_EXPECTS(frame.depth.memory == MemoryKind::kHost);
  const ScopedStage stage(context_, "upload");
  const std::size_t num_colour_bytes = frame.depth.size() * static_cast<std::size_t>(frame.colour.bytes_per_pixel);
  depth_m_.assign(context_, {frame.depth.data, frame.depth.size()});
  colour_.assign(context_, {frame.colour.data, num_colour_bytes});
  Frame uploaded = frame;
  uploaded.depth.data = depth_m_.data();
  uploaded.depth.memory = depth_m_.memory();
  uploaded.colour.data = colour_.data();
  uploaded.colour.memory = colour_.memory();
  return uploaded;
}

}  // namespace foothold
