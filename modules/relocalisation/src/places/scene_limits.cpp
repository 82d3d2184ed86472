// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/scene_limits.h"

#include <cmath>
#include <string>

#include "examples/training_examples.h"

namespace foothold {
namespace {

constexpr double kFullShare = 0.875;  ///< of the budget
constexpr double kTooMuch = 0.01;     ///< of a frame's examples beyond reach; stray readings of cameras are fewer

double megabytes(std::size_t num_bytes) { return 1e-6 * static_cast<double>(num_bytes); }

}  // namespace

int SceneLimits::examples_per_view(Detail detail) const {
  const bool is_fewer = examples_per_view_ == 0 || kSparseExamplesPerView < examples_per_view_;
  return detail == Detail::kSparse && is_fewer ? kSparseExamplesPerView : examples_per_view_;
}

bool SceneLimits::is_full(std::size_t state_bytes) const { return bounds_memory() && megabytes(state_bytes) >= kFullShare * budget_mb_; }

void SceneLimits::watch_thinning(const Context& context, std::size_t state_bytes, std::int64_t frame_index) {
  if (gave_up_detail_) return;
  gave_up_detail_ = true;
  const std::string sparse = std::to_string(examples_per_view(Detail::kSparse));
  context.log(LogLevel::kWarning, reached(state_bytes, frame_index) +
                                      "; from here on detail makes room for new places: every second point " +
                                      "is forgotten where most are held, and at most " + sparse + " examples of a view are learnt");
}

Detail SceneLimits::detail(const Context& context, std::size_t state_bytes, std::int64_t frame_index) {
  if (!is_full(state_bytes)) return gave_up_detail_ ? Detail::kSparse : Detail::kFull;
  if (!told_none_) {
    context.log(LogLevel::kWarning, reached(state_bytes, frame_index) +
                                        ", with no detail left to give up; from here on nothing is learnt: " +
                                        "the camera is found where it was before, and nowhere else");
  }
  told_none_ = true;
  return Detail::kNone;
}

std::string SceneLimits::reached(std::size_t state_bytes, std::int64_t frame_index) const {
  return "frame " + std::to_string(frame_index) + ": the relocaliser's scene holds " + std::to_string(std::lround(megabytes(state_bytes))) +
         " MB, and memory_budget_mb is " + std::to_string(budget_mb_);
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
