// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The camera of tests that make averaged images by hand.
#pragma once

#include "foothold/base/camera.h"

namespace foothold::test {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr Intrinsics kCamera{146.0F, 146.0F, 80.0F, 60.0F};

}  // namespace foothold::test
