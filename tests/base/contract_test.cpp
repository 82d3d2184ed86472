// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/contract.h"

#include <string>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

void expect_positive(int value) { FOOTHOLD_EXPECTS(value > 0); }

struct Seen {
  std::string condition;
  std::string file;
  int line = 0;
  int count = 0;
};
Seen seen;

void remember(const char* condition, const char* file, int line) { seen = {condition, file, line, seen.count + 1}; }

TEST_CASE("FOOTHOLD_EXPECTS: throws with condition, file and line by default") {
  REQUIRE_NOTHROW(expect_positive(1));
  const std::string message = test::error_message<ContractViolation>([] { expect_positive(0); });
  REQUIRE(test::contains(message, "value > 0"));
  REQUIRE(test::contains(message, "contract_test.cpp:"));
}

TEST_CASE("FOOTHOLD_EXPECTS_NO_ERROR: throws with the description, evaluated once") {
  int num_evaluated = 0;
  const auto expect = [&](const std::string& error) {
    const auto describe = [&] { return ++num_evaluated, error; };
    FOOTHOLD_EXPECTS_NO_ERROR(describe());
  };
  REQUIRE_NOTHROW(expect(""));
  REQUIRE(num_evaluated == 1);
  const std::string message = test::error_message<ContractViolation>([&] { expect("the image is upside down"); });
  REQUIRE(num_evaluated == 2);
  REQUIRE(test::contains(message, "the image is upside down at "));
  REQUIRE(test::contains(message, "contract_test.cpp:"));
}

TEST_CASE("set_contract_handler: replaces the handler, and nullptr restores the default") {
  const ContractHandler former = set_contract_handler(&remember);
  seen = {};
  expect_positive(1);
  REQUIRE(seen.count == 0);
  expect_positive(-1);
  REQUIRE(seen.count == 1);
  REQUIRE(seen.condition == "value > 0");
  REQUIRE(test::contains(seen.file, "contract_test.cpp"));
  REQUIRE(seen.line > 0);
  REQUIRE(set_contract_handler(nullptr) == &remember);
  REQUIRE_THROWS_AS(expect_positive(0), ContractViolation);
  set_contract_handler(former);
}

}  // namespace
}  // namespace foothold
