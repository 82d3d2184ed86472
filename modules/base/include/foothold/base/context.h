// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Everything an algorithm needs from its surroundings: device, threads, stream, log and trace. There are no globals.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "foothold/base/platform.h"
#include "foothold/base/span.h"
#include "foothold/base/trace.h"

namespace foothold {

class Context;

namespace detail {
struct MemoryRead;
/// Device scratch memory of library calls; see exec/cuda_executor.cuh.
void* cuda_scratch(const Context& context, std::size_t num_bytes);
/// Copies from the memory of the context's device to the host, in the order of its stream, and waits for the copy: how results arrive.
void read_memory(const Context& context, void* host, const void* device, std::size_t num_bytes);
/// The same for several pieces of memory, with one wait.
void read_memory(const Context& context, Span<const MemoryRead> reads);
/// Copies from the host to the memory of the context's device in the order of its stream, without waiting for what was asked of the stream
/// before. The host's memory may be reused at once.
void write_memory(const Context& context, void* device, const void* host, std::size_t num_bytes);
}  // namespace detail

/// How serious a message is.
enum class LogLevel { kInfo, kWarning };

/// Receives the library's messages; the default drops them.
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// Which device, threads, stream, log and trace a Context works with.
struct ContextOptions {
  Device device = Device::kCpu;  ///< where kernels run
  /// Threads used on the host, the calling one included; 0 means as many as the machine has. [0, 1024]
  int num_threads = 0;
  /// The index of the CUDA device to work on, as CUDA counts those that CUDA_VISIBLE_DEVICES leaves; whatever device is the calling
  /// thread's current one, it is so again when a call returns. [0, number of devices - 1]
  int cuda_device = 0;
  /// The CUDA stream (a cudaStream_t) to work on, which belongs to the device and must outlive the context. Hosts that fill device images
  /// on a stream of their own name it here, so that images are read after they are written and before they are overwritten; nullptr is
  /// CUDA's default stream. If none is named, the context has a stream of its own that waits for no other: such a host then synchronises
  /// before and after each call.
  std::optional<void*> cuda_stream;
  LogSink log;  ///< receives messages, one at a time, on whichever thread works; none are told where it is empty
  /// Receives the duration of every stage when given; must outlive the context. On CUDA it is the time between two marks in the stream, and
  /// a stage that lies in no other ends with waiting for the device.
  Trace* trace = nullptr;
};

/// A device with its threads and stream. Cheap to copy; copies share the threads and the stream.
///
/// One context serves one thread of control at a time, and the calls of its BackgroundQueues; two contexts, and so two relocalisers, may
/// coexist, on one CUDA device or on two. Copies of a context work in the order in which they are asked. Two contexts that were made apart
/// do not wait for each other: what both work on, such as a frame that one uploads and the other reads, needs wait_for() between them.
class Context {
 public:
  /// @throws InvalidSettings for a thread count or device index out of range, or a stream of another device; DeviceError if the device or
  /// its driver is missing, or the build has no CUDA or no code for the device.
  explicit Context(const ContextOptions& options = {});

  /// Where kernels run.
  Device device() const;
  /// The device's own name, such as "NVIDIA H100 80GB HBM3", or "CPU".
  std::string device_name() const;
  /// The memory that this context's kernels work on.
  Memory memory() const;
  /// Threads used on the host, the calling one included.
  int num_threads() const;
  /// What receives durations; null for nothing.
  Trace* trace() const;
  /// Tells the log that the options named, if they named one.
  void log(LogLevel level, const std::string& message) const;
  /// The CUDA stream (a cudaStream_t) of this context; nullptr on the CPU.
  void* stream() const;
  /// Waits until the device has finished what was asked of this context.
  void synchronise() const;
  /// What is asked of this context from now on begins after all that was asked of the other so far. The host does not wait, unless one of
  /// the two works on the CPU.
  void wait_for(const Context& other) const;
  /// The oneTBB task arena (a tbb::task_arena) that host work runs in.
  void* arena() const;

 private:
  friend void* detail::cuda_scratch(const Context& context, std::size_t num_bytes);
  friend void detail::read_memory(const Context& context, Span<const detail::MemoryRead> reads);
  friend void detail::write_memory(const Context& context, void* device, const void* host, std::size_t num_bytes);
  friend class ScopedStage;

  struct State;
  std::shared_ptr<State> state_;
};

/// True if this build has CUDA and the device of this index can be used. Never throws; `reason`, if given, receives why not.
bool cuda_available(std::string* reason = nullptr, int cuda_device = 0);

/// Adds the lifetime of this object to the context's trace under a name. Free without a trace.
class ScopedStage {
 public:
  /// @pre `name` outlives the outermost stage. @throws CudaError if the device fails.
  ScopedStage(const Context& context, const char* name);
  ~ScopedStage();
  ScopedStage(const ScopedStage&) = delete;
  ScopedStage& operator=(const ScopedStage&) = delete;

 private:
  const Context& context_;
  const char* name_;
  Stopwatch watch_;
};

}  // namespace foothold
