// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/fake_cuda_runtime/fake_cuda_runtime.h"

namespace foothold::test {

std::vector<int> compiled_architectures() {
  constexpr int kPerArchitecture = 10;
  std::vector<int> architectures{__CUDA_ARCH_LIST__};
  for (int& architecture : architectures) architecture /= kPerArchitecture;
  return architectures;
}

}  // namespace foothold::test
