// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What depths a recording holds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "foothold/base/camera.h"
#include "foothold/io/recording_check.h"

namespace foothold::io {

/// Collects depths of every fourth pixel in both directions.
class DepthStatistics {
 public:
  /// Adds a frame; an empty image is none.
  void add(const Image<float>& depth_m) {
    constexpr int kStep = 4;
    if (depth_m.empty()) return;
    ++num_frames_;
    for (int v = 0; v < depth_m.height(); v += kStep) {
      for (int u = 0; u < depth_m.width(); u += kStep) {
        ++num_pixels_;
        if (is_valid_depth(depth_m(u, v))) depths_m_.push_back(depth_m(u, v));
      }
    }
  }

  /// Fills in what is known of depth.
  void finish(RecordingCheck& check) {
    check.num_depth_frames = num_frames_;
    if (num_pixels_ == 0 || depths_m_.empty()) return;
    const auto count = static_cast<double>(depths_m_.size());
    check.valid_fraction = count / static_cast<double>(num_pixels_);
    const auto within = std::count_if(depths_m_.begin(), depths_m_.end(), [](float z) {
      return z >= static_cast<float>(kLeastMedianDepth_m) && z <= static_cast<float>(kMostMedianDepth_m);
    });
    check.within_fraction = static_cast<double>(within) / count;
    const auto middle = depths_m_.begin() + static_cast<std::ptrdiff_t>(depths_m_.size() / 2);
    std::nth_element(depths_m_.begin(), middle, depths_m_.end());
    check.median_depth_m = static_cast<double>(*middle);
  }

 private:
  int num_frames_ = 0;
  std::size_t num_pixels_ = 0;
  std::vector<float> depths_m_;
};

}  // namespace foothold::io
