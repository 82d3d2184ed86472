// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstring>
#include <sstream>
#include <string>

#include "foothold/base/error.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "relocalisation/scenes.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

using test::bit_equal;
using test::contains;
using test::office;
using test::saved;
using test::trained;
using test::untrained;

/// A relocaliser of few leaves with its saved scene, small enough to damage it in many places.
struct SmallScene {
  explicit SmallScene(std::uint64_t forest_seed = 42) : relocaliser(test::context_of(1), forest(forest_seed), settings()) {
    relocaliser.train(office()[0].view(), *office()[0].world_from_camera);
    bytes = saved(relocaliser);
  }
  static Forest forest(std::uint64_t seed) {
    RandomForestSettings settings;
    settings.num_trees = 2;
    settings.depth = 4;
    settings.seed = seed;
    return make_random_forest(settings);
  }
  static ForestRelocaliserSettings settings() {
    ForestRelocaliserSettings settings = test::small_settings();
    settings.reservoirs.capacity = 32;
    return settings;
  }
  /// What load() says of other bytes; the scene must stay.
  std::string error_of(const std::string& other) {
    const std::string message = test::error_message<FileError>([&] {
      std::istringstream stream(other);
      relocaliser.load(stream);
    });
    REQUIRE((saved(relocaliser) == bytes));
    return message;
  }

  ForestRelocaliser relocaliser;
  std::string bytes;
};

TEST_CASE("ForestRelocaliser::load: gives the answers of the scene that was saved, and goes on alike") {
  ForestRelocaliser original = trained();
  ForestRelocaliser copy = untrained(2);
  std::istringstream stream(saved(original));
  copy.load(stream);
  REQUIRE(copy.state_bytes() == original.state_bytes());
  REQUIRE((saved(copy) == saved(original)));
  for (const std::size_t i : {1U, 17U, 33U}) {
    const auto estimates = original.relocalise(office()[i].view());
    REQUIRE_FALSE(estimates.empty());
    REQUIRE(bit_equal(copy.relocalise(office()[i].view()), estimates));
  }
  for (ForestRelocaliser* relocaliser : {&original, &copy}) relocaliser->train(office()[1].view(), *office()[1].world_from_camera);
  REQUIRE((saved(copy) == saved(original)));
}

TEST_CASE("ForestRelocaliser::load: an empty scene is a scene") {
  ForestRelocaliser relocaliser = trained();
  std::istringstream stream(saved(untrained()));
  relocaliser.load(stream);
  REQUIRE(relocaliser.relocalise(office()[0].view()).empty());
}

TEST_CASE("ForestRelocaliser::load: leaves the stream behind the scene, so that more can follow") {
  SmallScene scene;
  std::istringstream stream(scene.bytes + scene.bytes + "x");
  scene.relocaliser.load(stream);
  scene.relocaliser.load(stream);
  REQUIRE(stream.get() == 'x');
}

TEST_CASE("ForestRelocaliser::save: what was in memory before does not show") {
  // Blocks come from memory that others used; what the scene did not write must not be saved.
  const SmallScene first;
  for (int repeat = 0; repeat < 5; ++repeat) {
    std::vector<std::string> dirt(200, std::string(static_cast<std::size_t>(1000 * (repeat + 1)), 'd'));
    dirt.clear();
    REQUIRE((SmallScene().bytes == first.bytes));
  }
}

TEST_CASE("ForestRelocaliser::load: a truncated scene is refused, and the former one stays") {
  SmallScene scene;
  for (std::size_t length = 0; length < scene.bytes.size(); length += 1 + length / 20) {
    INFO("length " << length);
    REQUIRE_FALSE(scene.error_of(scene.bytes.substr(0, length)).empty());
  }
  REQUIRE_FALSE(scene.error_of(scene.bytes.substr(0, scene.bytes.size() - 1)).empty());
}

TEST_CASE("ForestRelocaliser::load: throws FileError alone, though the stream's exceptions are on") {
  SmallScene scene;
  for (std::size_t length = 0; length < scene.bytes.size(); length += 1 + length / 5) {
    INFO("length " << length);
    std::istringstream stream(scene.bytes.substr(0, length));
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    REQUIRE_THROWS_AS(scene.relocaliser.load(stream), FileError);
  }
}

TEST_CASE("ForestRelocaliser::load: a damaged scene is refused wherever the damage is, and the former one stays") {
  SmallScene scene;
  for (std::size_t i = 0; i < scene.bytes.size(); i += 1 + i / 50) {
    std::string damaged = scene.bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    INFO("byte " << i << " of " << scene.bytes.size());
    REQUIRE_FALSE(scene.error_of(damaged).empty());
  }
}

TEST_CASE("ForestRelocaliser::load: says what is wrong with a scene of another kind, version, forest or size") {
  SmallScene scene;
  REQUIRE(contains(scene.error_of("PLY, and then some more bytes to read"), "not a scene of a forest relocaliser of Foothold"));
  std::string other = scene.bytes;
  other[8] = 77;
  REQUIRE(contains(scene.error_of(other), "a scene of a forest relocaliser of version 77, expected version 5"));
  REQUIRE(contains(scene.error_of(SmallScene(43).bytes), "another forest"));
  ForestRelocaliserSettings settings = SmallScene::settings();
  settings.reservoirs.capacity = 48;
  const ForestRelocaliser larger(test::context_of(1), SmallScene::forest(42), settings);
  const std::string message = scene.error_of(saved(larger));
  REQUIRE(contains(message, "reservoirs.capacity = 48"));
  REQUIRE(contains(message, "expected 32"));
  settings = SmallScene::settings();
  settings.clustering.max_modes = 5;
  const ForestRelocaliser fewer(test::context_of(1), SmallScene::forest(42), settings);
  REQUIRE(contains(scene.error_of(saved(fewer)), "clustering.max_modes = 5"));
}

TEST_CASE("ForestRelocaliser::save: a stream that cannot be written is reported") {
  std::ostringstream closed;
  closed.setstate(std::ios::badbit);
  REQUIRE_THROWS_AS(SmallScene().relocaliser.save(closed), FileError);
}

}  // namespace
}  // namespace foothold
