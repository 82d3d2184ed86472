// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What poses and depth that hardly fit would fit with: another focal length, another scale, poses of another time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pose_check.h"

namespace foothold::io {

struct NearMiss {
  enum class Kind {
    kFocalLength,  ///< focal lengths times `amount`
    kDepth,        ///< depth times `amount`
    kRays,         ///< depth that was measured along rays
    kDelay,        ///< the poses of `amount` frames later
  };
  Kind kind = Kind::kFocalLength;
  double amount = 1.0;
  Agreement agreement;
  Agreement as_read;  ///< of the same pairs, without it
};

/// The one of these changes under which frames agree best, if they agree far better than as they are read. Right recordings have their
/// best agreement as they are: of RedKitchen seq-01, fr3/teddy and rendered rooms, no change agrees better at all.
/// @param poses  of all frames, in the convention of the pairs'.
/// Cost: projects each pair some 60 times.
std::optional<NearMiss> find_near_miss(const std::vector<FramePair>& pairs, const Intrinsics& camera,
                                       const std::vector<std::optional<RecordedPose>>& poses);

/// What follows "more would agree": "with focal lengths of about 585 instead of 702 pixels (--intrinsics)".
std::string describe(const NearMiss& miss, const Intrinsics& camera);

}  // namespace foothold::io
