// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/room.h"

#include <cstdint>
#include <set>
#include <string>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// A number that tells the contents of two rooms apart.
double fingerprint(const Room& room) {
  double sum = 0.0;
  double weight = 1.0;
  for (const Primitive& p : room.primitives) {
    weight = weight > 1e6 ? 1.0 : weight * 1.0137;
    sum += weight * static_cast<double>(p.world_from_local.translation.sum() + 3.0F * p.half_size_m.sum() + p.material.colour.sum());
  }
  return sum;
}

/// A checksum of what was drawn at random in a room and needs no rounding.
std::uint64_t draws_of(const Room& room) {
  std::uint64_t hash = kFnvBasis;
  for (const Primitive& p : room.primitives) {
    const auto texture = static_cast<std::uint32_t>(p.material.texture);
    for (const std::uint32_t number : {texture, p.seed, static_cast<std::uint32_t>(p.piece)}) hash = fnv1a(hash, &number, sizeof(number));
    for (const float number : {p.material.scale_m, p.material.contrast}) hash = fnv1a(hash, &number, sizeof(number));
  }
  return hash;
}

void require_sound(const Room& room) {
  INFO(room.name);
  const Eigen::Vector3f size = room.high_world - room.low_world;
  REQUIRE(size.head<2>().minCoeff() >= 3.0F);
  REQUIRE(size.head<2>().maxCoeff() <= 6.0F);
  REQUIRE(!room.lights.empty());
  REQUIRE(room.targets_world.size() >= 3);
  REQUIRE(((room.eye_low_world - room.low_world).array() > 0.3F).all());
  REQUIRE(((room.high_world - room.eye_high_world).array() > 0.3F).all());
  REQUIRE(((room.eye_high_world - room.eye_low_world).array() > 0.3F).all());
  for (const Primitive& p : room.primitives) {
    REQUIRE(is_rigid(p.world_from_local, 1e-5F));
    REQUIRE(p.half_size_m.x() > 0.0F);
    REQUIRE((p.shape == Shape::kRectangle || p.half_size_m.minCoeff() > 0.0F));
    REQUIRE(p.half_size_m.allFinite());
    REQUIRE(p.material.colour.minCoeff() >= 0.0F);
    REQUIRE(p.material.colour.maxCoeff() <= 1.0F);
    REQUIRE(p.material.scale_m > 0.0F);
  }
}

TEST_CASE("make_room: every test room is sound and furnished") {
  const std::vector<std::string> names = synthetic_room_names();
  REQUIRE(names == std::vector<std::string>{"office", "stairs", "kitchen", "textureless", "workshop", "bookshelf", "lounge", "corridor"});
  for (const std::string& name : names) {
    const Room room = make_room(name);
    require_sound(room);
    REQUIRE(room.name == name);
    REQUIRE(room.primitives.size() >= 30);
  }
}

TEST_CASE("make_room: training rooms are sound, all different, and none is a test room") {
  std::set<double> seen;
  for (const std::string& name : synthetic_room_names()) seen.insert(fingerprint(make_room(name)));
  const std::size_t num_test_rooms = seen.size();
  constexpr int kNumRooms = 60;
  for (int k = 0; k < kNumRooms; ++k) {
    const Room room = make_room("training-" + std::to_string(k));
    require_sound(room);
    REQUIRE(room.primitives.size() >= 40);
    seen.insert(fingerprint(room));
  }
  REQUIRE(seen.size() == num_test_rooms + kNumRooms);
}

TEST_CASE("make_room: the same name gives the same room") {
  for (const char* name : {"office", "training-5", "training-123456789012"})
    REQUIRE(fingerprint(make_room(name)) == fingerprint(make_room(name)));
}

TEST_CASE("make_room: training rooms are the same whatever the compiler and the processor") {
  // GCC on x86-64 evaluates the arguments of a call from the last to the first, GCC on Arm and clang from the first to the last.
  std::uint64_t hash = kFnvBasis;
  for (int k = 0; k < 50; ++k) {
    const std::uint64_t draws = draws_of(make_room("training-" + std::to_string(k)));
    hash = fnv1a(hash, &draws, sizeof(draws));
  }
  REQUIRE(hash == 0x4604a0dd3e707b2d);
}

TEST_CASE("make_room: the desks of the office are copies of each other") {
  const Room room = make_room("office");
  int num_screens = 0;
  std::set<std::uint32_t> patterns;
  for (const Primitive& p : room.primitives) {
    if (p.material.texture != Texture::kScreen) continue;
    ++num_screens;
    patterns.insert(p.seed);
  }
  REQUIRE(num_screens == 6);
  REQUIRE(patterns.size() == 1);
}

TEST_CASE("make_room: unknown names are refused with a list of the known ones") {
  using Catch::Matchers::Contains;
  for (const char* name : {"", "Office", "training-", "training-x", "training-1234567890123456789"}) {
    REQUIRE_THROWS_AS(make_room(name), InvalidSettings);
    REQUIRE_THROWS_WITH(make_room(name), Contains("office") && Contains("lounge") && Contains("training-K"));
  }
}

}  // namespace
}  // namespace foothold
