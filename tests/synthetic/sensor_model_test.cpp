// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/sensor_model.h"

#include <cmath>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "scenes.h"
#include "support/catch.h"

namespace foothold {
namespace {

using Eigen::Vector3f;
using test::kHeight;
using test::kWidth;
using test::primitive;

Room wall_at(float distance_m) { return test::bare_room({primitive(Shape::kRectangle, {0.0F, 0.0F, distance_m}, {20.0F, 20.0F, 0.0F})}); }

RenderedView measured(const Room& room, int level = 1, int frame = 0) {
  return measure(sensor_model(level), room, render(room, test::small_camera(), SE3{}, kWidth, kHeight), 1, frame);
}

/// Mean and standard deviation of the measured depth.
struct Spread {
  double mean_m = 0.0;
  double sigma_m = 0.0;
  double valid = 0.0;
};
Spread spread(const Image<float>& depth) {
  double sum = 0.0;
  double sum2 = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const auto z = static_cast<double>(depth.data()[i]);
    if (z <= 0.0) continue;
    sum += z;
    sum2 += z * z;
    n += 1.0;
  }
  return {sum / n, std::sqrt(sum2 / n - sum * sum / n / n), n / static_cast<double>(depth.size())};
}

TEST_CASE("measure: depth noise grows with squared depth as the disparity's noise and quantisation demand") {
  const SensorModel model = sensor_model(1);
  const double step = static_cast<double>(model.disparity_step_px);
  const double sigma_px = std::hypot(static_cast<double>(model.disparity_sigma_px), step / std::sqrt(12.0));
  for (const float distance_m : {1.0F, 2.0F, 4.0F}) {
    const double z = static_cast<double>(distance_m);
    const Spread actual = spread(measured(wall_at(distance_m)).depth);
    const double expected_m = z * z / static_cast<double>(model.focal_baseline_px_m) * sigma_px;
    REQUIRE(actual.valid > 0.99);
    REQUIRE(actual.mean_m == Approx(z).margin(0.5 * expected_m + 1e-4));
    // The generator's normal numbers are approximate, and where a wall falls between two steps matters.
    REQUIRE(actual.sigma_m == Approx(expected_m).epsilon(0.3));
  }
}

TEST_CASE("measure: depth is a whole number of disparity steps") {
  const SensorModel model = sensor_model(1);
  const RenderedView view = measured(wall_at(2.3F));
  for (std::size_t i = 0; i < view.depth.size(); i += 17) {
    const float steps = model.focal_baseline_px_m / view.depth.data()[i] / model.disparity_step_px;
    REQUIRE(steps == Approx(std::round(steps)).margin(1e-3));
  }
}

TEST_CASE("measure: nothing nearer or farther than the camera's limits") {
  REQUIRE(spread(measured(wall_at(2.0F)).depth).valid > 0.99);
  const RenderedView near = measured(wall_at(0.3F));
  const RenderedView far = measured(wall_at(6.5F));
  for (std::size_t i = 0; i < near.depth.size(); ++i) {
    REQUIRE(near.depth.data()[i] == 0.0F);
    REQUIRE(far.depth.data()[i] == 0.0F);
  }
}

TEST_CASE("measure: a nearer object throws its shadow to the left only") {
  Room room = wall_at(3.0F);
  room.primitives.push_back(primitive(Shape::kBox, {0.0F, 0.0F, 1.05F}, {0.1F, 0.1F, 0.05F}));
  const RenderedView ideal = render(room, test::small_camera(), SE3{}, kWidth, kHeight);
  const RenderedView view = measure(sensor_model(1), room, ideal, 1, 0);
  const int row = kHeight / 2;
  int left = 0;
  while (ideal.primitive(left, row) != 1) ++left;
  int right = left;
  while (ideal.primitive(right, row) == 1) ++right;
  int num_left = 0;
  int num_right = 0;
  for (int i = 2; i < 20; ++i) {
    num_left += view.depth(left - i, row) == 0.0F ? 1 : 0;
    num_right += view.depth(right - 1 + i, row) == 0.0F ? 1 : 0;
  }
  // The disparities differ by 43.875 * (1 - 1/3) = 29 pixels at 640, 7 here.
  REQUIRE(num_left >= 4);
  REQUIRE(num_left <= 8);
  REQUIRE(num_right == 0);
}

TEST_CASE("measure: surfaces seen edge on and window panes have holes") {
  // A floor 5 cm below the camera, seen at less than 5 degrees beyond 0.6 m.
  Primitive floor = primitive(Shape::kRectangle, {0.0F, 0.05F, 3.0F}, {20.0F, 20.0F, 0.0F});
  floor.world_from_local.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Room room = test::bare_room({floor});
  const RenderedView grazing = measured(room);
  for (int u = 0; u < kWidth; ++u) REQUIRE(grazing.depth(u, kHeight / 2 + 2) == 0.0F);
  Room pane = wall_at(2.0F);
  pane.primitives.front().material.infrared_return = 0.0F;
  REQUIRE(spread(measured(wall_at(2.0F)).depth).valid > 0.99);
  const RenderedView unseen = measured(pane);
  for (std::size_t i = 0; i < unseen.depth.size(); ++i) REQUIRE(unseen.depth.data()[i] == 0.0F);
  pane.primitives.front().material.infrared_return = 0.5F;
  const double half_seen = spread(measured(pane).depth).valid;
  REQUIRE(half_seen > 0.3);
  REQUIRE(half_seen < 0.7);
}

TEST_CASE("measure: colour keeps its mean and gains noise of the stated size") {
  const Room room = wall_at(2.0F);
  SensorModel model = sensor_model(1);
  model.vignetting = 0.0F;
  const RenderedView ideal = render(room, test::small_camera(), SE3{}, kWidth, kHeight);
  const RenderedView view = measure(model, room, ideal, 1, 0);
  double sum = 0.0;
  double sum2 = 0.0;
  for (std::size_t i = 0; i < view.colour.size(); ++i) {
    const double difference = static_cast<double>(view.colour.data()[i].g) - static_cast<double>(ideal.colour.data()[i].g);
    sum += difference;
    sum2 += difference * difference;
  }
  const auto n = static_cast<double>(view.colour.size());
  REQUIRE(std::abs(sum / n) < 0.2);
  REQUIRE(std::sqrt(sum2 / n) == Approx(static_cast<double>(model.colour_sigma)).epsilon(0.1));
}

TEST_CASE("measure: noise differs between frames and repeats for equal ones") {
  const Room room = wall_at(2.0F);
  const auto num_differing = [](const RenderedView& a, const RenderedView& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.colour.size(); ++i) count += a.colour.data()[i].g != b.colour.data()[i].g ? 1 : 0;
    return count;
  };
  REQUIRE(num_differing(measured(room, 1, 3), measured(room, 1, 3)) == 0);
  REQUIRE(num_differing(measured(room, 1, 3), measured(room, 1, 4)) > kWidth * kHeight / 2);
}

TEST_CASE("sensor_model: level 2 is noisier than level 1, and other levels do not exist") {
  REQUIRE(spread(measured(wall_at(3.0F), 2).depth).sigma_m > 1.5 * spread(measured(wall_at(3.0F), 1).depth).sigma_m);
  REQUIRE_THROWS_AS(sensor_model(0), ContractViolation);
  REQUIRE_THROWS_AS(sensor_model(3), ContractViolation);
}

TEST_CASE("add_noise: spreads a wall as the disparity's noise demands, differs from frame to frame and keeps holes") {
  const SensorModel model = sensor_model(1);
  constexpr float kWall_m = 3.0F;
  Image<float> depth(kWidth, kHeight);
  Image<Rgb8> colour(kWidth, kHeight);
  for (std::size_t i = 0; i < depth.size(); ++i) depth.data()[i] = kWall_m;
  for (std::size_t i = 0; i < colour.size(); ++i) colour.data()[i] = {128, 128, 128};
  depth(3, 4) = 0.0F;
  Image<float> first = depth;
  Image<float> second = depth;
  Image<Rgb8> first_colour = colour;
  Image<Rgb8> second_colour = colour;
  add_noise(model, 1, 0, first, first_colour);
  add_noise(model, 1, 1, second, second_colour);
  const double expected_m = static_cast<double>(kWall_m * kWall_m * model.disparity_sigma_px / model.focal_baseline_px_m);
  REQUIRE(spread(first).mean_m == Approx(static_cast<double>(kWall_m)).margin(0.2 * expected_m));
  REQUIRE(spread(first).sigma_m == Approx(expected_m).epsilon(0.1));  // the generator's normal numbers are approximate
  REQUIRE(first(3, 4) == 0.0F);
  REQUIRE(first(5, 5) != second(5, 5));
  double sum2 = 0.0;
  for (std::size_t i = 0; i < colour.size(); ++i) sum2 += std::pow(first_colour.data()[i].g - 128.0, 2);
  REQUIRE(std::sqrt(sum2 / static_cast<double>(colour.size())) == Approx(static_cast<double>(model.colour_sigma)).epsilon(0.1));
  Image<float> again = depth;
  Image<Rgb8> again_colour = colour;
  add_noise(model, 1, 0, again, again_colour);
  REQUIRE(again(5, 5) == first(5, 5));
}

}  // namespace
}  // namespace foothold
