// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/scene_limits.h"

#include <cmath>
#include <string>

#include "examples/training_examples.h"

namespace foothold {
namespace {

constexpr double kFullShare = 0.5;      ///< of the budget, up to which everything is learnt
constexpr double kSparseShare = 0.875;  ///< up to which anything is
constexpr double kTooMuch = 0.01;       ///< of a frame's examples beyond reach; stray readings of cameras are fewer

}  // namespace

int SceneLimits::examples_per_view(Detail detail) const {
  const bool is_fewer = examples_per_view_ == 0 || kSparseExamplesPerView < examples_per_view_;
  return detail == Detail::kSparse && is_fewer ? kSparseExamplesPerView : examples_per_view_;
}

Detail SceneLimits::detail(const Context& context, std::size_t state_bytes, std::int64_t frame_index) {
  const double used_mb = 1e-6 * static_cast<double>(state_bytes);
  if (!bounds_memory() || used_mb < kFullShare * budget_mb_) return Detail::kFull;
  const Detail detail = used_mb < kSparseShare * budget_mb_ ? Detail::kSparse : Detail::kNone;
  bool& told = detail == Detail::kSparse ? told_sparse_ : told_none_;
  const bool changes = detail == Detail::kNone || examples_per_view(detail) != examples_per_view_;
  if (told || !changes) return detail;
  told = true;
  const std::string reached = "frame " + std::to_string(frame_index) + ": the relocaliser's scene holds " +
                              std::to_string(std::lround(used_mb)) + " MB, and memory_budget_mb is " + std::to_string(budget_mb_);
  const std::string sparse = "; from here on at most " + std::to_string(kSparseExamplesPerView) +
                             " examples of a view are learnt, and none of views that have as many, so that there is room for new places";
  const std::string none = "; from here on nothing is learnt: the camera is found where it was before, and nowhere else";
  context.log(LogLevel::kWarning, reached + (detail == Detail::kSparse ? sparse : none));
  return detail;
}

void SceneLimits::watch_reach(const Context& context, std::size_t num_beyond_reach, std::size_t num_examples, std::int64_t frame_index) {
  if (told_reach_ || static_cast<double>(num_beyond_reach) <= kTooMuch * static_cast<double>(num_examples)) return;
  told_reach_ = true;
  const double fraction = static_cast<double>(num_beyond_reach) / static_cast<double>(num_examples);
  context.log(LogLevel::kWarning, "frame " + std::to_string(frame_index) + ": " + std::to_string(std::lround(100.0 * fraction)) +
                                      " % of it lies more than " + std::to_string(std::lround(kReachMm * 0.001F)) +
                                      " m from where its place began, and is not learnt");
}

}  // namespace foothold
