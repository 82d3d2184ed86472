// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "frame_images.h"

#include <algorithm>

#include "foothold/frames/register_colour.h"
#include "foothold/io/image_file.h"
#include "text_file.h"

namespace foothold::io {
namespace {

Image<float> depth_in_metres(const Image<std::uint16_t>& raw, float units_per_m) {
  constexpr std::uint16_t kInvalid = 65535;
  Image<float> depth(raw.width(), raw.height());
  std::transform(raw.data(), raw.data() + raw.size(), depth.data(),
                 [&](std::uint16_t value) { return value == kInvalid ? 0.0F : static_cast<float>(value) / units_per_m; });
  return depth;
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

void read_frame_images(const std::filesystem::path& colour_file, const std::filesystem::path& depth_file, float depth_units_per_m,
                       const SequenceOptions& options, RgbdFrame& frame) {
  frame.depth = depth_in_metres(read_u16_image(depth_file.string()), depth_units_per_m);
  frame.colour = read_rgb_image(colour_file.string());
  if (frame.colour.width() != frame.depth.width() || frame.colour.height() != frame.depth.height()) {
    throw_file_error(colour_file, size_text(frame.colour.width(), frame.colour.height()) + " pixels",
                     size_text(frame.depth.width(), frame.depth.height()) + " as in " + depth_file.filename().string());
  }
  if (options.register_colour) register_colour(frame);
}

std::string recording_name(const std::filesystem::path& folder) {
  std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  const std::string name = path.filename().string();
  const std::string parent = path.parent_path().filename().string();
  return name.rfind("seq-", 0) == 0 && !parent.empty() ? parent + "/" + name : name;
}

}  // namespace foothold::io
