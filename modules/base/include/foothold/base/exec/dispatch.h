// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Chooses between the two instantiations of an algorithm at run time. Included by the .cpp file of an algorithm only.
///
/// x_kernels.h   template <class Executor> struct XAlgorithms { static void run(const Context&, ...); };   // bodies defined out of class
/// x.cpp         extern template struct XAlgorithms<CudaExecutor>;                                         // in builds with CUDA
///               dispatch(context, [&](auto on) { XAlgorithms<typename decltype(on)::Executor>::run(context, ...); });
/// x.cu          template struct XAlgorithms<CudaExecutor>;
#pragma once

#include "foothold/base/context.h"
#include "foothold/base/exec/cpu_executor.h"

namespace foothold {

class CudaExecutor;

/// Names an executor without needing its definition.
template <class T>
struct On {
  using Executor = T;
};

/// Calls `call` with On<CpuExecutor> or, in modules built with CUDA, On<CudaExecutor>.
template <class Call>
auto dispatch([[maybe_unused]] const Context& context, Call&& call) {
#ifdef FOOTHOLD_HAS_CUDA
  if (context.device() == Device::kCuda) return call(On<CudaExecutor>{});
#endif
  return call(On<CpuExecutor>{});
}

}  // namespace foothold
