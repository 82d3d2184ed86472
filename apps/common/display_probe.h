// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whether there is a display to show windows on.
#pragma once

#include <string>

namespace foothold::apps {

/// Why no window can be opened here, in one line: no display, one that does not answer, or what the window toolkit says. Empty if one can.
///
/// Toolkits end the process where they cannot reach a display, in ways that differ between X11, Wayland and forwarded displays. So a window
/// is opened in a process of its own first, and given up after ten seconds.
std::string describe_missing_display();

}  // namespace foothold::apps
