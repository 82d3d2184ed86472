// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// modules/base/src/cuda_backend.h for the emulated device, in place of cuda_backend.cu.
#include <cstring>
#include <vector>

#include "cuda_backend.h"
#include "foothold/base/error.h"
#include "support/emulated_cuda/emulated_cuda.h"

namespace foothold::detail {
namespace {

using test::EmulatedCuda;

class EmulatedStream final : public CudaStream {
 public:
  ~EmulatedStream() override {
    device_.wait();
    if (scratch_ != nullptr) device_.free(scratch_);
  }
  EmulatedStream() = default;
  EmulatedStream(const EmulatedStream&) = delete;
  EmulatedStream& operator=(const EmulatedStream&) = delete;

  void* stream() const override { return &device_; }
  void* scratch(std::size_t num_bytes) override {
    if (num_bytes <= scratch_bytes_) return scratch_;
    if (scratch_ != nullptr) device_.free(scratch_);
    scratch_ = device_.allocate(num_bytes);
    scratch_bytes_ = num_bytes;
    return scratch_;
  }
  void synchronise() const override {
    ++device_.counts().num_waits;
    device_.wait();
  }
  void read(Span<const MemoryRead> reads) override {
    device_.counts().num_reads += static_cast<int>(reads.size());
    ++device_.counts().num_waits;
    device_.run_now([&] {
      for (const MemoryRead& read : reads) std::memcpy(read.host, read.device, read.num_bytes);
    });
  }
  void write(void* device, const void* host, std::size_t num_bytes) override {
    ++device_.counts().num_writes;
    const auto* const bytes = static_cast<const unsigned char*>(host);
    device_.enqueue(
        [device, staged = std::vector<unsigned char>(bytes, bytes + num_bytes)] { std::memcpy(device, staged.data(), staged.size()); });
  }

 private:
  EmulatedCuda& device_ = EmulatedCuda::instance();
  void* scratch_ = nullptr;
  std::size_t scratch_bytes_ = 0;
};

}  // namespace

std::unique_ptr<CudaStream> make_cuda_stream(const std::optional<void*>&) { return std::make_unique<EmulatedStream>(); }

bool cuda_backend_available(std::string*) { return true; }

void* cuda_allocate(std::size_t num_bytes) { return EmulatedCuda::instance().allocate(num_bytes); }

void cuda_free(void* pointer) noexcept { EmulatedCuda::instance().free(pointer); }

void cuda_copy(void* to, const void* from, std::size_t num_bytes) {
  if (EmulatedCuda::instance().take_failure()) throw CudaError("cudaMemcpy: a failure that the test asked for");
  ++EmulatedCuda::instance().counts().num_device_waits;
  EmulatedCuda::instance().run_now([=] { std::memcpy(to, from, num_bytes); });
}

void cuda_clear(void* pointer, std::size_t num_bytes) {
  ++EmulatedCuda::instance().counts().num_device_waits;
  EmulatedCuda::instance().run_now([=] { std::memset(pointer, 0, num_bytes); });
}

}  // namespace foothold::detail
