// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Cholesky factors of a 6 x 6 matrix, or of its upper left corner, on host and device.
#pragma once

#include <cmath>

#include "foothold/base/platform.h"

namespace foothold {

/// Replaces the lower triangle of a symmetric matrix by L with L L^T equal to it; false unless it is positive definite. Reference:
/// [Golub2013] Sec. 4.2.
FOOTHOLD_HD inline bool cholesky_factor(double (&matrix)[6][6], int size) {
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = matrix[i][j];
      for (int k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      if (i == j) {
        if (!(sum > 0.0)) return false;
        matrix[i][i] = std::sqrt(sum);
      } else {
        matrix[i][j] = sum / matrix[j][j];
      }
    }
  }
  return true;
}

/// Solves L L^T x = b in place.
FOOTHOLD_HD inline void cholesky_solve(const double (&factor)[6][6], int size, double (&b)[6]) {
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= factor[i][k] * b[k];
    b[i] /= factor[i][i];
  }
  for (int i = size - 1; i >= 0; --i) {
    for (int k = i + 1; k < size; ++k) b[i] -= factor[k][i] * b[k];
    b[i] /= factor[i][i];
  }
}

}  // namespace foothold
