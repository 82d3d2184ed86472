// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Messages of the apps, on stderr, so that stdout holds results only.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/context.h"

namespace foothold::apps {

/// Each writes a line such as "error: message"; a warning that was given before is not repeated. May be called by several threads.
void log_info(const std::string& message);
void log_warning(const std::string& message);
void log_error(const std::string& message);

/// The warnings given so far, in their order, for reports and views.
std::vector<std::string> warnings();

/// Writes the library's messages there too, for ContextOptions::log.
LogSink log_to_stderr();

}  // namespace foothold::apps
