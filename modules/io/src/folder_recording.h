// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The one Sequence behind all layouts.
#pragma once

#include <memory>

#include "foothold/io/recording.h"
#include "found_recording.h"

namespace foothold::io {

/// Makes a sequence of what a reader found: settles calibration, unit and convention, and says so in the context's log.
/// @throws FileError, InvalidSettings
std::shared_ptr<Recording> make_recording(FoundRecording found, const Context& context, const SequenceOptions& options);

}  // namespace foothold::io
