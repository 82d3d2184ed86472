// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The verbs of cuda_executor.cuh on the emulated device: the same class for code that cannot tell the difference.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>

#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/base/span.h"
#include "support/emulated_cuda/emulated_cuda.h"

namespace foothold {

/// Several lanes, each a thread.
class CudaTeam {
 public:
  static constexpr int kSize = 5;

  /// What the lanes of a team share.
  struct Shared {
    test::LaneBarrier barrier{kSize};
    alignas(64) std::array<std::array<unsigned char, 512>, kSize> values;
  };

  CudaTeam(int lane, Shared& shared) : lane_(lane), shared_(shared) {}

  int lane() const { return lane_; }
  static constexpr int size() { return kSize; }
  void sync() const { shared_.barrier.wait("sync"); }

  template <class T>
  T sum(T value) const {
    T values[1] = {value};
    sum_all(values);
    return values[0];
  }
  template <class T, int kCount>
  void sum_all(T (&values)[kCount]) const {
    combine("sum", values, [](T a, T b) { return a + b; });
  }
  template <class T>
  T lowest(T value) const {
    T values[1] = {value};
    combine("lowest", values, [](T a, T b) { return std::min(a, b); });
    return values[0];
  }
  template <class T>
  T highest(T value) const {
    T values[1] = {value};
    combine("highest", values, [](T a, T b) { return std::max(a, b); });
    return values[0];
  }
  int fetch_add(int& counter, int value) const { return __atomic_fetch_add(&counter, value, __ATOMIC_RELAXED); }

 private:
  template <class T, int kCount, class Operation>
  void combine(const char* name, T (&values)[kCount], const Operation& operation) const {
    static_assert(sizeof(values) <= sizeof(shared_.values[0]));
    std::memcpy(shared_.values[static_cast<std::size_t>(lane_)].data(), values, sizeof(values));
    shared_.barrier.wait(name);
    T other[kCount];
    std::memcpy(values, shared_.values[0].data(), sizeof(values));
    for (std::size_t lane = 1; lane < kSize; ++lane) {
      std::memcpy(other, shared_.values[lane].data(), sizeof(values));
      for (int k = 0; k < kCount; ++k) values[k] = operation(values[k], other[k]);
    }
    shared_.barrier.wait(name);
  }

  int lane_;
  Shared& shared_;
};

class CudaExecutor {
 public:
  using Team = CudaTeam;
  static constexpr Device kDevice = Device::kCuda;
  static constexpr MemoryKind kMemory = MemoryKind::kCuda;
  static constexpr int kVectorWidth = 1;

  explicit CudaExecutor(const Context& context)
      : context_(context), stream_(device_.stream(context.memory().cuda_device, context.stream())) {}

  /// Backwards on three threads: no body may count on any order.
  template <class Body>
  void for_each(std::size_t n, const Body& body) const {
    if (n == 0) return;
    device_.launch(*stream_, [n, body] {
      constexpr std::size_t kThreads = 3;
      if (n < kThreads) {
        for (std::size_t i = n; i-- > 0;) body(i);
        return;
      }
      test::run_lanes(kThreads, [&](int thread) {
        for (std::size_t i = n; i-- > 0;) {
          if (i % kThreads == static_cast<std::size_t>(thread)) body(i);
        }
      });
    });
  }

  template <class Body>
  void for_each_team(std::size_t n, const Body& body) const {
    for_each_team<None>(n, [body](const CudaTeam& team, None&, std::size_t i) { body(team, i); });
  }

  template <class Scratch, class Body>
  void for_each_team(std::size_t n, const Body& body) const {
    if (n == 0) return;
    device_.launch(*stream_, [n, body] {
      CudaTeam::Shared shared;
      const auto scratch = std::make_unique<Aligned<Scratch>>();
      test::run_lanes(CudaTeam::kSize, [&](int lane) {
        const CudaTeam team(lane, shared);
        for (std::size_t i = n; i-- > 0;) {
          if (lane == 0) std::memset(scratch->bytes, 0xA5, sizeof(scratch->bytes));
          shared.barrier.wait("begin");
          body(team, *reinterpret_cast<Scratch*>(scratch->bytes), i);
          shared.barrier.wait("end");
        }
      });
    });
  }

  void exclusive_scan(Span<const std::uint32_t> in, Span<std::uint32_t> out) const {
    detail::cuda_scratch(context_, in.size() / 4 + 1);
    device_.launch(*stream_, [in, out] {
      std::uint32_t total = 0;
      for (std::size_t i = 0; i < in.size(); ++i) {
        out[i] = total;
        total += in[i];
      }
      out[in.size()] = total;
    });
  }

  void sort(Span<std::uint64_t> keys, Array<std::uint64_t>& buffer, int low_bit, int high_bit) const {
    if (keys.empty() || low_bit == high_bit) return;
    buffer.resize(keys.size());
    detail::cuda_scratch(context_, keys.size() / 4 + 1);
    device_.launch(*stream_, [keys, low_bit, high_bit] {
      const int num_bits = high_bit - low_bit;
      const std::uint64_t mask = (num_bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << static_cast<unsigned>(num_bits)) - 1)
                                 << static_cast<unsigned>(low_bit);
      std::stable_sort(keys.begin(), keys.end(), [mask](std::uint64_t a, std::uint64_t b) { return (a & mask) < (b & mask); });
    });
  }

  void synchronise() const { context_.synchronise(); }

 private:
  struct None {};

  template <class Scratch>
  struct Aligned {
    alignas(64) unsigned char bytes[sizeof(Scratch)];
  };

  const Context& context_;
  test::EmulatedCuda& device_ = test::EmulatedCuda::instance();
  std::shared_ptr<test::EmulatedStream> stream_;
};

}  // namespace foothold
