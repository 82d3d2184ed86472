// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/normal_equations.h"

#include <Eigen/Cholesky>

#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
constexpr int kDiagonal[6] = {0, 6, 11, 15, 18, 20};

TEST_CASE("solve_damped: solves what Eigen's LDLT solves") {
  Random random = test::test_random();
  for (int repeat = 0; repeat < 500; ++repeat) {
    Matrix6d root;
    for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = random.uniform(-1.0F, 1.0F);
    const Matrix6d h = root * root.transpose() * 100.0 + Matrix6d::Identity();
    float sums[kNumHessian + 6] = {};
    Matrix6d damped = Matrix6d::Zero();
    Vector6d gradient;
    const double damping = repeat % 2 == 0 ? 0.0 : static_cast<double>(random.uniform(0.0F, 2.0F));
    int next = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) {
        sums[next] = static_cast<float>(h(i, j));
        damped(i, j) = damped(j, i) = static_cast<double>(sums[next++]) * (i == j ? 1.0 + damping : 1.0);
      }
      gradient[i] = static_cast<double>(sums[kNumHessian + i] = random.uniform(-10.0F, 10.0F));
    }
    double x[6];
    REQUIRE(solve_damped(sums, damping, 0.0, x));
    const Vector6d expected = damped.ldlt().solve(-gradient);
    for (int i = 0; i < 6; ++i) REQUIRE(x[i] == Approx(expected[i]).epsilon(1e-8).margin(1e-9));
  }
}

TEST_CASE("solve_damped: refuses matrices that are not positive definite, or nearly so") {
  double x[6];
  double sums[kNumHessian + 6] = {};
  REQUIRE_FALSE(solve_damped(sums, 1e-3, 0.0, x));
  for (const int i : kDiagonal) sums[i] = 1.0;
  REQUIRE(solve_damped(sums, 0.0, 0.0, x));
  sums[18] = 1e-10;
  REQUIRE(solve_damped(sums, 0.0, 0.0, x));
  REQUIRE_FALSE(solve_damped(sums, 0.0, 1e-9, x));
  for (const double bad : {-1.0, std::nan("")}) {
    sums[18] = bad;
    REQUIRE_FALSE(solve_damped(sums, 0.0, 0.0, x));
  }
}

}  // namespace
}  // namespace foothold
