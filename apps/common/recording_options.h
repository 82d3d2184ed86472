// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// How recordings are to be read, as every app's options say it.
#pragma once

#include "common/command_line.h"
#include "foothold/io/sequence.h"

namespace foothold::apps {

/// What apps say about the names of recordings.
inline constexpr const char* kRecordingHelp =
    "A recording's folder (7-Scenes, TUM RGB-D, ScanNet, ...: docs/sequences.md) or synthetic:ROOM?setting=value&...; @A:B at the end "
    "selects frames";

/// Adds --intrinsics, --depth-scale and --pose-convention. The options must live as long as the app.
void add_recording_options(CommandLine& app, SequenceOptions& options);

}  // namespace foothold::apps
