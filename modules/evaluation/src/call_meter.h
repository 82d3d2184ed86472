// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Private to the module: measures calls of a relocaliser.
#pragma once

#include <ctime>

#include "foothold/evaluation/protocol.h"

namespace foothold {

/// Processor time of the calling thread so far [ms].
inline double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// Runs `call` and appends its durations to `times`. The trace, if any, is emptied before and after.
template <class Call>
void measure_call(CallTimes& times, Trace* trace, Call&& call) {
  if (trace != nullptr) trace->clear();
  const double cpu_before_ms = thread_cpu_ms();
  const Stopwatch watch;
  call();
  times.wall_ms.push_back(watch.elapsed_ms());
  times.cpu_ms.push_back(thread_cpu_ms() - cpu_before_ms);
  if (trace == nullptr) return;
  for (const auto& [stage, durations_ms] : trace->stages()) {
    double sum_ms = 0.0;
    for (const double duration_ms : durations_ms) sum_ms += duration_ms;
    times.stages_ms[stage].push_back(sum_ms);
  }
  trace->clear();
}

}  // namespace foothold
