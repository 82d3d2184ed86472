// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/peak_memory.h"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>
#include <string>

namespace foothold::apps {
namespace {

/// Tells Linux to forget the peak of resident memory: proc(5), /proc/pid/clear_refs.
constexpr const char* kResetPeak = "5";
constexpr double kMbPerKib = 1024e-6;

}  // namespace

void restart_peak_memory() {
  malloc_trim(0);  // what the method before freed is not this one's
  std::ofstream("/proc/self/clear_refs") << kResetPeak;
}

double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kib = 0.0;
    if (word == "VmHWM:" && status >> kib) return kib * kMbPerKib;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * kMbPerKib;
}

}  // namespace foothold::apps
