// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// CUDA devices played by the host, for tests on machines without one.
///
/// A test that links it runs the host code of Device::kCuda unchanged, with the kernels' bodies on threads:
///   - device memory can be touched by kernels on this device alone; the host, and kernels on the other device, crash on it as they would
///   on
///     real ones. What is allocated is filled with garbage and has an inaccessible page behind it;
///   - kernels are queued in streams, and run no sooner than the host waits for their stream, or a stream waits for it that the host waits
///   for,
///     so that a body that refers to the host's stack is found out, and so is work that relies on another stream without waiting;
///   - a team has several lanes, each a thread of its own, so that ThreadSanitizer finds a missing sync();
///   - launches, allocations, copies and waits are counted.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace foothold::test {

/// What was asked of the devices since the last reset_counts().
struct EmulatedCudaCounts {
  int num_launches = 0;
  int num_allocations = 0;  ///< of device memory
  int num_frees = 0;
  int num_waits = 0;         ///< the host waited for a stream
  int num_device_waits = 0;  ///< the host waited for a whole device, as allocations' contents and copies outside of streams do
  int num_reads = 0;         ///< copies to the host in stream order; those of one call share one of num_waits
  int num_writes = 0;        ///< copies to the device in stream order
};

/// Work that waits to be done in its order.
struct EmulatedStream {
  int device = 0;
  std::deque<std::function<void()>> queue;
  long num_done = 0;
};

class EmulatedCuda {
 public:
  static constexpr int kNumDevices = 2;

  /// All of the machine's devices.
  static EmulatedCuda& instance();

  void* allocate(int device, std::size_t num_bytes);
  /// Waits for the device, as cudaFree() does.
  void free(void* pointer) noexcept;

  /// The stream that is known by a name, made when it is first asked for.
  std::shared_ptr<EmulatedStream> stream(int device, const void* name);
  /// A name that no other stream has.
  void* new_stream_name() { return reinterpret_cast<void*>(++num_named_); }
  void forget_stream(int device, const void* name) { streams_.erase({device, name}); }

  /// Queues work that may touch the memory of the stream's device.
  void launch(EmulatedStream& stream, std::function<void()> kernel);
  /// Queues a copy or the like, which counts as no launch.
  void enqueue(EmulatedStream& stream, std::function<void()> work) { stream.queue.push_back(std::move(work)); }
  /// Queues the wait for all that the other stream was asked for so far.
  void wait_for(EmulatedStream& stream, const std::shared_ptr<EmulatedStream>& other);
  /// Runs what is queued in a stream.
  void wait(EmulatedStream& stream);
  /// Runs what is queued in all streams of a device.
  void wait_device(int device);
  /// Runs work that touches the memory of a device at once.
  void run_now(int device, const std::function<void()>& work);

  /// Lets the next copy outside of streams fail.
  void fail_next_copy() { copy_fails_ = true; }
  /// True once after fail_next_copy().
  bool take_failure() { return std::exchange(copy_fails_, false); }

  EmulatedCudaCounts& counts() { return counts_; }
  void reset_counts() { counts_ = {}; }

 private:
  struct Allocation {
    int device;
    unsigned char* begin;    ///< of the pages
    std::size_t num_bytes;   ///< of the pages
    unsigned char* pointer;  ///< what the caller got: its end is the pages' end
  };

  void run(EmulatedStream& stream, long num_done);
  void protect(int device, int protection);

  std::vector<Allocation> allocations_;
  std::map<std::pair<int, const void*>, std::shared_ptr<EmulatedStream>> streams_;
  std::size_t num_named_ = 0;
  int num_unlocked_[kNumDevices] = {};  ///< by how many that are at work
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
