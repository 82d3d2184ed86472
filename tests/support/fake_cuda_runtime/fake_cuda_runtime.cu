// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/fake_cuda_runtime/fake_cuda_runtime.h"

#include <cuda_runtime_api.h>
#include <cxxabi.h>

#include <cstdlib>
#include <cstring>
#include <memory>

using foothold::test::FakeCudaRuntime;

namespace {

struct FakeStream {
  int device;
};

struct FakeEvent {
  int device;
};

FakeCudaRuntime& runtime() { return FakeCudaRuntime::instance(); }

/// Names of kernels by the addresses of their host functions.
std::map<const void*, std::string>& kernel_names() {
  static std::map<const void*, std::string> names;
  return names;
}

std::string demangled(const char* name) {
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> readable(abi::__cxa_demangle(name, nullptr, nullptr, &status), &std::free);
  return status == 0 ? readable.get() : name;
}

cudaError_t failed(cudaError_t status) {
  if (status != cudaSuccess) runtime().last_error = status;
  return status;
}

/// Counts a call, and says whether it is to fail.
cudaError_t called(const char* function) {
  ++runtime().calls[function];
  const auto failure = runtime().failures.find(function);
  return failed(failure == runtime().failures.end() ? cudaSuccess : static_cast<cudaError_t>(failure->second));
}

/// The device of a stream; CUDA's default streams are the current device's.
int device_of(cudaStream_t stream) {
  if (stream == nullptr || stream == cudaStreamLegacy || stream == cudaStreamPerThread) return runtime().current_device;
  return reinterpret_cast<const FakeStream*>(stream)->device;
}

struct CallConfiguration {
  dim3 grid;
  dim3 block;
  std::size_t shared_bytes;
  void* stream;
};
CallConfiguration configuration;

}  // namespace

namespace foothold::test {

FakeCudaRuntime& FakeCudaRuntime::instance() {
  static FakeCudaRuntime state;
  return state;
}

void* fake_cuda_stream(int device) { return new FakeStream{device}; }

}  // namespace foothold::test

#define RETURN_IF_FAILING()                                                 \
  if (const cudaError_t status = called(__func__); status != cudaSuccess) { \
    return status;                                                          \
  }

extern "C" {

// What nvcc's code calls when a program starts, and for each launch.
void** CUDARTAPI __cudaRegisterFatBinary(void*) {
  static void* handle = nullptr;
  return &handle;
}
void CUDARTAPI __cudaRegisterFatBinaryEnd(void**) {}
void CUDARTAPI __cudaUnregisterFatBinary(void**) {}
void CUDARTAPI __cudaRegisterVar(void**, char*, char*, const char*, int, std::size_t, int, int) {}
void CUDARTAPI __cudaRegisterFunction(void**, const char* host_function, char*, const char* name, int, uint3*, uint3*, dim3*, dim3*, int*) {
  kernel_names()[host_function] = demangled(name);
}
unsigned CUDARTAPI __cudaPushCallConfiguration(dim3 grid, dim3 block, std::size_t shared_bytes, CUstream_st* stream) {
  configuration = {grid, block, shared_bytes, stream};
  return 0;
}
cudaError_t CUDARTAPI __cudaPopCallConfiguration(dim3* grid, dim3* block, std::size_t* shared_bytes, void* stream) {
  *grid = configuration.grid;
  *block = configuration.block;
  *shared_bytes = configuration.shared_bytes;
  *static_cast<void**>(stream) = configuration.stream;
  return cudaSuccess;
}
cudaError_t CUDARTAPI __cudaGetKernel(cudaKernel_t* kernel, const void* host_function) {
  *kernel = static_cast<cudaKernel_t>(const_cast<void*>(host_function));
  return cudaSuccess;
}
cudaError_t CUDARTAPI __cudaLaunchKernel(cudaKernel_t kernel, dim3 grid, dim3 block, void**, std::size_t, cudaStream_t stream) {
  RETURN_IF_FAILING()
  if (device_of(stream) != runtime().current_device) return failed(cudaErrorInvalidResourceHandle);
  if (grid.x == 0 || block.x == 0 || block.x * block.y * block.z > 1024) return failed(cudaErrorInvalidConfiguration);
  runtime().launches.push_back(
      {kernel_names()[static_cast<const void*>(kernel)], runtime().current_device, stream, grid.x * grid.y * grid.z, block.x});
  return cudaSuccess;
}

// Errors
cudaError_t CUDARTAPI cudaGetLastError() {
  const int error = runtime().last_error;
  runtime().last_error = cudaSuccess;
  return static_cast<cudaError_t>(error);
}
cudaError_t CUDARTAPI cudaPeekAtLastError() { return static_cast<cudaError_t>(runtime().last_error); }
const char* CUDARTAPI cudaGetErrorName(cudaError_t status) { return status == cudaSuccess ? "cudaSuccess" : "cudaErrorOfTheFake"; }
const char* CUDARTAPI cudaGetErrorString(cudaError_t status) {
  static std::string text;
  text = "status " + std::to_string(status);
  return text.c_str();
}

// Devices
cudaError_t CUDARTAPI cudaGetDeviceCount(int* count) {
  *count = 0;
  RETURN_IF_FAILING()
  *count = runtime().num_devices;
  return *count > 0 ? cudaSuccess : failed(cudaErrorNoDevice);
}
cudaError_t CUDARTAPI cudaGetDevice(int* device) {
  RETURN_IF_FAILING()
  *device = runtime().current_device;
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaSetDevice(int device) {
  RETURN_IF_FAILING()
  if (device < 0 || device >= runtime().num_devices) return failed(cudaErrorInvalidDevice);
  ++runtime().num_set_devices;
  runtime().current_device = device;
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaDeviceSynchronize() {
  RETURN_IF_FAILING()
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaGetDeviceProperties(cudaDeviceProp* properties, int device) {
  RETURN_IF_FAILING()
  *properties = {};
  std::strcpy(properties->name, ("Fake " + std::to_string(device)).c_str());
  properties->major = runtime().architecture / 10;
  properties->minor = runtime().architecture % 10;
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int) {
  RETURN_IF_FAILING()
  switch (attribute) {
    case cudaDevAttrMultiProcessorCount:
      *value = 132;
      break;
    case cudaDevAttrMaxGridDimX:
      *value = 2147483647;
      break;
    case cudaDevAttrComputeCapabilityMajor:
      *value = runtime().architecture / 10;
      break;
    case cudaDevAttrComputeCapabilityMinor:
      *value = runtime().architecture % 10;
      break;
    default:
      *value = 1024;
  }
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaFuncGetAttributes(cudaFuncAttributes* attributes, const void*) {
  RETURN_IF_FAILING()
  *attributes = {};
  for (const int architecture : foothold::test::compiled_architectures()) {
    if (architecture <= runtime().architecture) attributes->ptxVersion = architecture;
  }
  attributes->binaryVersion = runtime().architecture;
  attributes->maxThreadsPerBlock = 1024;
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaOccupancyMaxActiveBlocksPerMultiprocessorWithFlags(int* count, const void*, int, std::size_t, unsigned) {
  RETURN_IF_FAILING()
  *count = 4;
  return cudaSuccess;
}

// Memory. A header before each allocation remembers its device.
cudaError_t CUDARTAPI cudaMalloc(void** pointer, std::size_t num_bytes) {
  RETURN_IF_FAILING()
  runtime().allocation_devices.push_back(runtime().current_device);
  *pointer = std::calloc(num_bytes, 1);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaFree(void* pointer) {
  RETURN_IF_FAILING()
  std::free(pointer);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaMallocHost(void** pointer, std::size_t num_bytes) {
  RETURN_IF_FAILING()
  *pointer = std::calloc(num_bytes, 1);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaFreeHost(void* pointer) {
  RETURN_IF_FAILING()
  std::free(pointer);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaMemGetInfo(std::size_t* num_free, std::size_t* num_total) {
  RETURN_IF_FAILING()
  *num_free = 123000000;
  *num_total = 8000000000;
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaMemcpyAsync(void* to, const void* from, std::size_t num_bytes, cudaMemcpyKind kind, cudaStream_t) {
  RETURN_IF_FAILING()
  std::memmove(to, from, num_bytes);
  if (kind == cudaMemcpyDeviceToHost && runtime().answer) runtime().answer(to, num_bytes);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaMemsetAsync(void* pointer, int value, std::size_t num_bytes, cudaStream_t) {
  RETURN_IF_FAILING()
  std::memset(pointer, value, num_bytes);
  return cudaSuccess;
}

// Streams and events
cudaError_t CUDARTAPI cudaStreamCreateWithFlags(cudaStream_t* stream, unsigned) {
  RETURN_IF_FAILING()
  *stream = reinterpret_cast<cudaStream_t>(new FakeStream{runtime().current_device});
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaStreamDestroy(cudaStream_t stream) {
  RETURN_IF_FAILING()
  delete reinterpret_cast<FakeStream*>(stream);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaStreamSynchronize(cudaStream_t) {
  RETURN_IF_FAILING()
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaStreamGetDevice(cudaStream_t stream, int* device) {
  RETURN_IF_FAILING()
  *device = device_of(stream);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaStreamWaitEvent(cudaStream_t, cudaEvent_t event, unsigned) {
  RETURN_IF_FAILING()
  return event == nullptr ? failed(cudaErrorInvalidResourceHandle) : cudaSuccess;
}
cudaError_t CUDARTAPI cudaEventCreateWithFlags(cudaEvent_t* event, unsigned) {
  RETURN_IF_FAILING()
  *event = reinterpret_cast<cudaEvent_t>(new FakeEvent{runtime().current_device});
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaEventDestroy(cudaEvent_t event) {
  RETURN_IF_FAILING()
  delete reinterpret_cast<FakeEvent*>(event);
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaEventRecord(cudaEvent_t event, cudaStream_t stream) {
  RETURN_IF_FAILING()
  return reinterpret_cast<FakeEvent*>(event)->device == device_of(stream) ? cudaSuccess : failed(cudaErrorInvalidResourceHandle);
}
cudaError_t CUDARTAPI cudaEventSynchronize(cudaEvent_t) {
  RETURN_IF_FAILING()
  return cudaSuccess;
}
cudaError_t CUDARTAPI cudaEventElapsedTime(float* duration_ms, cudaEvent_t, cudaEvent_t) {
  RETURN_IF_FAILING()
  *duration_ms = 1.5F;
  return cudaSuccess;
}

}  // extern "C"
