// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/input_file.h"

#include "foothold/base/printable.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;

TEST_CASE("read_file: gives every byte, and refuses what is larger than asked for") {
  const TempFolder temp;
  const std::string bytes("a\0b\r\n", 5);
  write_text(temp / "a", bytes);
  CHECK(read_file(temp / "a", 5) == bytes);
  CHECK_THAT(error_of([&] { read_file(temp / "a", 4); }), Contains(temp / "a") && Contains("more than 4 bytes"));
  write_text(temp / "empty", "");
  CHECK(read_file(temp / "empty", 0).empty());
}

TEST_CASE("read_file: what is no regular file is refused by what it is") {
  const TempFolder temp;
  CHECK_THAT(error_of([&] { read_file(temp / "absent", 9); }), Contains(temp / "absent") && Contains("no such file"));
  CHECK_THAT(error_of([&] { read_file(temp.path(), 9); }), Contains("got a folder, expected a file"));
  CHECK_THAT(error_of([] { read_file("/dev/zero", 9); }), Contains("/dev/zero: got a pipe or device, expected a file"));
}

TEST_CASE("in_quotes: shows no control characters, and cuts what is long") {
  CHECK(in_quotes("a b") == "'a b'");
  CHECK(in_quotes("a\n\x1bz") == std::string("'a?") + "?z'");
  CHECK(in_quotes(std::string(61, 'x')) == "'" + std::string(60, 'x') + "...'");
}

}  // namespace
}  // namespace foothold
