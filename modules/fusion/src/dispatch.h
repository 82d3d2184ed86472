// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Chooses the device at run time.
///
/// A component's operations are declared as `template <Device> struct Ops`, defined once as templates over ExecutorOf<Device>, and
/// instantiated twice: for the host in NAME_cpu.cpp and for CUDA in fusion.cu.
#pragma once

#include "foothold/base/context.h"

namespace foothold {

/// The executor of a device; specialised where that executor's header is included.
template <Device kDevice>
struct ExecutorOf;

/// Calls `call` with the operations for the context's device.
template <template <Device> class Ops, class Call>
auto dispatch([[maybe_unused]] const Context& context, const Call& call) {
#if defined(FOOTHOLD_HAS_CUDA)
  if (context.device() == Device::kCuda) return call(Ops<Device::kCuda>{});
#endif
  return call(Ops<Device::kCpu>{});
}

}  // namespace foothold
