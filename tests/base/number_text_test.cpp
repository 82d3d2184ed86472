// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/number_text.h"

#include <cstdio>
#include <limits>

#include "support/catch.h"
#include "support/comma_locale.h"
#include "support/random_seed.h"

namespace foothold {

TEST_CASE("general_text and fixed_text: as printf in the C locale, whatever the magnitude") {
  Random random = test::test_random();
  std::vector<double> values{0.0,
                             -0.0,
                             1.0,
                             0.1,
                             1e-5,
                             123456789.0,
                             1234567890.0,
                             std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()};
  for (int exponent = -40; exponent < 40; ++exponent) values.push_back(random.uniform(-1.0F, 1.0F) * std::pow(10.0, exponent));
  for (const double value : values) {
    char expected[400];
    std::snprintf(expected, sizeof(expected), "%.9g", value);
    CHECK(general_text(value, 9) == expected);
    std::snprintf(expected, sizeof(expected), "%.6f", value);
    CHECK(fixed_text(value, 6) == expected);
  }
}

TEST_CASE("general_text and fixed_text: heed no locale") {
  const test::CommaLocale commas;
  CHECK(general_text(1234.5, 9) == "1234.5");
  CHECK(fixed_text(1234567.25, 1) == "1234567.2");
}

}  // namespace foothold
