// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/room_changes.h"

#include <cstring>
#include <map>
#include <set>
#include <string>

#include "foothold/base/error.h"
#include "foothold/synthetic/renderer.h"
#include "foothold/synthetic/trajectory.h"
#include "scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Where the first primitive of each piece is.
std::map<int, Eigen::Vector3f> places(const Room& room) {
  std::map<int, Eigen::Vector3f> result;
  for (const Primitive& p : room.primitives) {
    if (p.piece != Primitive::kFixture) result.emplace(p.piece, p.world_from_local.translation);
  }
  return result;
}

std::vector<Primitive> fixtures(const Room& room) {
  std::vector<Primitive> result;
  for (const Primitive& p : room.primitives) {
    if (p.piece == Primitive::kFixture) result.push_back(p);
  }
  return result;
}

struct Difference {
  int num_moved = 0;
  int num_removed = 0;
  int num_added = 0;
};

Difference difference(const Room& before, const Room& after) {
  const auto was = places(before);
  const auto is = places(after);
  Difference result;
  for (const auto& [piece, place] : was) {
    const auto found = is.find(piece);
    if (found == is.end()) {
      ++result.num_removed;
    } else if ((found->second - place).norm() > 0.02F) {
      ++result.num_moved;
    }
  }
  for (const auto& [piece, place] : is) result.num_added += was.count(piece) == 0 ? 1 : 0;
  return result;
}

TEST_CASE("changed_room: moves, removes and adds about the shares asked for, and leaves the building alone") {
  for (const std::string& name : {std::string("office"), std::string("kitchen"), std::string("training-7")}) {
    INFO(name);
    const Room room = make_room(name);
    const auto num_pieces = static_cast<double>(places(room).size());
    REQUIRE(num_pieces >= 15.0);
    RoomChanges changes;
    changes.moved = 0.3F;
    changes.removed = 0.1F;
    changes.added = 0.2F;
    changes.change_seed = 5;
    const Room after = changed_room(room, changes);
    const Difference found = difference(room, after);
    // A piece that finds no other place stays, and a turned piece may keep its first primitive about where it was.
    REQUIRE(found.num_moved <= 0.3 * num_pieces + 1.0);
    REQUIRE(found.num_moved >= 0.2 * num_pieces - 1.0);
    REQUIRE(found.num_removed == Approx(0.1 * num_pieces).margin(1.0));
    REQUIRE(found.num_added <= 0.2 * num_pieces + 1.0);
    REQUIRE(found.num_added >= 0.1 * num_pieces - 1.0);
    const std::vector<Primitive> before_fixtures = fixtures(room);
    const std::vector<Primitive> after_fixtures = fixtures(after);
    REQUIRE(before_fixtures.size() == after_fixtures.size());
    for (std::size_t i = 0; i < before_fixtures.size(); ++i)
      REQUIRE(before_fixtures[i].world_from_local.translation == after_fixtures[i].world_from_local.translation);
    for (const Primitive& p : after.primitives) REQUIRE(is_rigid(p.world_from_local, 1e-5F));
  }
}

TEST_CASE("changed_room: what stands on a piece goes along with it") {
  const Room room = make_room("office");
  RoomChanges changes;
  changes.removed = 0.5F;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    changes.change_seed = seed;
    for (const Primitive& thing : changed_room(room, changes).primitives) {
      // The office's screens stand on its desks, 73 cm high.
      if (thing.material.texture != Texture::kScreen) continue;
      bool carried = false;
      for (const Primitive& desk : changed_room(room, changes).primitives) {
        const Eigen::Vector3f from_desk = thing.world_from_local.translation - desk.world_from_local.translation;
        carried = carried || (desk.shape == Shape::kBox && desk.half_size_m.x() > 0.7F && from_desk.z() > 0.0F && from_desk.z() < 0.6F &&
                              from_desk.head<2>().norm() < 1.0F);
      }
      REQUIRE(carried);
    }
  }
}

TEST_CASE("changed_room: no change is the same room, and seeds change other things, and equal arguments give equal rooms") {
  const Room room = make_room("lounge");
  const Difference none = difference(room, changed_room(room, {}));
  REQUIRE(none.num_moved + none.num_removed + none.num_added == 0);
  RoomChanges changes;
  changes.moved = 0.3F;
  const auto first = places(changed_room(room, changes));
  REQUIRE(places(changed_room(room, changes)) == first);
  changes.change_seed = 1;
  REQUIRE(places(changed_room(room, changes)) != first);
}

TEST_CASE("changed_room: the cameras of the unchanged room stay out of what was moved and added") {
  RoomChanges changes;
  changes.moved = 0.5F;
  changes.added = 0.5F;
  for (const char* name : {"office", "training-3"}) {
    const Room room = make_room(name);
    const Room after = changed_room(room, changes);
    const Trajectory trajectory(room, TrajectoryKind::kTrain, 42);
    int num_close = 0;
    for (int i = 0; i < 100; ++i)
      num_close += distance_to_surface(after, trajectory.world_from_camera(0.4 * i).translation) < 0.15F ? 1 : 0;
    REQUIRE(num_close <= 3);  // the path may leave the box in which the camera usually is
  }
}

TEST_CASE("changed_room: a mirrored room has mirrored depth for the mirrored camera") {
  const Room room = make_room("workshop");
  RoomChanges changes;
  changes.mirrored = true;
  const SE3 pose = Trajectory(room, TrajectoryKind::kTrain, 42).world_from_camera(3.0);
  REQUIRE(is_rigid(mirrored_pose(pose), 1e-5F));
  Intrinsics camera = test::small_camera();
  camera.cx = 0.5F * static_cast<float>(test::kWidth - 1);  // pixels have mirrored partners
  const Image<float> depth = render(room, camera, pose, test::kWidth, test::kHeight).depth;
  const Image<float> mirrored = render(changed_room(room, changes), camera, mirrored_pose(pose), test::kWidth, test::kHeight).depth;
  int num_equal = 0;
  for (int v = 0; v < test::kHeight; ++v) {
    for (int u = 0; u < test::kWidth; ++u) num_equal += std::abs(depth(u, v) - mirrored(test::kWidth - 1 - u, v)) < 1e-3F ? 1 : 0;
  }
  // Rays along edges fall to either side.
  REQUIRE(num_equal > 0.99 * test::kWidth * test::kHeight);
}

TEST_CASE("changed_room: refuses shares beyond [0, 1]") {
  RoomChanges changes;
  changes.moved = 1.5F;
  REQUIRE_THROWS_AS(changed_room(make_room("office"), changes), InvalidSettings);
}

}  // namespace
}  // namespace foothold
