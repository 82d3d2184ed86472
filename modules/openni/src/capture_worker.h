// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The thread that talks to OpenNI2.
#pragma once

#include <memory>

#include "capture_state.h"

namespace foothold::capture {

/// Opens the camera, delivers its pairs, and opens it again whenever it has gone away, until the state says stop. Errors of the first
/// opening end the thread and are left in the state.
void run_capture(const std::shared_ptr<CaptureState>& state);

}  // namespace foothold::capture
