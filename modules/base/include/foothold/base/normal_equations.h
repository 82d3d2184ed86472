// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The normal equations of a pose, H x = -g, solved by Cholesky's decomposition on host and device. Reference: [Golub2013] Sec. 4.2.
#pragma once

#include <cmath>

#include "foothold/base/platform.h"

namespace foothold {

/// Elements of the upper triangle of a 6 x 6 Hessian. Sums of normal equations hold it row by row, then the gradient's six elements.
inline constexpr int kNumHessian = 21;

/// Replaces the lower triangle of a symmetric matrix by L with L L^T equal to it.
///
/// @param smallest_pivot  below which the matrix counts as singular; what is not greater ends the decomposition.
/// @return                False unless the matrix is positive definite.
FOOTHOLD_HD inline bool cholesky_factor(double (&matrix)[6][6], double smallest_pivot = 0.0) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = matrix[i][j];
      for (int k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      if (i == j) {
        if (!(sum > smallest_pivot)) return false;
        matrix[i][i] = std::sqrt(sum);
      } else {
        matrix[i][j] = sum / matrix[j][j];
      }
    }
  }
  return true;
}

/// Solves L L^T x = b in place.
FOOTHOLD_HD inline void cholesky_solve(const double (&factor)[6][6], double (&b)[6]) {
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= factor[i][k] * b[k];
    b[i] /= factor[i][i];
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) b[i] -= factor[k][i] * b[k];
    b[i] /= factor[i][i];
  }
}

/// Solves (H + damping diag(H)) x = -g.
///
/// @param sums  H's upper triangle and g, as kNumHessian says.
/// @param x     Output; undefined unless the result is true.
/// @return      False unless H is positive definite, with pivots above `smallest_pivot`.
template <class T>
FOOTHOLD_HD bool solve_damped(const T* sums, double damping, double smallest_pivot, double (&x)[6]) {
  double matrix[6][6];
  for (int a = 0, next = 0; a < 6; ++a) {
    for (int b = a; b < 6; ++b) matrix[b][a] = static_cast<double>(sums[next++]);
    matrix[a][a] *= 1.0 + damping;
    x[a] = -static_cast<double>(sums[kNumHessian + a]);
  }
  if (!cholesky_factor(matrix, smallest_pivot)) return false;
  cholesky_solve(matrix, x);
  return true;
}

}  // namespace foothold
