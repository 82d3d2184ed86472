// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whether a pose is one that a person would hold a camera at.
#pragma once

#include "foothold/base/se3.h"
#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

/// True if the camera is inside the room, clear of every surface, and sees most of its view at a depth that a depth camera measures.
bool is_good_view(const Room& room, const SE3& world_from_camera);

}  // namespace foothold::synthetic_detail
