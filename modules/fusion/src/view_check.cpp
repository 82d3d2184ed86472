// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/view_check.h"

#include <algorithm>
#include <cmath>

#include "view_check_ops.h"

namespace foothold {

ViewCheck::ViewCheck(const Context& context, const ViewCheckSettings& settings)
    : context_(context), settings_(settings), scratch_(std::make_unique<Scratch>(context.memory())) {
  settings.validate();
}
ViewCheck::~ViewCheck() = default;
ViewCheck::ViewCheck(ViewCheck&&) noexcept = default;
ViewCheck& ViewCheck::operator=(ViewCheck&&) noexcept = default;

void ViewCheck::set_frame(const Frame& frame) {
  FOOTHOLD_EXPECTS(describe_frame_error(frame).empty());
  FOOTHOLD_EXPECTS(frame.depth.memory == context_.memory());
  Scratch& scratch = *scratch_;
  const auto stride = static_cast<float>(settings_.stride_px);
  const auto offset = static_cast<float>(settings_.stride_px / 2);
  const Intrinsics& k = frame.calibration.depth;
  scratch.width = frame.depth.width / settings_.stride_px;
  scratch.height = frame.depth.height / settings_.stride_px;
  scratch.intrinsics = {k.fx / stride, k.fy / stride, (k.cx - offset) / stride, (k.cy - offset) / stride};
  scratch.pixels.resize(static_cast<std::size_t>(scratch.width) * static_cast<std::size_t>(scratch.height));
  dispatch<ViewCheckOps>(context_, [&](auto ops) { ops.sample_frame(context_, frame, settings_, scratch); });
}

namespace {
/// The moments of two variables over pixels.
struct Moments {
  double count = 0.0;
  double variance[2] = {};  ///< times count
  double covariance = 0.0;

  /// Adds the moments of some sums about their own means.
  template <class Sums>
  void add(const Sums& sums) {
    const double n = static_cast<double>(sums[kColours]);
    if (n < 1.0) return;
    const auto centred = [&](CheckSum product, CheckSum a, CheckSum b) {
      return static_cast<double>(sums[product]) - static_cast<double>(sums[a]) * static_cast<double>(sums[b]) / n;
    };
    count += n;
    variance[0] += centred(kLive2, kLive, kLive);
    variance[1] += centred(kModel2, kModel, kModel);
    covariance += centred(kLiveModel, kLive, kModel);
  }

  /// The correlation; 0 if either variable hardly varies, since there is noise then rather than a pattern.
  float correlation(double min_deviation) const {
    const double floor = min_deviation * min_deviation * count;
    if (!(variance[0] > floor && variance[1] > floor)) return 0.0F;
    return static_cast<float>(covariance / std::sqrt(variance[0] * variance[1]));
  }
};

/// Standard deviation of grey in [0, 1] below which a view counts as without shades, or without texture.
constexpr double kMinShade = 0.01;
constexpr double kMinTexture = 0.004;
}  // namespace

ViewAgreement ViewCheck::compare(const SurfaceMap& model, const SE3& world_from_camera) {
  FOOTHOLD_EXPECTS(!model.empty() && model.pixels.memory() == context_.memory());
  const SE3 model_from_camera = model.camera.world_from_camera.inverse() * world_from_camera;
  const std::vector<float> tile_sums =
      dispatch<ViewCheckOps>(context_, [&](auto ops) { return ops.compare(context_, model, model_from_camera, settings_, *scratch_); });

  double sums[kNumCheckSums] = {};
  Moments texture;
  for (std::size_t first = 0; first < tile_sums.size(); first += kNumCheckSums) {
    for (std::size_t j = 0; j < kNumCheckSums; ++j) sums[j] += static_cast<double>(tile_sums[first + j]);
    texture.add(tile_sums.data() + first);
  }
  Moments shades;
  shades.add(sums);

  const auto part = [](double count, double of) { return of > 0.0 ? static_cast<float>(count / of) : 0.0F; };
  ViewAgreement result;
  result.num_valid = static_cast<int>(sums[kValid]);
  result.overlap = part(sums[kOverlap], sums[kValid]);
  result.agreement = part(sums[kAgree], sums[kOverlap]);
  result.in_front = part(sums[kFront], sums[kOverlap]);
  result.behind = part(sums[kBehind], sums[kOverlap]);
  result.difference = part(sums[kDifference], sums[kOverlap]);
  result.colour_correlation = shades.correlation(kMinShade);
  result.texture_correlation = texture.correlation(kMinTexture);
  return result;
}

}  // namespace foothold
