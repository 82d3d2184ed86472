// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The host's executor: the verbs that algorithms are written in, on oneTBB.
///
/// An algorithm is a template over an executor, its steps are functors marked FOOTHOLD_HD, and this file and cuda_executor.cuh offer the
/// same verbs:
///
///   for_each(n, body)                body(i) for i in [0, n), in any order
///   for_each_team(n, body)           body(team, i): one team of lanes per item
///   for_each_team<Scratch>(n, body)  body(team, scratch, i): the same, with Scratch shared by the team's lanes
///   exclusive_scan(in, out)          out[i] = in[0] + ... + in[i-1]; out has one element more, the total
///   sort(keys, buffer, low, high)    stable sort of 64-bit keys by their bits [low, high)
///
/// Included by the .cpp file of an algorithm only, never by a public header.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/base/exec/sanitized_loop.h"
#include "foothold/base/span.h"

namespace foothold {

/// The single lane that works on one item on the host. Its CUDA sibling has the lanes of a thread block.
struct CpuTeam {
  static constexpr int lane() { return 0; }
  static constexpr int size() { return 1; }
  static constexpr void sync() {}
  /// The sum of every lane's value, returned to all lanes.
  template <class T>
  static constexpr T sum(T value) {
    return value;
  }
  /// Adds the lanes' arrays element by element; every lane sees the sums afterwards.
  template <class T, int kCount>
  static constexpr void sum_all(T (&)[kCount]) {}
  /// The lowest and the highest of the lanes' values, returned to all lanes.
  template <class T>
  static constexpr T lowest(T value) {
    return value;
  }
  template <class T>
  static constexpr T highest(T value) {
    return value;
  }
  /// Adds to a counter shared by the lanes and returns its former value. The order of lanes is unspecified.
  static int fetch_add(int& counter, int value) {
    const int before = counter;
    counter += value;
    return before;
  }
};

class CpuExecutor {
 public:
  using Team = CpuTeam;
  static constexpr Device kDevice = Device::kCpu;
  static constexpr MemoryKind kMemory = MemoryKind::kHost;
  /// Independent items that a body should process side by side in its innermost loop, so that the compiler vectorises it.
  static constexpr int kVectorWidth = 16;

  explicit CpuExecutor(const Context& context)
      : arena_(*static_cast<oneapi::tbb::task_arena*>(context.arena())), num_threads_(context.num_threads()) {}

  template <class Body>
  void for_each(std::size_t n, const Body& body) const {
    run(n, kElementGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  }

  template <class Body>
  void for_each_team(std::size_t n, const Body& body) const {
    run(n, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(CpuTeam{}, i);
    });
  }

  template <class Scratch, class Body>
  void for_each_team(std::size_t n, const Body& body) const {
    run(n, 1, [&](std::size_t begin, std::size_t end) {
      Scratch scratch;
      for (std::size_t i = begin; i < end; ++i) body(CpuTeam{}, scratch, i);
    });
  }

  void exclusive_scan(Span<const std::uint32_t> in, Span<std::uint32_t> out) const {
    std::uint32_t total = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const std::uint32_t value = in[i];
      out[i] = total;
      total += value;
    }
    out[in.size()] = total;
  }

  /// Least-significant-digit radix sort, 11 bits a pass. `buffer` grows to the number of keys.
  void sort(Span<std::uint64_t> keys, Array<std::uint64_t>& buffer, int low_bit, int high_bit) const {
    buffer.resize(keys.size());
    std::uint64_t* from = keys.data();
    std::uint64_t* to = buffer.data();
    for (int shift = low_bit; shift < high_bit; shift += kRadixBits) {
      radix_pass(from, to, keys.size(), shift, std::min(kRadixBits, high_bit - shift));
      std::swap(from, to);
    }
    if (from != keys.data()) std::memcpy(keys.data(), from, keys.size() * sizeof(std::uint64_t));
  }

  void synchronise() const {}

 private:
  static constexpr std::size_t kElementGrain = 256;
  static constexpr int kRadixBits = 11;

  template <class Loop>
  void run(std::size_t n, std::size_t grain, const Loop& loop) const {
    if (num_threads_ == 1 || n <= grain) {
      if (n != 0) loop(std::size_t{0}, n);
      return;
    }
#ifdef FOOTHOLD_THREAD_SANITIZER
    detail::run_on_threads(num_threads_, n, grain, loop);
#else
    const auto run_loop = [&] {
      oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n, grain),
                                [&](const auto& range) { loop(range.begin(), range.end()); });
    };
    // Isolated: a thread that waits for the others does not take up a BackgroundQueue's call meanwhile, which is much longer.
    arena_.execute([&] { oneapi::tbb::this_task_arena::isolate(run_loop); });
#endif
  }

  static void radix_pass(const std::uint64_t* from, std::uint64_t* to, std::size_t n, int shift, int bits) {
    const std::uint64_t mask = (std::uint64_t{1} << static_cast<unsigned>(bits)) - 1;
    std::size_t offsets[1U << kRadixBits] = {};
    for (std::size_t i = 0; i < n; ++i) ++offsets[(from[i] >> static_cast<unsigned>(shift)) & mask];
    std::size_t sum = 0;
    for (std::size_t& offset : offsets) {
      const std::size_t count = offset;
      offset = sum;
      sum += count;
    }
    for (std::size_t i = 0; i < n; ++i) to[offsets[(from[i] >> static_cast<unsigned>(shift)) & mask]++] = from[i];
  }

  oneapi::tbb::task_arena& arena_;
  int num_threads_;
};

}  // namespace foothold
