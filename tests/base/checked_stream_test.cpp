// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/checked_stream.h"

#include <sstream>

#include "foothold/base/printable.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::contains;

constexpr BinaryFormat kFormat{"shopping list", "FHSHOPS\n", 3};
constexpr std::size_t kHeadBytes = 12;

/// A value, numbers and a text in a form of their own.
std::string small_list(std::uint64_t chain = kFnvBasis) {
  std::ostringstream stream;
  CheckedWriter writer(stream, kFormat, chain);
  writer.write(3.5F);
  writer.write_array(std::vector<int>{1, 2, 3});
  writer.write_text("milk");
  writer.finish();
  return stream.str();
}

void read_list(const std::string& bytes, std::uint64_t chain = kFnvBasis) {
  std::istringstream stream(bytes);
  CheckedReader reader(stream, kFormat, "a.list", chain);
  const auto price = reader.read<float>("price");
  const auto numbers = reader.read_array<int>("numbers", 0, 10);
  const std::string goods = reader.read_text("goods", 10);
  reader.finish();
  reader.expect_end_of_file();
  REQUIRE(price == 3.5F);
  REQUIRE(numbers == std::vector<int>{1, 2, 3});
  REQUIRE(goods == "milk");
}

std::string reading_error(const std::string& bytes, std::uint64_t chain = kFnvBasis) {
  return test::error_message<FileError>([&] { read_list(bytes, chain); });
}

/// Data of which every byte can be told from its neighbours.
std::string random_bytes(std::size_t size) {
  Random random = test::test_random();
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

/// A stream buffer whose data cannot be read, as that of a file on a broken disk.
class BrokenBuffer : public std::streambuf {
  int_type underflow() override { throw std::ios_base::failure("broken"); }
};

}  // namespace

TEST_CASE("fnv1a: gives the published values, in one piece or in several") {
  REQUIRE(fnv1a(kFnvBasis, "", 0) == 0xcbf29ce484222325ULL);
  REQUIRE(fnv1a(kFnvBasis, "a", 1) == 0xaf63dc4c8601ec8cULL);
  REQUIRE(fnv1a(kFnvBasis, "foobar", 6) == 0x85944171f73967e8ULL);
  REQUIRE(fnv1a(fnv1a(kFnvBasis, "foo", 3), "bar", 3) == 0x85944171f73967e8ULL);
}

TEST_CASE("CheckedReader: reads back what was written, and the form is as documented") {
  const std::string bytes = small_list();
  read_list(bytes);
  constexpr std::size_t kContents = 4 + 8 + 12 + 8 + 4;
  CHECK(bytes.size() == checked_size(kContents));
  CHECK(bytes.substr(0, 8) == "FHSHOPS\n");
  std::uint64_t checksum = fnv1a(kFnvBasis, bytes.data(), kHeadBytes + 4 + kContents);
  CHECK(bytes.compare(kHeadBytes + 4 + kContents, 8, reinterpret_cast<const char*>(&checksum), 8) == 0);
  const std::uint32_t none = 0;
  checksum = fnv1a(checksum, &none, sizeof(none));
  CHECK(bytes.compare(bytes.size() - 8, 8, reinterpret_cast<const char*>(&checksum), 8) == 0);
}

TEST_CASE("CheckedWriter: contents of any size come back, through either door") {
  const std::size_t size = GENERATE(as<std::size_t>{}, 0, 1, 1000, kMaxPieceBytes - 1, kMaxPieceBytes, kMaxPieceBytes + 1, 3000000);
  const std::string contents = random_bytes(size);
  for (const bool written_as_stream : {false, true}) {
    std::stringstream stream;
    CheckedWriter writer(stream, kFormat);
    if (written_as_stream) {
      writer.stream().write(contents.data(), static_cast<std::streamsize>(size));
    } else {
      writer.write_bytes(contents.data(), size);
    }
    writer.finish();
    REQUIRE(stream.str().size() == checked_size(size));
    stream << "more";
    CheckedReader reader(stream, kFormat);
    if (written_as_stream) {
      const auto read = reader.read_items<char>("bytes", size);
      REQUIRE((std::string(read.begin(), read.end()) == contents));
    } else {
      std::ostringstream all;
      all << reader.stream().rdbuf();
      REQUIRE((all.str() == contents));
    }
    reader.finish();
    std::string rest;
    stream >> rest;
    REQUIRE(rest == "more");
  }
}

TEST_CASE("CheckedReader: data cut short anywhere is told apart from damage") {
  const std::string good = small_list();
  for (std::size_t size = 0; size < good.size(); ++size) {
    INFO("cut to " << size << " bytes");
    const std::string message = test::error_message<TruncatedFile>([&] { read_list(good.substr(0, size)); });
    CHECK((contains(message, "a.list: ends early, in its ") && contains(message, "more bytes")));
  }
}

TEST_CASE("CheckedReader: any flipped bit is noticed") {
  const std::string good = small_list();
  for (std::size_t place = 0; place < 8 * good.size(); ++place) {
    INFO("bit " << place);
    std::string bad = good;
    bad[place / 8] = static_cast<char>(bad[place / 8] ^ static_cast<char>(1U << place % 8));
    CHECK(contains(reading_error(bad), "a.list: "));
  }
}

TEST_CASE("CheckedReader: another kind, another version, too long a piece, more behind the end: each is named with what was expected") {
  CHECK(contains(reading_error("FHSHOES\n and more"),
                 "a.list: not a shopping list of Foothold: begins with 'FHSHOES\\x0a', expected 'FHSHOPS\\x0a'"));
  std::string bad = small_list();
  bad[8] = 9;
  CHECK(contains(reading_error(bad), "a.list: a shopping list of version 9, expected version 3"));
  bad = small_list();
  bad[kHeadBytes + 3] = 1;
  CHECK(contains(reading_error(bad), "in its price: got a piece of 16777252 bytes, expected at most 1048576"));
  bad = small_list();
  bad[kHeadBytes + 4] = 'x';
  CHECK(contains(reading_error(bad), "damaged, in its price: checksum "));
  CHECK(contains(reading_error(small_list() + "x"), "a.list: goes on behind its end"));
}

TEST_CASE("CheckedReader: data does not pass behind other data than that before which it was written") {
  read_list(small_list(7), 7);
  CHECK(contains(reading_error(small_list(7), 8), "damaged"));
}

TEST_CASE("CheckedReader: counts out of range, and contents that are left, are refused before memory is taken") {
  std::ostringstream stream;
  CheckedWriter writer(stream, kFormat);
  writer.write(~std::uint64_t{0});
  writer.finish();
  const auto refusal = [&](auto&& read) {
    std::istringstream in(stream.str());
    CheckedReader reader(in, kFormat);
    return test::error_message<FileError>([&] { read(reader); });
  };
  CHECK(refusal([](CheckedReader& r) { r.read_array<int>("eggs", 2, 12); }) ==
        "shopping list: got 18446744073709551615 eggs, expected 2 to 12");
  CHECK(contains(refusal([](CheckedReader& r) { r.read_array<int>("eggs", 0, ~std::uint64_t{0}); }), "ends early, in its eggs"));
  CHECK(contains(refusal([](CheckedReader& r) { r.read_text("eggs", 12); }), "expected 0 to 12"));
  CHECK(contains(refusal([](CheckedReader& r) { r.finish(); }), "goes on where its end was expected"));
  CHECK(contains(refusal([](CheckedReader& r) {
                   r.read<std::uint32_t>("half");
                   r.finish();
                 }),
                 "goes on where its end was expected"));
}

TEST_CASE("CheckedReader: a transform that is not rigid is refused") {
  SE3 transform;
  std::stringstream stream;
  const auto write = [&] {
    CheckedWriter writer(stream, kFormat);
    writer.write_transform(transform);
    writer.finish();
  };
  const auto read = [&] { return CheckedReader(stream, kFormat).read_transform("pose"); };
  transform.translation = {1.0F, 2.0F, 3.0F};
  write();
  CHECK(read().translation == transform.translation);
  transform.rotation *= 2.0F;
  stream.str("");
  write();
  CHECK(contains(test::error_message<FileError>(read), "its pose is not rigid"));
}

TEST_CASE("CheckedReader: throws FileError alone, whatever a stream's exceptions, and reads none that has failed") {
  const std::string good = small_list();
  for (std::size_t size = 0; size < good.size(); ++size) {
    std::istringstream stream(good.substr(0, size));
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    REQUIRE_THROWS_AS(CheckedReader(stream, kFormat).read_items<char>("bytes", good.size()), FileError);
  }
  BrokenBuffer broken;
  std::istream stream(&broken);
  REQUIRE_THROWS_AS(CheckedReader(stream, kFormat), TruncatedFile);
  std::istringstream failed(good);
  failed.setstate(std::ios::failbit);
  REQUIRE_THROWS_AS(CheckedReader(failed, kFormat), TruncatedFile);
  std::istream none(nullptr);
  REQUIRE_THROWS_AS(CheckedReader(none, kFormat), TruncatedFile);
}

TEST_CASE("CheckedReader: damage ends its stream, and check() tells why") {
  std::string bad = small_list();
  bad[kHeadBytes + 4] = 'x';
  std::istringstream stream(bad);
  CheckedReader reader(stream, kFormat, "a.list");
  CHECK(reader.stream().get() == std::istream::traits_type::eof());
  CHECK(contains(test::error_message<FileError>([&] { reader.check(); }), "a.list: damaged"));
}

TEST_CASE("CheckedWriter: a stream that fails is reported, whichever byte is the first that does not fit") {
  /// Takes a number of bytes.
  struct SmallBuffer : std::streambuf {
    explicit SmallBuffer(std::size_t room) : bytes(room, '\0') { setp(bytes.data(), bytes.data() + room); }
    std::string bytes;
  };
  const std::size_t size = small_list().size();
  for (std::size_t room = 0; room <= size; ++room) {
    SmallBuffer buffer(room);
    std::ostream stream(&buffer);
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    const auto write = [&] {
      CheckedWriter writer(stream, kFormat);
      writer.stream().write(small_list().data(), 36);
      writer.finish();
    };
    if (room < size) {
      CHECK(contains(test::error_message<FileError>(write), "shopping list: could not be written"));
    } else {
      CHECK_NOTHROW(write());
    }
  }
}

TEST_CASE("printable: escapes what a terminal would obey, and cuts what is long") {
  CHECK(printable("plain 'text'") == "plain 'text'");
  CHECK(printable("\x1b[2J\xc2\x9b") == "\\x1b[2J\\xc2\\x9b");
  CHECK(printable("123456", 3) == "123...");
  CHECK(printable(std::string(1, '\0')) == "\\x00");
}

}  // namespace foothold
