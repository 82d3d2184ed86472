// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/files/scene_file.h"

#include <sstream>

#include "foothold/base/checked_stream.h"
#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/file_size_limit.h"
#include "support/random_seed.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;

/// A part that is some bytes, which it finds again by reading to the end, or by their number.
struct Bytes : Persistent {
  explicit Bytes(std::string b = {}) : bytes(std::move(b)) {}
  void save(std::ostream& stream) const override {
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream) throw FileError("the bytes could not be written");
  }
  void load(std::istream& stream) override {
    std::ostringstream all;
    all << stream.rdbuf();
    if (refuses) throw FileError("these bytes are not wanted");
    bytes = all.str();
  }

  std::string bytes;
  bool refuses = false;
};

/// Reads only the first byte of what was saved.
struct FirstByte : Persistent {
  void save(std::ostream& stream) const override { stream.put('x'); }
  void load(std::istream& stream) override { stream.get(); }
};

std::string random_bytes(Random& random, std::size_t size) {
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
  return bytes;
}

SceneDescription description() {
  return {{{"fusion.volume.voxel_size_m", "0.01"}, {"camera.device", "1 \"two\""}}, {{"source", "a camera"}, {"frames", "12"}}};
}

std::string scene_bytes(const std::vector<SavedPart>& parts) {
  std::ostringstream file;
  write_scene(file, description(), parts);
  return file.str();
}

/// The error with which a scene of the parts "first" and "second" is refused.
std::string refusal(const std::string& bytes) {
  std::istringstream file(bytes);
  Bytes first;
  Bytes second;
  return error_of([&] { read_scene(file, "a.scene", {{"first", &first}, {"second", &second}}); });
}

}  // namespace

TEST_CASE("save_scene: a scene comes back as it was, whatever its parts' size") {
  const TempFolder temp;
  Random random = test_random();
  const std::size_t size = GENERATE(as<std::size_t>{}, 0, 1, 1000, kMaxPieceBytes - 1, kMaxPieceBytes, kMaxPieceBytes + 1, 3000000);
  const Bytes first(random_bytes(random, size));
  const Bytes second("short");
  save_scene(temp / "a.scene", description(), {{"first", &first}, {"second", &second}});
  CHECK(temp.num_files() == 1);
  Bytes first_again("other");
  Bytes second_again;
  const SceneDescription loaded = load_scene(temp / "a.scene", {{"first", &first_again}, {"second", &second_again}});
  CHECK((first_again.bytes == first.bytes));
  CHECK(second_again.bytes == "short");
  for (const SceneDescription& read : {loaded, read_scene_description(temp / "a.scene")}) {
    REQUIRE(read.settings.size() == 2);
    CHECK(read.settings[0].path == "fusion.volume.voxel_size_m");
    CHECK(read.settings[0].text == "0.01");
    CHECK(read.settings[1].text == "1 \"two\"");
    REQUIRE(read.provenance.size() == 2);
    CHECK(read.provenance[0].path == "source");
    CHECK(read.provenance[0].text == "a camera");
  }
}

TEST_CASE("save_scene: text that JSON does not allow is replaced, not refused") {
  const TempFolder temp;
  save_scene(temp / "a.scene", {{}, {{"source", "caf\xe9"}}}, {});
  CHECK(read_scene_description(temp / "a.scene").provenance.at(0).text == "caf\xef\xbf\xbd");
}

TEST_CASE("save_scene: when the disk has no room, the old file stays and the reason is told") {
  const TempFolder temp;
  write_text(temp / "a.scene", "old");
  const Bytes big(std::string(4U << 20U, 'x'));
  const auto error = [&] {
    const FileSizeLimit limit(1U << 20U);
    return error_of([&] { save_scene(temp / "a.scene", description(), {{"big", &big}}); });
  }();
  CHECK_THAT(error, Contains(temp / "a.scene") && Contains("File too large"));
  CHECK(read_text(temp / "a.scene") == "old");
  CHECK(temp.num_files() == 1);
}

TEST_CASE("load_scene: what is no scene, or of another version, is told apart") {
  const TempFolder temp;
  CHECK_THAT(error_of([&] { load_scene(temp / "absent", {}); }), Contains(temp / "absent") && Contains("No such file"));
  CHECK_THAT(error_of([&] { read_scene_description(temp.path()); }), Contains(temp.path()));
  CHECK_THAT(refusal("FHFOREST and more of it"), Contains("a.scene: not a scene of Foothold"));
  std::string other_version = scene_bytes({});
  other_version[8] = 9;
  CHECK_THAT(refusal(other_version), Contains("a scene of version 9, expected version 3"));
}

TEST_CASE("load_scene: other parts than those expected are refused by name") {
  const Bytes part("abc");
  CHECK_THAT(refusal(scene_bytes({{"first", &part}})), Contains("got 1 parts, expected 2"));
  CHECK_THAT(refusal(scene_bytes({{"first", &part}, {"third", &part}})), Contains("got part 'third', expected part 'second'"));
}

TEST_CASE("load_scene: a scene can be refused by its description, before any part is touched") {
  const TempFolder temp;
  const Bytes part("abc");
  save_scene(temp / "a.scene", description(), {{"only", &part}});
  Bytes reader("old");
  const SceneCheck refuse = [](const SceneDescription& scene) { throw FileError("of " + scene.provenance.at(0).text); };
  CHECK(error_of([&] { load_scene(temp / "a.scene", {{"only", &reader}}, refuse); }) == "of a camera");
  CHECK(reader.bytes == "old");
  load_scene(temp / "a.scene", {{"only", &reader}}, [](const SceneDescription&) {});
  CHECK(reader.bytes == "abc");
}

TEST_CASE("load_scene: a part's refusal names the file") {
  const Bytes part("abc");
  std::istringstream file(scene_bytes({{"only", &part}}));
  Bytes reader("old");
  reader.refuses = true;
  CHECK_THAT(error_of([&] {
               read_scene(file, "a.scene", {{"only", &reader}});
             }),
             Contains("a.scene: part 'only': these bytes are not wanted"));
  CHECK(reader.bytes == "old");
}

TEST_CASE("load_scene: bytes that a part leaves are refused") {
  const Bytes part("abc");
  std::istringstream file(scene_bytes({{"only", &part}}));
  FirstByte reader;
  CHECK_THAT(error_of([&] { read_scene(file, "a.scene", {{"only", &reader}}); }), Contains("goes on where its end was expected"));
}

TEST_CASE("load_scene: a scene cut short anywhere, or with more behind its end, is refused") {
  Random random = test_random();
  const Bytes first(random_bytes(random, 200));
  const Bytes second(random_bytes(random, 100));
  const std::string good = scene_bytes({{"first", &first}, {"second", &second}});
  REQUIRE(refusal(good) == "(nothing was thrown)");
  for (std::size_t size = 0; size < good.size(); ++size) {
    INFO("cut to " << size << " bytes");
    CHECK_THAT(refusal(good.substr(0, size)), Contains("a.scene") && Contains("ends early"));
  }
  CHECK_THAT(refusal(good + "x"), Contains("a.scene: goes on where the scene's end was expected"));
}

TEST_CASE("load_scene: any flipped bit is noticed") {
  Random random = test_random();
  const Bytes first(random_bytes(random, 200));
  const Bytes second(random_bytes(random, 100));
  const std::string good = scene_bytes({{"first", &first}, {"second", &second}});
  for (std::size_t place = 0; place < good.size(); ++place) {
    INFO("byte " << place);
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ static_cast<char>(1U << random.below(8)));
    CHECK_THAT(refusal(bad), Contains("a.scene"));
  }
}

TEST_CASE("load_scene: pieces of another scene, and pieces that were exchanged, are noticed") {
  const Bytes a("aaaa");
  const Bytes b("bbbb");
  const std::string one = scene_bytes({{"first", &a}, {"second", &b}});
  const std::string other = scene_bytes({{"first", &b}, {"second", &a}});
  REQUIRE(one.size() == other.size());
  const std::size_t half = one.rfind("FHPART");
  CHECK_THAT(refusal(one.substr(0, half) + other.substr(half)), Contains("checksum"));
}

}  // namespace foothold
