// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A CUDA device played by the host, for tests on machines without one.
///
/// A test that links it runs the host code of Device::kCuda unchanged, with the kernels' bodies on threads:
///   - device memory can be touched by kernels alone; the host crashes on it as it would on the real one. What is allocated is filled with
///     garbage and has an inaccessible page behind it;
///   - kernels are queued, and run no sooner than the host waits for them, so that a body that refers to the host's stack is found out;
///   - a team has several lanes, each a thread of its own, so that ThreadSanitizer finds a missing sync();
///   - launches, allocations, copies and waits are counted.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace foothold::test {

/// What was asked of the device since the last reset_counts().
struct EmulatedCudaCounts {
  int num_launches = 0;
  int num_allocations = 0;  ///< of device memory
  int num_frees = 0;
  int num_waits = 0;         ///< the host waited for its stream
  int num_device_waits = 0;  ///< the host waited for the whole device, as allocations' contents and copies outside of streams do
  int num_reads = 0;         ///< copies to the host in stream order; those of one call share one of num_waits
  int num_writes = 0;        ///< copies to the device in stream order
};

class EmulatedCuda {
 public:
  /// There is one device, as there is one GPU.
  static EmulatedCuda& instance();

  void* allocate(std::size_t num_bytes);
  /// Waits, as cudaFree() does.
  void free(void* pointer) noexcept;
  /// Queues work that may touch device memory.
  void launch(std::function<void()> kernel);
  /// Queues a copy or the like, which counts as no launch.
  void enqueue(std::function<void()> work) { queue_.push_back(std::move(work)); }
  /// Runs what is queued.
  void wait();
  /// Runs work that touches device memory at once, behind what is queued.
  void run_now(const std::function<void()>& work);

  /// Lets the next copy outside of streams fail.
  void fail_next_copy() { copy_fails_ = true; }
  /// True once after fail_next_copy().
  bool take_failure() { return std::exchange(copy_fails_, false); }

  EmulatedCudaCounts& counts() { return counts_; }
  void reset_counts() { counts_ = {}; }

 private:
  struct Allocation {
    unsigned char* begin;    ///< of the pages
    std::size_t num_bytes;   ///< of the pages
    unsigned char* pointer;  ///< what the caller got: its end is the pages' end
  };

  void unlock();
  void lock();

  std::vector<Allocation> allocations_;
  std::vector<std::function<void()>> queue_;
  EmulatedCudaCounts counts_;
  bool copy_fails_ = false;
};

/// Lets the lanes of one team wait for one another.
class LaneBarrier {
 public:
  explicit LaneBarrier(int num_lanes) : num_lanes_(num_lanes) {}
  /// Waits until every lane has come to the same place; ends the process if they came to different ones, or some never come.
  void wait(const char* place);

 private:
  const int num_lanes_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int num_arrived_ = 0;
  long generation_ = 0;
  const char* place_ = nullptr;
};

/// Calls lane(0), lane(1), ... each on a thread of its own.
void run_lanes(int num_lanes, const std::function<void(int)>& lane);

}  // namespace foothold::test
