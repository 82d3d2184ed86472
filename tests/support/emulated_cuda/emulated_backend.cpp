// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// modules/base/src/cuda_backend.h for the emulated devices, in place of cuda_backend.cu and cuda_devices.cu.
#include "cuda_backend.h"

#include <chrono>
#include <cstring>
#include <vector>

#include "foothold/base/error.h"
#include "support/emulated_cuda/emulated_cuda.h"

namespace foothold::detail {
namespace {

using test::EmulatedCuda;
using Clock = std::chrono::steady_clock;

class EmulatedCudaStream final : public CudaStream {
 public:
  EmulatedCudaStream(int device, const std::optional<void*>& existing)
      : is_own_(!existing), name_(is_own_ ? cuda_.new_stream_name() : *existing), stream_(cuda_.stream(device, name_)) {}
  ~EmulatedCudaStream() override {
    cuda_.wait(*stream_);
    if (scratch_ != nullptr) cuda_.free(scratch_);
    if (is_own_) cuda_.forget_stream(stream_->device, name_);
  }
  EmulatedCudaStream(const EmulatedCudaStream&) = delete;
  EmulatedCudaStream& operator=(const EmulatedCudaStream&) = delete;

  void* stream() const override { return name_; }
  void* scratch(std::size_t num_bytes) override {
    if (num_bytes <= scratch_bytes_) return scratch_;
    if (scratch_ != nullptr) cuda_.free(scratch_);
    scratch_ = cuda_.allocate(stream_->device, num_bytes);
    scratch_bytes_ = num_bytes;
    return scratch_;
  }
  void synchronise() const override {
    ++cuda_.counts().num_waits;
    cuda_.wait(*stream_);
  }
  void wait_for(CudaStream& other) override { cuda_.wait_for(*stream_, static_cast<EmulatedCudaStream&>(other).stream_); }
  void read(Span<const MemoryRead> reads) override {
    cuda_.counts().num_reads += static_cast<int>(reads.size());
    synchronise();
    cuda_.run_now(stream_->device, [&] {
      for (const MemoryRead& read : reads) std::memcpy(read.host, read.device, read.num_bytes);
    });
  }
  void write(void* device, const void* host, std::size_t num_bytes) override {
    ++cuda_.counts().num_writes;
    const auto* const bytes = static_cast<const unsigned char*>(host);
    cuda_.enqueue(*stream_, [device, staged = std::vector<unsigned char>(bytes, bytes + num_bytes)] {
      std::memcpy(device, staged.data(), staged.size());
    });
  }
  void begin_stage(const char* name) override {
    open_.push_back(stages_.size());
    stages_.push_back({name, mark(), nullptr});
  }
  void end_stage(Trace& trace) override {
    stages_[open_.back()].end = mark();
    open_.pop_back();
    if (!open_.empty()) return;
    synchronise();
    for (const Stage& stage : stages_) trace.add(stage.name, std::chrono::duration<double, std::milli>(*stage.end - *stage.begin).count());
    stages_.clear();
  }

 private:
  using Mark = std::shared_ptr<Clock::time_point>;
  struct Stage {
    const char* name;
    Mark begin;
    Mark end;
  };

  Mark mark() {
    auto now = std::make_shared<Clock::time_point>();
    cuda_.enqueue(*stream_, [now] { *now = Clock::now(); });
    return now;
  }

  EmulatedCuda& cuda_ = EmulatedCuda::instance();
  bool is_own_;
  void* name_;
  std::shared_ptr<test::EmulatedStream> stream_;
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
  std::vector<Stage> stages_;
  std::vector<std::size_t> open_;
};

void wait_for_device(const Memory& memory) {
  if (memory.kind == MemoryKind::kCuda) EmulatedCuda::instance().wait_device(memory.cuda_device);
}

}  // namespace

std::unique_ptr<CudaStream> make_cuda_stream(int device, const std::optional<void*>& existing) {
  return std::make_unique<EmulatedCudaStream>(device, existing);
}

void expect_usable_cuda_device(int device) {
  if (device >= 0 && device < EmulatedCuda::kNumDevices) return;
  throw InvalidSettings("setting cuda_device: got " + std::to_string(device) + ", expected 0 or 1");
}

std::string cuda_device_name(int device) { return "emulated device " + std::to_string(device); }

void* cuda_allocate(int device, std::size_t num_bytes) { return EmulatedCuda::instance().allocate(device, num_bytes); }

void cuda_free(int, void* pointer) noexcept { EmulatedCuda::instance().free(pointer); }

void cuda_copy(const Memory& to_memory, void* to, const Memory& from_memory, const void* from, std::size_t num_bytes) {
  EmulatedCuda& cuda = EmulatedCuda::instance();
  if (cuda.take_failure()) throw CudaError("cudaMemcpy: a failure that the test asked for");
  ++cuda.counts().num_device_waits;
  wait_for_device(from_memory);
  wait_for_device(to_memory);
  cuda.run_now(from_memory.cuda_device, [&] { cuda.run_now(to_memory.cuda_device, [&] { std::memcpy(to, from, num_bytes); }); });
}

void cuda_clear(int device, void* pointer, std::size_t num_bytes) {
  EmulatedCuda& cuda = EmulatedCuda::instance();
  ++cuda.counts().num_device_waits;
  cuda.wait_device(device);
  cuda.run_now(device, [&] { std::memset(pointer, 0, num_bytes); });
}

}  // namespace foothold::detail
