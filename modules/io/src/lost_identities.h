// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Loggers that write the identity where tracking was lost.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "foothold/base/context.h"
#include "recorded_pose.h"

namespace foothold::io {

/// Finds poses that are exactly the identity where no camera can have been: right behind a pose and, except at the end, right before a pose
/// that are more than 0.5 m or 20 degrees away, and twice as far as any other two consecutive poses are from each other. A camera that
/// begins at the identity, or comes back to it, is left alone, and so are recordings whose camera leaps anyway.
/// @param poses  In the order of time, in any unit.
/// @return Their places.
std::vector<std::size_t> find_lost_identities(const std::vector<std::optional<RecordedPose>>& poses);

/// Takes such poses away from frames or samples of a trajectory, and warns of them. @param subject  whose poses these are.
template <class Posed>
void drop_lost_identities(std::vector<Posed>& posed, const std::string& subject, const Context& context) {
  std::vector<std::optional<RecordedPose>> poses;
  for (const Posed& each : posed) poses.push_back(each.pose);
  const std::vector<std::size_t> lost = find_lost_identities(poses);
  if (lost.empty()) return;
  for (const std::size_t i : lost) posed[i].pose.reset();
  context.log(LogLevel::kWarning, subject + ": " + std::to_string(lost.size()) + " of its " + std::to_string(posed.size()) +
                                      " poses are the identity, far from those before and behind, and count as lost");
}

}  // namespace foothold::io
