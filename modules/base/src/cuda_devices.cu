// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// CUDA's devices, and what a user can do where they fail.
#include "cuda_backend.h"
#include "foothold/base/error.h"
#include "foothold/base/exec/cuda_call.cuh"

namespace foothold::detail {
namespace {

/// Asked for its attributes to learn whether this build holds code for the device's architecture.
__global__ void probe_kernel() {}

std::string no_code_advice() {
  int device = 0;
  cudaDeviceProp properties{};
  if (cudaGetDevice(&device) != cudaSuccess || cudaGetDeviceProperties(&properties, device) != cudaSuccess) return {};
  const std::string architecture = std::to_string(properties.major) + std::to_string(properties.minor);
  return std::string("this build holds no code for ") + properties.name + ", architecture " + architecture +
         ": configure it with FOOTHOLD_CUDA_ARCHITECTURES=" + architecture;
}

std::string full_memory_advice() {
  std::size_t num_free = 0;
  std::size_t num_total = 0;
  if (cudaMemGetInfo(&num_free, &num_total) != cudaSuccess) return {};
  constexpr std::size_t kMegabyte = 1000000;
  return std::to_string(num_free / kMegabyte) + " of the device's " + std::to_string(num_total / kMegabyte) +
         " MB are free; see with nvidia-smi who holds the rest";
}

/// What a user can do about a status; empty where there is nothing to say.
std::string advice(cudaError_t status) {
  switch (status) {
    case cudaErrorInsufficientDriver:  // also what CUDA says where there is no driver at all
      return "the NVIDIA driver is missing or older than this build's CUDA " + std::to_string(CUDART_VERSION / 1000) + "." +
             std::to_string(CUDART_VERSION % 1000 / 10) + ": install one that nvidia-smi shows with this version or a later one";
    case cudaErrorNoDevice:
      return "check nvidia-smi and CUDA_VISIBLE_DEVICES";
    case cudaErrorNoKernelImageForDevice:
    case cudaErrorInvalidDeviceFunction:
    case cudaErrorInvalidKernelImage:
    case cudaErrorUnsupportedPtxVersion:
    case cudaErrorJitCompilerNotFound:
    case cudaErrorJitCompilationDisabled:
      return no_code_advice();
    case cudaErrorMemoryAllocation:
      return full_memory_advice();
    case cudaErrorDevicesUnavailable:
      return "another process has the device to itself; nvidia-smi shows it, and the device's compute mode";
    case cudaErrorSystemNotReady:
    case cudaErrorSystemDriverMismatch:
    case cudaErrorCompatNotSupportedOnDevice:
      return "the parts of the NVIDIA driver do not fit each other; after an update of the driver, restart the machine";
    case cudaErrorInitializationError:
      return "a process that was forked from one that uses CUDA cannot use it";
    case cudaErrorLaunchTimeout:
      return "a GPU that drives a display ends long kernels; use another one";
    case cudaErrorIllegalAddress:
    case cudaErrorMisalignedAddress:
    case cudaErrorIllegalInstruction:
    case cudaErrorInvalidAddressSpace:
    case cudaErrorInvalidPc:
    case cudaErrorHardwareStackError:
    case cudaErrorAssert:
    case cudaErrorLaunchFailure:
      return "a kernel of this process failed earlier, Foothold's or the program's own: compute-sanitizer names it. CUDA works again in a "
             "new "
             "process only";
    default:
      return {};
  }
}

std::string describe(cudaError_t status) {
  const std::string what = std::string(cudaGetErrorString(status)) + " (" + cudaGetErrorName(status) + ")";
  const std::string help = advice(status);
  cudaGetLastError();  // it is reported, and not for the program's next call to find
  return help.empty() ? what : what + "; " + help;
}

int num_devices() {
  int count = 0;
  const cudaError_t status = cudaGetDeviceCount(&count);
  if (status == cudaSuccess && count > 0) return count;
  throw DeviceError("no usable CUDA device: " + describe(status == cudaSuccess ? cudaErrorNoDevice : status));
}

}  // namespace

void check_cuda(cudaError_t status, const char* call, const char* file, int line) {
  if (status == cudaSuccess) return;
  throw CudaError(std::string(call) + " failed at " + file + ":" + std::to_string(line) + ": " + describe(status));
}

void expect_usable_cuda_device(int device) {
  const int count = num_devices();
  if (device < 0 || device >= count) {
    throw InvalidSettings("setting cuda_device: got " + std::to_string(device) + ", expected a value in [0, " + std::to_string(count - 1) +
                          "], as CUDA counts the devices here");
  }
  const CudaDeviceScope scope(device);
  cudaError_t status = scope.status();
  cudaFuncAttributes attributes{};
  if (status == cudaSuccess) status = cudaFuncGetAttributes(&attributes, probe_kernel);
  if (status != cudaSuccess) throw DeviceError("CUDA device " + std::to_string(device) + " cannot be used: " + describe(status));
}

std::string cuda_device_name(int device) {
  cudaDeviceProp properties{};
  FOOTHOLD_CUDA_CHECK(cudaGetDeviceProperties(&properties, device));
  return properties.name;
}

}  // namespace foothold::detail
