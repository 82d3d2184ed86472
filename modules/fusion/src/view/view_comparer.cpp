// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/view_comparer.h"

#include <cmath>

#include "foothold/base/exec/dispatch.h"
#include "view/view_comparer_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct ViewAlgorithms<CudaExecutor>;
#endif

ViewComparer::ViewComparer(const Context& context, const DepthRange& range)
    : context_(context), range_(range), scratch_(std::make_unique<Scratch>(context.memory())) {}
ViewComparer::~ViewComparer() = default;
ViewComparer::ViewComparer(ViewComparer&&) noexcept = default;
ViewComparer& ViewComparer::operator=(ViewComparer&&) noexcept = default;

void ViewComparer::set_frame(const Frame& frame) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
  FOOTHOLD_EXPECTS(frame.depth.memory == context_.memory());
  Scratch& scratch = *scratch_;
  const auto stride = static_cast<float>(kViewStridePx);
  const auto offset = static_cast<float>(kViewStridePx / 2);
  const Intrinsics& k = frame.calibration.depth;
  scratch.width = frame.depth.width / kViewStridePx;
  scratch.height = frame.depth.height / kViewStridePx;
  scratch.intrinsics = {k.fx / stride, k.fy / stride, (k.cx - offset) / stride, (k.cy - offset) / stride};
  scratch.pixels.resize(static_cast<std::size_t>(scratch.width) * static_cast<std::size_t>(scratch.height));
  dispatch(context_, [&](auto on) { ViewAlgorithms<typename decltype(on)::Executor>::sample_frame(context_, frame, range_, scratch); });
}

namespace {
/// The correlation; 0 if either variable hardly varies, since there is noise then rather than a pattern.
float correlation(const ViewMoments& moments, double min_deviation) {
  const double floor = min_deviation * min_deviation * moments.count;
  if (!(moments.live_variance > floor && moments.model_variance > floor)) return 0.0F;
  return static_cast<float>(moments.covariance / std::sqrt(moments.live_variance * moments.model_variance));
}

ViewAgreement summarise(const ViewTotals& totals) {
  // Standard deviation of grey in [0, 1] below which a view counts as without shades, or without texture.
  constexpr double kMinShade = 0.01;
  constexpr double kMinTexture = 0.004;
  const double(&sums)[kNumViewSums] = totals.sums;
  const auto part = [](double count, double of) { return of > 0.0 ? static_cast<float>(count / of) : 0.0F; };
  ViewAgreement result;
  result.num_valid = static_cast<int>(sums[kValid]);
  result.overlap = part(sums[kOverlap], sums[kValid]);
  result.agreement = part(sums[kAgree], sums[kOverlap]);
  result.in_front = part(sums[kFront], sums[kOverlap]);
  result.behind = part(sums[kBehind], sums[kOverlap]);
  result.solid_in_front = part(sums[kSolidFront], sums[kOverlap]);
  result.solid_behind = part(sums[kSolidBehind], sums[kOverlap]);
  result.difference = part(sums[kDifference], sums[kOverlap]);
  result.colour_correlation = correlation(moments_of(sums), kMinShade);
  result.texture_correlation = correlation(totals.texture, kMinTexture);
  result.unlike_texture = part(totals.num_unlike, totals.num_textured);
  return result;
}
}  // namespace

ViewAgreement ViewComparer::compare(const SurfaceMap& model, const SE3& world_from_camera) {
  scratch_->pose.assign(context_, Span<const SE3>(&world_from_camera, 1));
  compare_all(model, scratch_->pose);
  HostReads reads;
  queue_results(reads);
  reads.wait(context_);
  return results().front();
}

void ViewComparer::compare_all(const SurfaceMap& models, const Array<SE3>& world_from_cameras) {
  FOOTHOLD_EXPECTS(!models.empty() && models.pixels.memory() == context_.memory());
  FOOTHOLD_EXPECTS(world_from_cameras.size() == models.num_renderings() && world_from_cameras.memory() == context_.memory());
  dispatch(context_, [&](auto on) {
    ViewAlgorithms<typename decltype(on)::Executor>::compare(context_, models, world_from_cameras.data(), *scratch_);
  });
}

void ViewComparer::queue_results(HostReads& reads) { reads.add(scratch_->totals, scratch_->host_totals); }

std::vector<ViewAgreement> ViewComparer::results() const {
  std::vector<ViewAgreement> results;
  for (const ViewTotals& totals : scratch_->host_totals) results.push_back(summarise(totals));
  return results;
}

}  // namespace foothold
