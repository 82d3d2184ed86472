// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/renderer.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "foothold/base/error.h"
#include "scenes.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using test::kHeight;
using test::kWidth;
using test::primitive;

/// Single precision over coordinates of a few metres; grazing hits amplify it.
constexpr float kDepthTolerance_m = 2e-5F;

/// The camera at the origin, looking along z.
RenderedView view_of(const Room& room) { return render(room, test::small_camera(), SE3{}, kWidth, kHeight); }

TEST_CASE("render: a wall that faces the camera has one depth") {
  const RenderedView view = view_of(test::bare_room({primitive(Shape::kRectangle, {0.0F, 0.0F, 2.5F}, {10.0F, 10.0F, 0.0F})}));
  for (std::size_t i = 0; i < view.depth.size(); ++i) REQUIRE(view.depth.data()[i] == 2.5F);
  REQUIRE(view.incidence_cosine(80, 60) == Approx(1.0F).margin(1e-4));
  REQUIRE(view.primitive(0, 0) == 0);
}

TEST_CASE("render: a tilted plane follows its equation") {
  Primitive plane = primitive(Shape::kRectangle, {0.0F, 0.0F, 3.0F}, {20.0F, 20.0F, 0.0F});
  plane.world_from_local.rotation = Eigen::AngleAxisf(0.6F, Vector3f(0.6F, 0.8F, 0.0F)).toRotationMatrix();
  const Vector3f normal = plane.world_from_local.rotation.col(2);
  const RenderedView view = view_of(test::bare_room({plane}));
  for (int v = 0; v < kHeight; v += 7) {
    for (int u = 0; u < kWidth; u += 7) {
      const Vector3f ray = test::small_camera().back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
      REQUIRE(view.depth(u, v) == Approx(3.0F * normal.z() / normal.dot(ray)).margin(kDepthTolerance_m));
    }
  }
}

TEST_CASE("render: a sphere ahead is nearest in its middle and round at its rim") {
  constexpr float kRadius = 0.5F;
  constexpr float kDistance = 2.0F;
  const Intrinsics camera = test::small_camera();
  const RenderedView view = view_of(test::bare_room({primitive(Shape::kSphere, {0.0F, 0.0F, kDistance}, Vector3f::Constant(kRadius))}));
  // The rim is where rays make the angle asin(r / d) with the axis.
  const float rim = kRadius / std::sqrt(kDistance * kDistance - kRadius * kRadius);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Vector3f ray = camera.back_project(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const float off_axis = ray.head<2>().norm();
      if (std::fabs(off_axis - rim) < 1e-3F) continue;
      REQUIRE((view.depth(u, v) > 0.0F) == (off_axis < rim));
      if (off_axis > rim) continue;
      const float a = ray.squaredNorm();
      const float root = std::sqrt(kDistance * kDistance - a * (kDistance * kDistance - kRadius * kRadius));
      REQUIRE(view.depth(u, v) == Approx((kDistance - root) / a).margin(kDepthTolerance_m));
    }
  }
}

TEST_CASE("render: boxes and cylinders show their near faces") {
  const Room boxes = test::bare_room({primitive(Shape::kBox, {0.0F, 0.0F, 2.0F}, {0.3F, 0.2F, 0.25F})});
  REQUIRE(view_of(boxes).depth(80, 60) == Approx(1.75F).margin(kDepthTolerance_m));
  REQUIRE(view_of(boxes).depth(2, 2) == 0.0F);
  // A cylinder seen end on, then from the side.
  Primitive cylinder = primitive(Shape::kCylinder, {0.0F, 0.0F, 2.0F}, {0.2F, 0.2F, 0.4F});
  REQUIRE(view_of(test::bare_room({cylinder})).depth(80, 60) == Approx(1.6F).margin(kDepthTolerance_m));
  cylinder.world_from_local.rotation = Eigen::AngleAxisf(1.5707964F, Vector3f::UnitX()).toRotationMatrix();
  REQUIRE(view_of(test::bare_room({cylinder})).depth(80, 60) == Approx(1.8F).margin(1e-4));
}

TEST_CASE("render: the nearest of several surfaces wins") {
  const Room room = test::bare_room({primitive(Shape::kRectangle, {0.0F, 0.0F, 3.0F}, {9.0F, 9.0F, 0.0F}),
                                     primitive(Shape::kBox, {0.0F, 0.0F, 2.0F}, {0.1F, 0.1F, 0.1F}),
                                     primitive(Shape::kRectangle, {0.0F, 0.0F, 5.0F}, {9.0F, 9.0F, 0.0F})});
  const RenderedView view = view_of(room);
  REQUIRE(view.primitive(80, 60) == 1);
  REQUIRE(view.depth(80, 60) == Approx(1.9F).margin(kDepthTolerance_m));
  REQUIRE(view.primitive(5, 5) == 0);
}

TEST_CASE("render: what is behind the camera, or around it, is not seen") {
  const Room room = test::bare_room(
      {primitive(Shape::kBox, {0.0F, 0.0F, -1.0F}, {0.5F, 0.5F, 0.5F}), primitive(Shape::kBox, {0.0F, 0.0F, 0.0F}, {0.2F, 0.2F, 0.2F})});
  const RenderedView view = view_of(room);
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    REQUIRE(view.depth.data()[i] == 0.0F);
    REQUIRE(view.primitive.data()[i] == -1);
  }
}

/// Smallest positive solution over one primitive by testing all its faces, in double precision.
double naive_depth(const Primitive& p, const Vector3d& ray_world) {
  const Eigen::Matrix3d rotation = p.world_from_local.rotation.cast<double>();
  const Vector3d d = rotation.transpose() * ray_world;
  const Vector3d o = -(rotation.transpose() * p.world_from_local.translation.cast<double>());
  const Vector3d h = p.half_size_m.cast<double>();
  const double r = h.x();
  double best = std::numeric_limits<double>::infinity();
  const auto consider = [&](double t, auto&& on_surface) {
    if (t > 0.0 && t < best && on_surface(Vector3d(o + t * d))) best = t;
  };
  const auto consider_roots = [&](double a, double b, double c, auto&& on_surface) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return;
    consider((-b - std::sqrt(discriminant)) / a, on_surface);
    consider((-b + std::sqrt(discriminant)) / a, on_surface);
  };
  switch (p.shape) {
    case Shape::kRectangle:
      consider(-o.z() / d.z(), [&](const Vector3d& x) { return std::abs(x.x()) <= h.x() && std::abs(x.y()) <= h.y(); });
      break;
    case Shape::kBox:
      for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
          consider((side * h[axis] - o[axis]) / d[axis], [&](const Vector3d& x) {
            return std::abs(x[(axis + 1) % 3]) <= h[(axis + 1) % 3] && std::abs(x[(axis + 2) % 3]) <= h[(axis + 2) % 3];
          });
        }
      }
      break;
    case Shape::kSphere:
      consider_roots(d.squaredNorm(), o.dot(d), o.squaredNorm() - r * r, [](const Vector3d&) { return true; });
      break;
    case Shape::kCylinder:
      consider_roots(d.head<2>().squaredNorm(), o.head<2>().dot(d.head<2>()), o.head<2>().squaredNorm() - r * r,
                     [&](const Vector3d& x) { return std::abs(x.z()) <= h.z(); });
      for (const double side : {-1.0, 1.0})
        consider((side * h.z() - o.z()) / d.z(), [&](const Vector3d& x) { return x.head<2>().norm() <= r; });
      break;
  }
  return best;
}

TEST_CASE("render: agrees with a naive ray-caster on random primitives") {
  // A ray within rounding of a silhouette may hit or miss: a few pixels in a thousand.
  constexpr double kDifferingShare = 2e-3;
  Random random = test::test_random();
  int num_pixels = 0;
  int num_differing = 0;
  for (int scene = 0; scene < 8; ++scene) {
    Room room = test::bare_room({});
    while (room.primitives.size() < 30) {
      const Primitive candidate = test::random_primitive(random, 3.0F);
      // The naive caster also sees solids from inside.
      if (candidate.world_from_local.translation.norm() > 1.2F) room.primitives.push_back(candidate);
    }
    const RenderedView view = view_of(room);
    for (int v = 0; v < kHeight; v += 3) {
      for (int u = 0; u < kWidth; u += 3) {
        const Vector3d ray = test::small_camera().back_project(static_cast<float>(u), static_cast<float>(v), 1.0F).cast<double>();
        double expected = std::numeric_limits<double>::infinity();
        for (const Primitive& p : room.primitives) expected = std::min(expected, naive_depth(p, ray));
        const double actual = view.depth(u, v) > 0.0F ? static_cast<double>(view.depth(u, v)) : std::numeric_limits<double>::infinity();
        ++num_pixels;
        if (!(actual == expected) && !(std::abs(actual - expected) < 2e-4)) ++num_differing;
      }
    }
  }
  REQUIRE(num_differing < kDifferingShare * num_pixels);
}

TEST_CASE("render: every point seen lies on a surface of the room") {
  for (const std::string& name : synthetic_room_names()) {
    const Room room = make_room(name);
    SE3 world_from_camera;
    world_from_camera.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    world_from_camera.translation = 0.5F * (room.eye_low_world + room.eye_high_world);
    const RenderedView view = render(room, test::small_camera(), world_from_camera, kWidth, kHeight);
    for (int v = 0; v < kHeight; v += 9) {
      for (int u = 0; u < kWidth; u += 9) {
        REQUIRE(view.depth(u, v) > 0.0F);
        const Vector3f point =
            world_from_camera * test::small_camera().back_project(static_cast<float>(u), static_cast<float>(v), view.depth(u, v));
        REQUIRE(distance_to_surface(room, point) < 1e-4F);
      }
    }
  }
}

TEST_CASE("render: the same image on 1, 2 and 4 threads, and for sizes that are no multiple of a tile") {
  const Room room = make_room("kitchen");
  SE3 world_from_camera;
  world_from_camera.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  world_from_camera.translation = {-0.3F, -0.8F, 1.5F};
  const RenderedView expected = render(room, test::small_camera(), world_from_camera, 161, 119);
  for (const int num_threads : {1, 2, 4}) {
    ContextOptions options;
    options.num_threads = num_threads;
    const RenderedView view = render(Context(options), room, test::small_camera(), world_from_camera, 161, 119);
    REQUIRE(std::memcmp(view.depth.data(), expected.depth.data(), view.depth.size() * sizeof(float)) == 0);
    REQUIRE(std::memcmp(view.colour.data(), expected.colour.data(), view.colour.size() * sizeof(Rgb8)) == 0);
  }
}

TEST_CASE("render: refuses impossible cameras and sizes") {
  const Room room = test::bare_room({});
  REQUIRE_THROWS_AS(render(room, Intrinsics{}, SE3{}, 10, 10), ContractViolation);
  REQUIRE_THROWS_AS(render(room, test::small_camera(), SE3{}, 0, 10), ContractViolation);
}

}  // namespace
}  // namespace foothold
