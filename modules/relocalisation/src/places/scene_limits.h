// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a scene leaves out for want of memory or of coordinates, said once each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "foothold/base/context.h"
#include "foothold/relocalisation/settings.h"

namespace foothold {

/// How much of a frame is learnt while the scene's memory is bounded. Detail goes before places do.
enum class Detail { kFull, kSparse, kNone };

/// Examples of a view that are learnt with Detail::kSparse, at most. (T) docs/experiments/places.md
inline constexpr int kSparseExamplesPerView = 16;

/// Decides how much is learnt (memory_budget_mb), and warns once of each reason for which a scene leaves something out.
///
/// Determinism: a function of the bytes that places hold, which are the same on every device and for any number of threads.
class SceneLimits {
 public:
  explicit SceneLimits(const ForestRelocaliserSettings& settings)
      : budget_mb_(settings.memory_budget_mb), examples_per_view_(settings.reservoirs.examples_per_view) {}

  bool bounds_memory() const { return budget_mb_ > 0; }

  /// Whether places must give up detail before more is learnt: 7/8 of the budget is used. The rest is for the modes of what was learnt
  /// last, which follow some frames later. @param state_bytes  memory of all places.
  bool is_full(std::size_t state_bytes) const;

  /// To be told when places gave up detail. @param state_bytes  before they did.
  void watch_thinning(const Context& context, std::size_t state_bytes, std::int64_t frame_index);

  /// All until detail had to be given up, few examples of a view after that, nothing if there is no room.
  Detail detail(const Context& context, std::size_t state_bytes, std::int64_t frame_index);

  /// Examples of a view to learn; 0 for no limit. @pre detail is not kNone.
  int examples_per_view(Detail detail) const;

  /// @param num_beyond_reach  of a frame's examples, those that lie where a place has no coordinates.
  void watch_reach(const Context& context, std::size_t num_beyond_reach, std::size_t num_examples, std::int64_t frame_index);

 private:
  std::string reached(std::size_t state_bytes, std::int64_t frame_index) const;

  int budget_mb_;
  int examples_per_view_;
  bool gave_up_detail_ = false;
  bool told_none_ = false;
  bool told_reach_ = false;
};

}  // namespace foothold
