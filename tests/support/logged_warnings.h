// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Keeps what a context is warned of.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/context.h"

namespace foothold::test {

struct LoggedWarnings {
  std::vector<std::string> warnings;

  /// A context whose warnings come here; must not outlive this.
  Context context(int num_threads = 2) {
    ContextOptions options;
    options.num_threads = num_threads;
    options.log = [this](LogLevel level, const std::string& message) {
      if (level == LogLevel::kWarning) warnings.push_back(message);
    };
    return Context(options);
  }
};

}  // namespace foothold::test
