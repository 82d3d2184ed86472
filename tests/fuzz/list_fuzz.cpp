// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The lists of TUM and 7-Scenes folders. The byte 0xff, if there is one, separates the list of depth images from that of colour images.
#include <algorithm>

#include "fuzz.h"
#include "seven_scenes_sequence.h"
#include "text_file.h"
#include "time_unit.h"
#include "trajectory.h"
#include "tum_sequence.h"

FOOTHOLD_FUZZ_TARGET(list) {
  using namespace foothold;
  const std::string text = io::plain_text(fuzz::text_of(data, size));
  const std::string first = text.substr(0, text.find('\xff'));
  const std::string second = first.size() < text.size() ? text.substr(first.size() + 1) : first;

  fuzz::attempt([&] {
    constexpr double kMaxDifference_s = 0.02;
    const auto depth = io::parse_image_list(first, "depth.txt");
    const auto colour = io::parse_image_list(second, "rgb.txt");
    std::vector<double> times;
    for (const io::StampedFile& image : depth) times.push_back(image.timestamp_s);
    fuzz::require(io::seconds_per_unit(times) > 0.0);
    const auto [d, c] = io::nearest_pair(depth, colour);
    fuzz::require(d < depth.size() && c < colour.size() && !io::time_text(depth[d].timestamp_s).empty());
    const auto pairs = io::associate(depth, colour, kMaxDifference_s);
    fuzz::require(pairs.size() <= depth.size());
    for (const io::ImagePair& pair : pairs) {
      fuzz::require(std::abs(pair.depth.timestamp_s - pair.colour.timestamp_s) <=
                    1.001 * kMaxDifference_s + 1e-9 * std::abs(pair.depth.timestamp_s));
    }
  });
  fuzz::attempt([&] { fuzz::require(!io::parse_associations(text, "associations.txt").empty()); });
  fuzz::attempt([&] {
    for (const StampedPose& pose : io::parse_trajectory(text, "trajectory.txt")) fuzz::require(is_rigid(pose.world_from_camera, 1e-5F));
  });
  fuzz::attempt([&] {
    const auto truth = io::parse_ground_truth(text, "groundtruth.txt");
    for (std::size_t i = 0; i < truth.size(); ++i) {
      fuzz::require(i == 0 || truth[i - 1].timestamp_s < truth[i].timestamp_s);
      const double between_s = truth[i].timestamp_s + 0.01;
      const auto pose = io::interpolate(truth, between_s, 1e9);
      if (pose.has_value()) fuzz::require(is_rigid(to_se3(*pose, Eigen::Vector3d::Zero()), 1e-4F));
    }
  });
  fuzz::attempt([&] { fuzz::require(io::parse_timestamps(text, 3, "timestamps.txt").size() == 3); });
  fuzz::attempt([&] { fuzz::require(!io::parse_split(text, "TrainSplit.txt").empty()); });
  return 0;
}
