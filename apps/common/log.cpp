// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/log.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <mutex>

namespace foothold::apps {
namespace {

/// Colours of terminals, by their escape sequences.
constexpr const char* kGreen = "\033[32m";
constexpr const char* kBoldYellow = "\033[1;33m";
constexpr const char* kBoldRed = "\033[1;31m";
constexpr const char* kNoColour = "\033[m";

std::mutex warnings_mutex;
std::vector<std::string> given_warnings;  // guarded by warnings_mutex

void write_line(const char* colour, const char* level, const std::string& message) {
  static const bool is_terminal = isatty(STDERR_FILENO) != 0;
  std::fprintf(stderr, "%s%s%s: %s\n", is_terminal ? colour : "", level, is_terminal ? kNoColour : "", message.c_str());
}

}  // namespace

void log_info(const std::string& message) { write_line(kGreen, "info", message); }
void log_warning(const std::string& message) {
  {
    const std::lock_guard<std::mutex> lock(warnings_mutex);
    if (std::find(given_warnings.begin(), given_warnings.end(), message) != given_warnings.end()) return;
    given_warnings.push_back(message);
  }
  write_line(kBoldYellow, "warning", message);
}
void log_error(const std::string& message) { write_line(kBoldRed, "error", message); }

std::vector<std::string> warnings() {
  const std::lock_guard<std::mutex> lock(warnings_mutex);
  return given_warnings;
}

LogSink log_to_stderr() {
  return [](LogLevel level, const std::string& message) { level == LogLevel::kWarning ? log_warning(message) : log_info(message); };
}

}  // namespace foothold::apps
