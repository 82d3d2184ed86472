// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Finds the depth and colour images that were taken at the same time.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace foothold::capture {

/// Matches two streams of images by their time stamps.
///
/// Each stream's stamps rise. The older of two images that do not match can find no partner any more and is dropped. A stream may run ahead
/// of the other by a few images, as USB transfers do.
template <class Image>
class FramePairer {
 public:
  struct Pair {
    Image depth;
    Image colour;
    double depth_time_s = 0.0;
  };

  explicit FramePairer(double tolerance_s) : tolerance_s_(tolerance_s) {}

  std::optional<Pair> add_depth(double time_s, Image image) { return add(depth_, time_s, std::move(image)); }
  std::optional<Pair> add_colour(double time_s, Image image) { return add(colour_, time_s, std::move(image)); }

  /// Images that found no partner so far.
  std::int64_t num_dropped() const { return num_dropped_; }
  /// Forgets the waiting images, as after a reconnection; they do not count as dropped.
  void clear() {
    depth_.clear();
    colour_.clear();
  }

 private:
  struct Stamped {
    double time_s;
    Image image;
  };
  static constexpr std::size_t kMaxWaiting = 4;  ///< per stream; a lead of 133 ms at 30 Hz

  std::optional<Pair> add(std::deque<Stamped>& stream, double time_s, Image image) {
    stream.push_back({time_s, std::move(image)});
    while (!depth_.empty() && !colour_.empty()) {
      const double lead_s = depth_.front().time_s - colour_.front().time_s;
      if (std::abs(lead_s) <= tolerance_s_) {
        Pair pair{std::move(depth_.front().image), std::move(colour_.front().image), depth_.front().time_s};
        depth_.pop_front();
        colour_.pop_front();
        return pair;
      }
      drop(lead_s < 0.0 ? depth_ : colour_);
    }
    if (stream.size() > kMaxWaiting) drop(stream);
    return std::nullopt;
  }
  void drop(std::deque<Stamped>& stream) {
    stream.pop_front();
    ++num_dropped_;
  }

  double tolerance_s_;
  std::deque<Stamped> depth_;
  std::deque<Stamped> colour_;
  std::int64_t num_dropped_ = 0;
};

}  // namespace foothold::capture
