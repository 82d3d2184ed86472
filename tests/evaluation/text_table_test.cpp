// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/text_table.h"

#include <limits>

#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

TEST_CASE("format_table: pads to Markdown, text to the left and numbers to the right") {
  REQUIRE(format_table({"method", "ms"}, {{"a", "1.5"}, {"longer name", "12.25"}}) ==
          "| method      |    ms |\n"
          "|-------------|------:|\n"
          "| a           |   1.5 |\n"
          "| longer name | 12.25 |\n");
}

TEST_CASE("format_table: without rows is a header, and a short row breaks the contract") {
  REQUIRE(format_table({"a", "b"}, {}) == "| a   |   b |\n|-----|----:|\n");
  REQUIRE_THROWS_AS(format_table({"a", "b"}, {{"1"}}), ContractViolation);
}

TEST_CASE("format_number: fixed decimals, and a dash for what could not be measured") {
  REQUIRE(format_number(1.25, 1) == "1.2");
  REQUIRE(format_number(-3.0, 0) == "-3");
  REQUIRE(format_number(std::numeric_limits<double>::quiet_NaN(), 2) == "-");
  REQUIRE(format_number(std::numeric_limits<double>::infinity(), 2) == "-");
}

}  // namespace
}  // namespace foothold
