// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"
#include "foothold/relocalisation/forest.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

constexpr std::size_t kHeaderBytes = 40;
constexpr const char* kName = "somewhere/small.forest";

Forest small_forest() {
  RandomForestSettings settings;
  settings.num_trees = 2;
  settings.depth = 3;
  settings.num_features = 10;
  return make_random_forest(settings);
}

std::string bytes_of(const Forest& forest) {
  std::ostringstream stream;
  write_forest(stream, forest);
  return stream.str();
}

Forest read(const std::string& bytes) {
  std::istringstream stream(bytes);
  return read_forest(stream, kName);
}

std::string error_of(const std::string& bytes) {
  return test::error_message<FileError>([&] { read(bytes); });
}

template <class T>
std::string with_value(std::string bytes, std::size_t offset, T value) {
  std::memcpy(&bytes[offset], &value, sizeof(value));
  return bytes;
}

/// Puts the checksum right again, as a forger would.
std::string with_checksum(const std::string& bytes) {
  return with_value(bytes, 32, fnv1a(kFnvBasis, bytes.data() + kHeaderBytes, bytes.size() - kHeaderBytes));
}

/// A folder of its own, removed with everything in it.
struct TemporaryFolder {
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  std::string file(const char* name) const { return (path / name).string(); }
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("foothold_forest_test_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + "_" +
                                                std::to_string(std::filesystem::file_time_type::clock::now().time_since_epoch().count()));
};

TEST_CASE("read_forest: returns what write_forest wrote") {
  const Forest forest = small_forest();
  const std::string bytes = bytes_of(forest);
  const Forest copy = read(bytes);
  REQUIRE(copy.fingerprint() == forest.fingerprint());
  REQUIRE(copy.provenance() == forest.provenance());
  REQUIRE(copy.num_leaves() == forest.num_leaves());
  REQUIRE(copy.depth() == forest.depth());
  REQUIRE(bytes_of(copy) == bytes);
  REQUIRE(bytes.size() == kHeaderBytes + 10 * 12 + 30 * 8 + 2 * 4 + forest.provenance().size());
}

TEST_CASE("read_forest: leaves the stream behind the forest, so that more can follow") {
  std::stringstream stream;
  write_forest(stream, small_forest());
  write_forest(stream, small_forest());
  stream << "x";
  read_forest(stream, kName);
  read_forest(stream, kName);
  REQUIRE(stream.get() == 'x');
}

TEST_CASE("read_forest: every damaged byte is noticed, and the file named") {
  const std::string good = bytes_of(small_forest());
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int mask : {0x01, 0x80}) {
      std::string damaged = good;
      damaged[i] = static_cast<char>(damaged[i] ^ mask);
      const std::string message = error_of(damaged);
      INFO("byte " << i << ": " << message);
      REQUIRE(test::contains(message, kName));
    }
  }
}

TEST_CASE("read_forest: a truncated file is noticed at every length, and named") {
  const std::string good = bytes_of(small_forest());
  for (std::size_t length = 0; length < good.size(); ++length) {
    const std::string message = error_of(good.substr(0, length));
    INFO("length " << length << ": " << message);
    REQUIRE(test::contains(message, kName));
  }
}

TEST_CASE("read_forest: says which header field is wrong, what it found and what it expected") {
  const std::string good = bytes_of(small_forest());
  REQUIRE(test::contains(error_of("PLY" + good), "FHFOREST"));
  const std::string version = error_of(with_value(good, 8, std::uint32_t{2}));
  REQUIRE(test::contains(version, "version is 2, expected 1"));
  for (const std::size_t offset : {12U, 16U, 20U, 24U}) {
    REQUIRE(test::contains(error_of(with_value(good, offset, std::uint32_t{0xffffffffU})), "4294967295"));
    // A count that is possible but a lie ends with the stream, not with the memory.
    REQUIRE(test::contains(error_of(with_value(good, offset, std::uint32_t{1U << 28U})), "truncated"));
  }
  REQUIRE(test::contains(error_of(with_value(good, 28, std::uint32_t{1})), "reserved"));
  REQUIRE(test::contains(error_of(with_value(good, 32, std::uint64_t{7})), "checksum"));
}

TEST_CASE("read_forest: an inconsistent forest with a right checksum is refused as a file") {
  const std::string good = bytes_of(small_forest());
  const std::size_t nodes = kHeaderBytes + 10 * 12;
  const std::size_t roots = nodes + 30 * 8;
  REQUIRE(test::contains(error_of(with_checksum(with_value(good, kHeaderBytes, std::int32_t{9}))), "channel is 9"));
  REQUIRE(test::contains(error_of(with_checksum(with_value(good, nodes, std::int32_t{1000}))), "node 1000"));
  REQUIRE(test::contains(error_of(with_checksum(with_value(good, nodes + 4, std::uint16_t{10}))), "feature 10"));
  const std::string message = error_of(with_checksum(with_value(good, roots, std::int32_t{-3})));
  REQUIRE(test::contains(message, "node -3"));
  REQUIRE(test::contains(message, kName));
}

TEST_CASE("write_forest: a stream that fails is reported") {
  std::ostringstream stream;
  stream.setstate(std::ios::badbit);
  REQUIRE_THROWS_AS(write_forest(stream, small_forest()), FileError);
}

TEST_CASE("save_forest: load_forest reads it back, and no temporary file stays") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.forest");
  save_forest(path, small_forest());
  save_forest(path, small_forest());
  REQUIRE(load_forest(path).fingerprint() == small_forest().fingerprint());
  REQUIRE(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("save_forest: names a file that cannot be written, and leaves what was there") {
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing/a.forest");
  REQUIRE(test::contains(test::error_message<FileError>([&] { save_forest(missing, small_forest()); }), missing));
  REQUIRE_FALSE(std::filesystem::exists(folder.file("missing")));

  // The temporary name is taken by a folder, so that nothing can be written.
  const std::string path = folder.file("a.forest");
  save_forest(path, small_forest());
  std::filesystem::create_directories(path + ".tmp");
  REQUIRE(test::contains(test::error_message<FileError>([&] { save_forest(path, default_forest()); }), path));
  REQUIRE(load_forest(path).fingerprint() == small_forest().fingerprint());

  // The file is a folder, which a file cannot replace.
  const std::string occupied = folder.file("b.forest");
  std::filesystem::create_directories(occupied);
  REQUIRE(test::contains(test::error_message<FileError>([&] { save_forest(occupied, small_forest()); }), occupied));
  REQUIRE_FALSE(std::filesystem::exists(occupied + ".tmp"));
}

TEST_CASE("load_forest: names a file that is missing or something else") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.forest");
  REQUIRE(test::contains(test::error_message<FileError>([&] { load_forest(path); }), path));
  std::ofstream(path) << "These are not the trees that you are looking for. They are words.";
  REQUIRE(test::contains(test::error_message<FileError>([&] { load_forest(path); }), path));
}

}  // namespace
}  // namespace foothold
