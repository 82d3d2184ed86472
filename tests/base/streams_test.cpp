// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <sstream>
#include <string>
#include <vector>

#include "foothold/base/binary_stream.h"
#include "foothold/base/checksum.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

TEST_CASE("fnv1a: gives the published values, in one piece or in several") {
  REQUIRE(fnv1a(kFnvBasis, "", 0) == 0xcbf29ce484222325ULL);
  REQUIRE(fnv1a(kFnvBasis, "a", 1) == 0xaf63dc4c8601ec8cULL);
  REQUIRE(fnv1a(kFnvBasis, "foobar", 6) == 0x85944171f73967e8ULL);
  REQUIRE(fnv1a(fnv1a(kFnvBasis, "foo", 3), "bar", 3) == 0x85944171f73967e8ULL);
}

TEST_CASE("read_value and read_array: read back what was written") {
  std::stringstream stream;
  write_value(stream, 3.5F);
  write_array(stream, std::vector<int>{1, 2, 3});
  write_array(stream, std::vector<int>{});
  REQUIRE(read_value<float>(stream, "weight") == 3.5F);
  REQUIRE(read_array<int>(stream, "numbers", 0, 10) == std::vector<int>{1, 2, 3});
  REQUIRE(read_array<int>(stream, "numbers", 0, 10).empty());
}

TEST_CASE("read_value and read_array: name what is missing from a truncated stream") {
  std::stringstream whole;
  write_array(whole, std::vector<int>{1, 2, 3});
  const std::string bytes = whole.str();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::istringstream part(bytes.substr(0, size));
    REQUIRE(test::contains(test::error_message<FileError>([&] { read_array<int>(part, "numbers", 0, 10); }), "numbers"));
  }
}

TEST_CASE("read_array: refuses counts outside the expected range") {
  for (const auto& [low, high] : {std::pair<int, int>{0, 2}, std::pair<int, int>{4, 9}}) {
    std::stringstream stream;
    write_array(stream, std::vector<int>{1, 2, 3});
    const auto minimum = static_cast<std::uint64_t>(low);
    const auto maximum = static_cast<std::uint64_t>(high);
    const std::string message = test::error_message<FileError>([&] { read_array<int>(stream, "numbers", minimum, maximum); });
    REQUIRE(test::contains(message, "3 numbers"));
    REQUIRE(test::contains(message, std::to_string(low) + " to " + std::to_string(high)));
  }
}

}  // namespace
}  // namespace foothold
