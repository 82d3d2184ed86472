// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The lists of TUM and 7-Scenes folders. The byte 0xff, if there is one, separates the list of depth images from that of colour images.
#include <algorithm>

#include "fuzz.h"
#include "seven_scenes_sequence.h"
#include "trajectory.h"
#include "tum_sequence.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foothold;
  const std::string text = fuzz::text_of(data, size);
  const std::string first = text.substr(0, text.find('\xff'));
  const std::string second = first.size() < text.size() ? text.substr(first.size() + 1) : first;

  fuzz::attempt([&] {
    constexpr double kMaxDifference_s = 0.02;
    const auto depth = io::parse_image_list(first, "depth.txt");
    const auto pairs = io::associate(depth, io::parse_image_list(second, "rgb.txt"), kMaxDifference_s);
    fuzz::require(pairs.size() <= depth.size());
    for (const io::ImagePair& pair : pairs) {
      fuzz::require(std::abs(pair.depth.timestamp_s - pair.colour.timestamp_s) <=
                    1.001 * kMaxDifference_s + 1e-9 * std::abs(pair.depth.timestamp_s));
    }
  });
  fuzz::attempt([&] { fuzz::require(!io::parse_associations(text, "associations.txt").empty()); });
  fuzz::attempt([&] {
    const auto trajectory = io::parse_trajectory(text, "groundtruth.txt");
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
      fuzz::require(is_rigid(trajectory[i].world_from_camera, 1e-5F));
      fuzz::require(i == 0 || trajectory[i - 1].timestamp_s < trajectory[i].timestamp_s);
      const double between_s = trajectory[i].timestamp_s + 0.01;
      if (const auto pose = io::interpolate(trajectory, between_s, 1e9)) fuzz::require(is_rigid(*pose, 1e-4F));
    }
  });
  fuzz::attempt([&] { fuzz::require(io::parse_timestamps(text, 3, "timestamps.txt").size() == 3); });
  fuzz::attempt([&] { fuzz::require(!io::parse_split(text, "TrainSplit.txt").empty()); });
  return 0;
}
