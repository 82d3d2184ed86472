// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The most memory that this process held at once.
#pragma once

namespace foothold::apps {

/// Starts a new measurement. Where the system cannot (it needs Linux's /proc), peaks stay those of the whole process so far.
void restart_peak_memory();

/// Peak resident memory since the last restart [1e6 bytes].
double peak_memory_mb();

}  // namespace foothold::apps
