// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "foothold/base/checked_stream.h"
#include "foothold/base/error.h"
#include "foothold/relocalisation/forest.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/file_size_limit.h"
#include "support/mend_checksums.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

// Where the small forest's arrays are: their counts stand eight bytes before.
constexpr std::size_t kFeatures = 24;
constexpr std::size_t kNodes = kFeatures + 10 * 12 + 8;
constexpr std::size_t kRoots = kNodes + 30 * 8 + 8;
constexpr std::size_t kProvenance = kRoots + 2 * 4 + 8;
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

TEST_CASE("read_forest: returns what write_forest wrote") {
  const Forest forest = small_forest();
  const std::string bytes = bytes_of(forest);
  const Forest copy = read(bytes);
  REQUIRE(copy.fingerprint() == forest.fingerprint());
  REQUIRE(copy.provenance() == forest.provenance());
  REQUIRE(copy.num_leaves() == forest.num_leaves());
  REQUIRE(copy.depth() == forest.depth());
  REQUIRE(bytes_of(copy) == bytes);
  REQUIRE(bytes.size() == checked_size(kProvenance - 16 + forest.provenance().size()));
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

TEST_CASE("read_forest: another kind or version is named") {
  const std::string good = bytes_of(small_forest());
  REQUIRE(test::contains(error_of("PLY" + good), "expected 'FHFOREST'"));
  REQUIRE(test::contains(error_of(with_value(good, 8, std::uint32_t{1})), "a forest of version 1, expected version 2"));
}

TEST_CASE("read_forest: counts beyond the limits are refused before memory is taken, and those that lie when the data ends") {
  const std::string good = bytes_of(small_forest());
  const auto error_with_count = [&](std::size_t array, std::uint64_t count) {
    return error_of(test::with_right_checksums(with_value(good, array - 8, count)));
  };
  CHECK(test::contains(error_with_count(kFeatures, 65537), "65537 features, expected 0 to 65536"));
  CHECK(test::contains(error_with_count(kNodes, 1U << 30U), "1073741824 nodes, expected 1 to 2097152"));
  CHECK(test::contains(error_with_count(kRoots, 20000), "20000 trees, expected 1 to 32"));
  CHECK(test::contains(error_with_count(kProvenance, 1U << 30U), "bytes of provenance, expected 0 to 1048576"));
  for (const std::size_t array : {kFeatures, kNodes, kProvenance}) CHECK(test::contains(error_with_count(array, 65536), "ends early"));
}

TEST_CASE("read_forest: an inconsistent forest with a right checksum is refused as a file") {
  const std::string good = bytes_of(small_forest());
  const auto error_with = [&](std::size_t place, auto value) {
    return error_of(test::with_right_checksums(with_value(good, place, value)));
  };
  CHECK(test::contains(error_with(kFeatures, std::int32_t{9}), "channel is 9"));
  CHECK(test::contains(error_with(kNodes, std::int32_t{1000}), "node 1000"));
  CHECK(test::contains(error_with(kNodes + 4, std::uint16_t{10}), "feature 10"));
  const std::string message = error_with(kRoots, std::int32_t{-3});
  CHECK(test::contains(message, "node -3"));
  CHECK(test::contains(message, kName));
}

TEST_CASE("Forest: too many trees, too deep a tree, nodes of no tree and gaps between leaves are refused") {
  const auto error_of_forest = [](const std::vector<ForestNode>& nodes, const std::vector<std::int32_t>& roots) {
    return test::error_message<InvalidSettings>([&] { Forest({ForestFeature{}}, nodes, roots, ""); });
  };
  std::vector<ForestNode> leaves;
  std::vector<std::int32_t> roots;
  for (int i = 0; i <= kMaxForestTrees; ++i) {
    leaves.push_back({~i, 0, 0});
    roots.push_back(i);
  }
  CHECK(test::contains(error_of_forest(leaves, roots), "has 33 trees, expected at most 32"));
  CHECK(error_of_forest({leaves.begin(), leaves.end() - 1}, {roots.begin(), roots.end() - 1}).empty());
  CHECK(test::contains(error_of_forest(leaves, {0, 1, 2}), "has 33 nodes, of which only 3 belong to a tree"));
  CHECK(test::contains(error_of_forest({{~1, 0, 0}, {~3, 0, 0}, {~0, 0, 0}}, {0, 1, 2}), "is out of range"));
  CHECK(test::contains(error_of_forest({{1, 0, 0}, {~0, 0, 0}, {~2, 0, 0}}, {0}), "none of number 1"));

  for (const int depth : {kMaxForestDepth, kMaxForestDepth + 1}) {
    std::vector<ForestNode> chain{{0, 0, 0}};
    for (int i = 0; i < depth; ++i) {
      const auto left_child = static_cast<std::int32_t>(chain.size());
      chain[chain.size() == 1 ? 0 : chain.size() - 1].left_child = left_child;
      chain.push_back({~i, 0, 0});
      chain.push_back({~depth, 0, 0});
    }
    const std::string message = error_of_forest(chain, {0});
    INFO(message);
    CHECK(test::contains(message, "deeper than 32 splits") == (depth > kMaxForestDepth));
    CHECK(message.empty() == (depth <= kMaxForestDepth));
  }
  RandomForestSettings large;
  large.num_trees = 32;
  large.depth = 20;
  CHECK(test::contains(test::error_message<InvalidSettings>([&] { make_random_forest(large); }),
                       "33554432 leaves, expected at most 1048576"));
}

TEST_CASE("write_forest: a stream that fails is reported") {
  std::ostringstream stream;
  stream.setstate(std::ios::badbit);
  REQUIRE_THROWS_AS(write_forest(stream, small_forest()), FileError);
}

TEST_CASE("save_forest: load_forest reads it back, and no temporary file stays") {
  const test::TempFolder folder;
  const std::string path = folder / "a.forest";
  save_forest(path, small_forest());
  save_forest(path, small_forest());
  REQUIRE(load_forest(path).fingerprint() == small_forest().fingerprint());
  REQUIRE(folder.num_files() == 1);
}

TEST_CASE("save_forest: names a file that cannot be written, and leaves what was there") {
  const test::TempFolder folder;
  const std::string missing = folder / "missing/a.forest";
  REQUIRE(test::contains(test::error_message<FileError>([&] { save_forest(missing, small_forest()); }), missing));
  REQUIRE_FALSE(std::filesystem::exists(folder / "missing"));

  const std::string path = folder / "a.forest";
  save_forest(path, small_forest());
  {
    const test::FileSizeLimit limit(1000);
    REQUIRE(test::contains(test::error_message<FileError>([&] { save_forest(path, default_forest()); }),
                           path + ": cannot be written: File too large"));
  }
  REQUIRE(load_forest(path).fingerprint() == small_forest().fingerprint());

  // The file is a folder, which a file cannot replace.
  const std::string occupied = folder / "b.forest";
  std::filesystem::create_directories(occupied);
  REQUIRE(test::contains(test::error_message<FileError>([&] { save_forest(occupied, small_forest()); }), occupied));
  REQUIRE(folder.num_files() == 2);
}

TEST_CASE("save_forest: several writers of one file never collide, and readers see whole forests") {
  const test::TempFolder folder;
  const std::string path = folder / "a.forest";
  save_forest(path, small_forest());
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i) {
    writers.emplace_back([&] {
      for (int k = 0; k < 10; ++k) save_forest(path, small_forest());
    });
  }
  for (int k = 0; k < 50; ++k) REQUIRE(load_forest(path).fingerprint() == small_forest().fingerprint());
  for (std::thread& writer : writers) writer.join();
  REQUIRE(folder.num_files() == 1);
}

TEST_CASE("load_forest: bytes behind the forest are refused") {
  const test::TempFolder folder;
  const std::string path = folder / "a.forest";
  test::write_text(path, bytes_of(small_forest()) + "x");
  REQUIRE(test::contains(test::error_message<FileError>([&] { load_forest(path); }), path + ": goes on behind its end"));
}

TEST_CASE("load_forest: names a file that is missing or something else") {
  const test::TempFolder folder;
  const std::string path = folder / "a.forest";
  REQUIRE(test::contains(test::error_message<FileError>([&] { load_forest(path); }), path));
  std::ofstream(path) << "These are not the trees that you are looking for. They are words.";
  REQUIRE(test::contains(test::error_message<FileError>([&] { load_forest(path); }), path));
}

}  // namespace
}  // namespace foothold
