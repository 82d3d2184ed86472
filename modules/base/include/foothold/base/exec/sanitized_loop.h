// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A parallel loop that ThreadSanitizer understands.
///
/// Systems install oneTBB without ThreadSanitizer's instrumentation, so that the tool sees none of its synchronisation and reports races in
/// correct programs. Under that tool loops therefore run on plain threads, and what it finds are the races of the loops' bodies.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

#if defined(__SANITIZE_THREAD__)
#define FOOTHOLD_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FOOTHOLD_THREAD_SANITIZER 1
#endif
#endif

namespace foothold::detail {

/// Calls loop(begin, end) for pieces of [0, n) of at most `grain` items on `num_threads` threads, the calling one included, and waits.
/// The first exception that a piece throws reaches the caller.
template <class Loop>
void run_on_threads(int num_threads, std::size_t n, std::size_t grain, const Loop& loop) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t begin = next.fetch_add(grain); begin < n && !failed; begin = next.fetch_add(grain))
        loop(begin, std::min(n, begin + grain));
    } catch (...) {
      if (!failed.exchange(true)) failure = std::current_exception();
    }
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < num_threads; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace foothold::detail
