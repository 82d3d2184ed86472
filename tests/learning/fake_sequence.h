// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "foothold/api/frame_source.h"
#include "foothold/base/random.h"

namespace foothold::test {

/// A camera that moves 5 cm a frame past a wavy, speckled wall.
class FakeSequence : public Sequence {
 public:
  FakeSequence(std::string name, int num_frames, float phase = 0.0F, bool with_poses = true)
      : name_(std::move(name)), num_frames_(num_frames), phase_(phase), with_poses_(with_poses) {}

  std::string name() const override { return name_; }
  int num_frames() const override { return num_frames_; }

  RgbdFrame load(int index) const override {
    constexpr int kWidth = 80;
    constexpr int kHeight = 60;
    RgbdFrame frame;
    frame.index = index;
    frame.calibration.depth = frame.calibration.colour = {73.0F, 73.0F, 39.5F, 29.5F};
    frame.depth = Image<float>(kWidth, kHeight);
    frame.colour = Image<Rgb8>(kWidth, kHeight);
    const float shift_m = 0.05F * static_cast<float>(index);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const float x = static_cast<float>(u) * 0.03F + shift_m;
        const float y = static_cast<float>(v) * 0.03F;
        frame.depth(u, v) = 2.0F + 0.5F * std::sin(3.0F * x + phase_) * std::cos(2.0F * y);
        const auto cell = static_cast<std::uint64_t>(std::floor(8.0F * x) + 1000.0F * std::floor(8.0F * y) + 100000.0F);
        const std::uint32_t bits = Random(7, cell).bits();
        frame.colour(u, v) = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
                              static_cast<std::uint8_t>(bits >> 16U)};
      }
    }
    if (with_poses_) {
      frame.world_from_camera = SE3{};
      frame.world_from_camera->translation.x() = shift_m;
    }
    return frame;
  }

 private:
  std::string name_;
  int num_frames_;
  float phase_;
  bool with_poses_;
};

}  // namespace foothold::test
