// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Streams and memory of CUDA devices.
#include "cuda_backend.h"

#include <cstring>
#include <vector>

#include "foothold/base/error.h"
#include "foothold/base/exec/cuda_call.cuh"

namespace foothold::detail {
namespace {

/// CudaDeviceScope where failing may be reported.
class CheckedDeviceScope {
 public:
  explicit CheckedDeviceScope(int device) : scope_(device) { FOOTHOLD_CUDA_CHECK(scope_.status()); }

 private:
  CudaDeviceScope scope_;
};

/// Page-locked host memory that grows: what the device copies to and from without the driver's own staging.
class PinnedBuffer {
 public:
  PinnedBuffer() = default;
  ~PinnedBuffer() {
    if (data_ != nullptr) cudaFreeHost(data_);
  }
  PinnedBuffer(const PinnedBuffer&) = delete;
  PinnedBuffer& operator=(const PinnedBuffer&) = delete;

  /// @pre No copy from or to the buffer is under way.
  void* reserve(std::size_t num_bytes) {
    if (num_bytes <= size_) return data_;
    if (data_ != nullptr) FOOTHOLD_CUDA_CHECK(cudaFreeHost(data_));
    data_ = nullptr;
    size_ = 0;
    FOOTHOLD_CUDA_CHECK(cudaMallocHost(&data_, num_bytes));
    size_ = num_bytes;
    return data_;
  }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

/// A mark in a stream, made when it is first needed on the device that is then the current one.
class Event {
 public:
  explicit Event(unsigned flags) : flags_(flags) {}
  ~Event() {
    if (event_ != nullptr) cudaEventDestroy(event_);
  }
  Event(Event&& other) noexcept : flags_(other.flags_), event_(other.event_) { other.event_ = nullptr; }
  Event& operator=(Event&&) = delete;

  /// Sets the mark behind what was asked of the stream so far.
  void record(cudaStream_t stream) {
    if (event_ == nullptr) FOOTHOLD_CUDA_CHECK(cudaEventCreateWithFlags(&event_, flags_));
    FOOTHOLD_CUDA_CHECK(cudaEventRecord(event_, stream));
  }
  /// Waits until the stream has passed the mark; at once if there is none yet.
  void synchronise() const {
    if (event_ != nullptr) FOOTHOLD_CUDA_CHECK(cudaEventSynchronize(event_));
  }
  cudaEvent_t get() const { return event_; }

 private:
  unsigned flags_;
  cudaEvent_t event_ = nullptr;
};

/// Stages that were begun, each between two marks.
class StageClock {
 public:
  void begin(const char* name, cudaStream_t stream) {
    if (num_stages_ == stages_.size()) stages_.emplace_back();
    Stage& stage = stages_[num_stages_];
    stage.name = name;
    stage.begin.record(stream);
    open_.push_back(num_stages_++);
  }
  void end(cudaStream_t stream, Trace& trace) {
    Stage& last = stages_[open_.back()];
    open_.pop_back();
    last.end.record(stream);
    if (!open_.empty()) return;
    const std::size_t num_stages = num_stages_;
    num_stages_ = 0;
    last.end.synchronise();
    for (std::size_t i = 0; i < num_stages; ++i) {
      float duration_ms = 0.0F;
      FOOTHOLD_CUDA_CHECK(cudaEventElapsedTime(&duration_ms, stages_[i].begin.get(), stages_[i].end.get()));
      trace.add(stages_[i].name, static_cast<double>(duration_ms));
    }
  }

 private:
  struct Stage {
    const char* name = nullptr;
    Event begin{cudaEventDefault};
    Event end{cudaEventDefault};
  };
  std::vector<Stage> stages_;  ///< kept for their events
  std::size_t num_stages_ = 0;
  std::vector<std::size_t> open_;
};

class CudaStreamImpl final : public CudaStream {
 public:
  CudaStreamImpl(int device, const std::optional<void*>& existing) : device_(device), is_own_(!existing.has_value()) {
    const CheckedDeviceScope scope(device_);
    if (is_own_) {
      FOOTHOLD_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
      return;
    }
    stream_ = static_cast<cudaStream_t>(*existing);
    int its_device = 0;
    FOOTHOLD_CUDA_CHECK(cudaStreamGetDevice(stream_, &its_device));
    if (its_device != device_) {
      throw InvalidSettings("setting cuda_stream: got a stream of CUDA device " + std::to_string(its_device) + ", expected one of device " +
                            std::to_string(device_) + ", which setting cuda_device names");
    }
  }
  ~CudaStreamImpl() override {
    const CudaDeviceScope scope(device_);
    cudaStreamSynchronize(stream_);
    cudaFree(scratch_);
    if (is_own_) cudaStreamDestroy(stream_);
  }
  CudaStreamImpl(const CudaStreamImpl&) = delete;
  CudaStreamImpl& operator=(const CudaStreamImpl&) = delete;

  void* stream() const override { return stream_; }
  void* scratch(std::size_t num_bytes) override;
  void synchronise() const override {
    const CheckedDeviceScope scope(device_);
    FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(stream_));
  }
  void wait_for(CudaStream& other_stream) override {
    auto& other = static_cast<CudaStreamImpl&>(other_stream);
    {
      const CheckedDeviceScope scope(other.device_);
      other.reached_.record(other.stream_);
    }
    const CheckedDeviceScope scope(device_);
    FOOTHOLD_CUDA_CHECK(cudaStreamWaitEvent(stream_, other.reached_.get()));
  }
  void read(Span<const MemoryRead> reads) override;
  void write(void* device, const void* host, std::size_t num_bytes) override;
  void begin_stage(const char* name) override {
    const CheckedDeviceScope scope(device_);
    stages_.begin(name, stream_);
  }
  void end_stage(Trace& trace) override {
    const CheckedDeviceScope scope(device_);
    stages_.end(stream_, trace);
  }

 private:
  /// A copy to the device on its way.
  struct Writing {
    PinnedBuffer buffer;
    Event left{cudaEventDisableTiming};  ///< the copy has left the buffer
  };
  static constexpr int kNumWritings = 4;  ///< depth and colour of two frames

  int device_;
  bool is_own_;
  cudaStream_t stream_ = nullptr;
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
  PinnedBuffer read_buffer_;
  Writing writings_[kNumWritings];
  int next_writing_ = 0;
  Event reached_{cudaEventDisableTiming};  ///< what another stream waits for
  StageClock stages_;
};

void* CudaStreamImpl::scratch(std::size_t num_bytes) {
  if (num_bytes <= scratch_bytes_) return scratch_;
  const CheckedDeviceScope scope(device_);
  FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(stream_));
  FOOTHOLD_CUDA_CHECK(cudaFree(scratch_));
  scratch_ = nullptr;
  scratch_bytes_ = 0;
  FOOTHOLD_CUDA_CHECK(cudaMalloc(&scratch_, num_bytes));
  scratch_bytes_ = num_bytes;
  return scratch_;
}

void CudaStreamImpl::read(Span<const MemoryRead> reads) {
  const CheckedDeviceScope scope(device_);
  std::size_t num_bytes = 0;
  for (const MemoryRead& read : reads) num_bytes += read.num_bytes;
  auto* const pinned = static_cast<unsigned char*>(read_buffer_.reserve(num_bytes));
  std::size_t offset = 0;
  for (const MemoryRead& read : reads) {
    FOOTHOLD_CUDA_CHECK(cudaMemcpyAsync(pinned + offset, read.device, read.num_bytes, cudaMemcpyDeviceToHost, stream_));
    offset += read.num_bytes;
  }
  FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(stream_));
  offset = 0;
  for (const MemoryRead& read : reads) {
    std::memcpy(read.host, pinned + offset, read.num_bytes);
    offset += read.num_bytes;
  }
}

void CudaStreamImpl::write(void* device, const void* host, std::size_t num_bytes) {
  const CheckedDeviceScope scope(device_);
  Writing& writing = writings_[next_writing_];
  next_writing_ = (next_writing_ + 1) % kNumWritings;
  writing.left.synchronise();
  void* const pinned = writing.buffer.reserve(num_bytes);
  std::memcpy(pinned, host, num_bytes);
  FOOTHOLD_CUDA_CHECK(cudaMemcpyAsync(device, pinned, num_bytes, cudaMemcpyHostToDevice, stream_));
  writing.left.record(stream_);
}

void synchronise_device(int device) {
  const CheckedDeviceScope scope(device);
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
}

}  // namespace

std::unique_ptr<CudaStream> make_cuda_stream(int device, const std::optional<void*>& existing) {
  return std::make_unique<CudaStreamImpl>(device, existing);
}

void* cuda_allocate(int device, std::size_t num_bytes) {
  const CheckedDeviceScope scope(device);
  void* pointer = nullptr;
  FOOTHOLD_CUDA_CHECK(cudaMalloc(&pointer, num_bytes));
  return pointer;
}

// cudaFree() waits until no kernel can use the memory any more.
void cuda_free(int device, void* pointer) noexcept {
  const CudaDeviceScope scope(device);
  cudaFree(pointer);
}

// These two know no stream. They wait for all of them, and use the calling thread's own stream, which waits for none.
void cuda_copy(const Memory& to_memory, void* to, const Memory& from_memory, const void* from, std::size_t num_bytes) {
  if (from_memory.kind == MemoryKind::kCuda) synchronise_device(from_memory.cuda_device);
  if (to_memory.kind == MemoryKind::kCuda && to_memory != from_memory) synchronise_device(to_memory.cuda_device);
  const CheckedDeviceScope scope((to_memory.kind == MemoryKind::kCuda ? to_memory : from_memory).cuda_device);
  FOOTHOLD_CUDA_CHECK(cudaMemcpyAsync(to, from, num_bytes, cudaMemcpyDefault, cudaStreamPerThread));
  FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(cudaStreamPerThread));
}

void cuda_clear(int device, void* pointer, std::size_t num_bytes) {
  const CheckedDeviceScope scope(device);
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
  FOOTHOLD_CUDA_CHECK(cudaMemsetAsync(pointer, 0, num_bytes, cudaStreamPerThread));
  FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(cudaStreamPerThread));
}

}  // namespace foothold::detail
