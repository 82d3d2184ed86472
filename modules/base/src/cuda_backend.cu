// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "cuda_backend.h"

#include <cuda_runtime.h>

#include <cstring>

#include "foothold/base/error.h"
#include "foothold/base/exec/cuda_executor.cuh"

namespace foothold::detail {
namespace {

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

class CudaStreamImpl final : public CudaStream {
 public:
  explicit CudaStreamImpl(const std::optional<void*>& existing) : is_own_(!existing.has_value()) {
    if (existing) stream_ = static_cast<cudaStream_t>(*existing);
    if (is_own_) FOOTHOLD_CUDA_CHECK(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
  }
  ~CudaStreamImpl() override {
    cudaStreamSynchronize(stream_);
    cudaFree(scratch_);
    if (is_own_) cudaStreamDestroy(stream_);
  }
  CudaStreamImpl(const CudaStreamImpl&) = delete;
  CudaStreamImpl& operator=(const CudaStreamImpl&) = delete;

  void* stream() const override { return stream_; }
  void* scratch(std::size_t num_bytes) override {
    if (num_bytes > scratch_bytes_) {
      synchronise();
      FOOTHOLD_CUDA_CHECK(cudaFree(scratch_));
      scratch_ = nullptr;
      scratch_bytes_ = 0;
      FOOTHOLD_CUDA_CHECK(cudaMalloc(&scratch_, num_bytes));
      scratch_bytes_ = num_bytes;
    }
    return scratch_;
  }
  void synchronise() const override { FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(stream_)); }
  void read(Span<const MemoryRead> reads) override {
    std::size_t num_bytes = 0;
    for (const MemoryRead& read : reads) num_bytes += read.num_bytes;
    auto* const pinned = static_cast<unsigned char*>(read_buffer_.reserve(num_bytes));
    std::size_t offset = 0;
    for (const MemoryRead& read : reads) {
      FOOTHOLD_CUDA_CHECK(cudaMemcpyAsync(pinned + offset, read.device, read.num_bytes, cudaMemcpyDeviceToHost, stream_));
      offset += read.num_bytes;
    }
    synchronise();
    offset = 0;
    for (const MemoryRead& read : reads) {
      std::memcpy(read.host, pinned + offset, read.num_bytes);
      offset += read.num_bytes;
    }
  }
  void write(void* device, const void* host, std::size_t num_bytes) override {
    Writing& writing = writings_[next_writing_];
    next_writing_ = (next_writing_ + 1) % kNumWritings;
    if (writing.left == nullptr) {
      FOOTHOLD_CUDA_CHECK(cudaEventCreateWithFlags(&writing.left, cudaEventDisableTiming));
    } else {
      FOOTHOLD_CUDA_CHECK(cudaEventSynchronize(writing.left));
    }
    void* const pinned = writing.buffer.reserve(num_bytes);
    std::memcpy(pinned, host, num_bytes);
    FOOTHOLD_CUDA_CHECK(cudaMemcpyAsync(device, pinned, num_bytes, cudaMemcpyHostToDevice, stream_));
    FOOTHOLD_CUDA_CHECK(cudaEventRecord(writing.left, stream_));
  }

 private:
  /// A copy to the device on its way.
  struct Writing {
    PinnedBuffer buffer;
    cudaEvent_t left = nullptr;  ///< the copy has left the buffer
    ~Writing() {
      if (left != nullptr) cudaEventDestroy(left);
    }
  };
  static constexpr int kNumWritings = 4;  ///< depth and colour of two frames

  bool is_own_;
  cudaStream_t stream_ = nullptr;
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
  PinnedBuffer read_buffer_;
  Writing writings_[kNumWritings];
  int next_writing_ = 0;
};

/// Asked for its attributes to learn whether this build holds code for the device's architecture.
__global__ void probe_kernel() {}

/// What a user can do about a status that says that there is no device to work on.
std::string advice(cudaError_t status) {
  switch (status) {
    case cudaErrorInsufficientDriver:  // also what CUDA says where there is no driver at all
      return "; the NVIDIA driver is missing or older than this build's CUDA " + std::to_string(CUDART_VERSION / 1000) + "." +
             std::to_string(CUDART_VERSION % 1000 / 10);
    case cudaErrorNoDevice:
      return "; check nvidia-smi and CUDA_VISIBLE_DEVICES";
    case cudaErrorNoKernelImageForDevice: {
      cudaDeviceProp device{};
      if (cudaGetDeviceProperties(&device, 0) != cudaSuccess) return {};
      return std::string("; this build holds no code for ") + device.name + ", architecture " + std::to_string(device.major) +
             std::to_string(device.minor) + ": configure it with FOOTHOLD_CUDA_ARCHITECTURES=" + std::to_string(device.major) +
             std::to_string(device.minor);
    }
    default:
      return {};
  }
}

}  // namespace

void check_cuda(cudaError_t status, const char* call, const char* file, int line) {
  if (status == cudaSuccess) return;
  throw CudaError(std::string(call) + " failed at " + file + ":" + std::to_string(line) + ": " + cudaGetErrorString(status));
}

bool cuda_backend_available(std::string* reason) {
  int num_devices = 0;
  cudaError_t status = cudaGetDeviceCount(&num_devices);
  if (status == cudaSuccess && num_devices == 0) status = cudaErrorNoDevice;
  if (status == cudaSuccess) {
    cudaFuncAttributes attributes{};
    status = cudaFuncGetAttributes(&attributes, probe_kernel);
  }
  if (status == cudaSuccess) return true;
  cudaGetLastError();  // or the next launch would report it
  if (reason != nullptr) *reason = std::string("no usable CUDA device: ") + cudaGetErrorString(status) + advice(status);
  return false;
}

std::unique_ptr<CudaStream> make_cuda_stream(const std::optional<void*>& existing) {
  std::string reason;
  if (!cuda_backend_available(&reason)) throw DeviceError(reason);
  return std::make_unique<CudaStreamImpl>(existing);
}

void* cuda_allocate(std::size_t num_bytes) {
  void* pointer = nullptr;
  FOOTHOLD_CUDA_CHECK(cudaMalloc(&pointer, num_bytes));
  return pointer;
}

// cudaFree() waits until no kernel can use the memory any more.
void cuda_free(void* pointer) noexcept { cudaFree(pointer); }

// These two know no stream. They wait for all of them, and use the calling thread's own stream, which waits for none.
void cuda_copy(void* to, const void* from, std::size_t num_bytes) {
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
  FOOTHOLD_CUDA_CHECK(cudaMemcpyAsync(to, from, num_bytes, cudaMemcpyDefault, cudaStreamPerThread));
  FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(cudaStreamPerThread));
}

void cuda_clear(void* pointer, std::size_t num_bytes) {
  FOOTHOLD_CUDA_CHECK(cudaDeviceSynchronize());
  FOOTHOLD_CUDA_CHECK(cudaMemsetAsync(pointer, 0, num_bytes, cudaStreamPerThread));
  FOOTHOLD_CUDA_CHECK(cudaStreamSynchronize(cudaStreamPerThread));
}

}  // namespace foothold::detail
