// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/context.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <thread>

#include "cuda_backend.h"
#include "foothold/base/array.h"
#include "foothold/base/error.h"

namespace foothold {

struct Context::State {
  ContextOptions options;
  std::mutex log_mutex;
  oneapi::tbb::task_arena arena;
  std::unique_ptr<detail::CudaStream> cuda;
};

Context::Context(const ContextOptions& options) {
  constexpr int kMaxThreads = 1024;
  if (options.num_threads < 0 || options.num_threads > kMaxThreads) {
    throw InvalidSettings("setting num_threads: got " + std::to_string(options.num_threads) + ", expected a value in [0, 1024]");
  }
  state_ = std::make_shared<State>();
  state_->options = options;
  if (options.num_threads == 0) state_->options.num_threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  state_->arena.initialize(state_->options.num_threads);
  if (options.device != Device::kCuda) return;
  detail::expect_usable_cuda_device(options.cuda_device);
  state_->cuda = detail::make_cuda_stream(options.cuda_device, options.cuda_stream);
}

Device Context::device() const { return state_->options.device; }
Memory Context::memory() const { return state_->cuda ? Memory(MemoryKind::kCuda, state_->options.cuda_device) : Memory(); }
std::string Context::device_name() const { return state_->cuda ? detail::cuda_device_name(state_->options.cuda_device) : "CPU"; }
int Context::num_threads() const { return state_->options.num_threads; }
Trace* Context::trace() const { return state_->options.trace; }
void* Context::stream() const { return state_->cuda ? state_->cuda->stream() : nullptr; }
void* Context::arena() const { return &state_->arena; }

void Context::log(LogLevel level, const std::string& message) const {
  if (!state_->options.log) return;
  const std::lock_guard<std::mutex> lock(state_->log_mutex);
  state_->options.log(level, message);
}

void Context::synchronise() const {
  if (state_->cuda) state_->cuda->synchronise();
}

void Context::wait_for(const Context& other) const {
  if (other.state_->cuda && state_->cuda) {
    state_->cuda->wait_for(*other.state_->cuda);
  } else {
    other.synchronise();
  }
}

void* detail::cuda_scratch(const Context& context, std::size_t num_bytes) { return context.state_->cuda->scratch(num_bytes); }

void detail::read_memory(const Context& context, void* host, const void* device, std::size_t num_bytes) {
  const MemoryRead read{host, device, num_bytes};
  read_memory(context, Span<const MemoryRead>(&read, 1));
}

void detail::read_memory(const Context& context, Span<const MemoryRead> reads) {
  if (context.state_->cuda) {
    context.state_->cuda->read(reads);
  } else {
    for (const MemoryRead& read : reads) std::memcpy(read.host, read.device, read.num_bytes);
  }
}

void detail::write_memory(const Context& context, void* device, const void* host, std::size_t num_bytes) {
  if (context.state_->cuda) {
    context.state_->cuda->write(device, host, num_bytes);
  } else {
    std::memcpy(device, host, num_bytes);
  }
}

bool cuda_available(std::string* reason, int cuda_device) {
  try {
    detail::expect_usable_cuda_device(cuda_device);
    return true;
  } catch (const std::exception& error) {
    if (reason != nullptr) *reason = error.what();
    return false;
  }
}

ScopedStage::ScopedStage(const Context& context, const char* name) : context_(context), name_(name) {
  if (context.trace() != nullptr && context.state_->cuda) context.state_->cuda->begin_stage(name);
}

ScopedStage::~ScopedStage() {
  Trace* const trace = context_.trace();
  if (trace == nullptr) return;
  try {
    if (context_.state_->cuda) {
      context_.state_->cuda->end_stage(*trace);
    } else {
      trace->add(name_, watch_.elapsed_ms());
    }
  } catch (...) {  // A failing device is reported by the next call that may throw.
  }
}

}  // namespace foothold
