// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "gpu/device.h"

namespace foothold::test {

bool device_is_emulated() { return true; }

}  // namespace foothold::test
