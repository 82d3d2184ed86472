// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "clustering/quick_shift.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "relocalisation/clouds.h"
#include "support/catch.h"
#include "support/checked_bytes.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using test::blobs;
using test::Cloud;
using test::Leaves;
using test::point_at;
using test::random_vector;

/// A cluster as the naive algorithm finds it.
struct Cluster {
  std::vector<std::size_t> members;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
};

/// Really Quick Shift by its definition, in double precision: largest clusters first, small ones dropped.
std::vector<Cluster> naive_quick_shift(const Cloud& cloud, const ClusteringSettings& settings) {
  const std::size_t n = cloud.size();
  const double sigma = static_cast<double>(kDensitySigmaM);
  const double tau = static_cast<double>(kLongestLinkM);
  std::vector<Eigen::Vector3d> points;
  for (const ReservoirPoint& p : cloud) points.emplace_back(p.x_mm * 1e-3, p.y_mm * 1e-3, p.z_mm * 1e-3);
  std::vector<double> density(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double d2 = (points[i] - points[j]).squaredNorm();
      if (d2 < 9.0 * sigma * sigma) density[i] += std::exp(-0.5 * d2 / (sigma * sigma));
    }
  }
  std::vector<std::size_t> parent(n);
  for (std::size_t i = 0; i < n; ++i) {
    parent[i] = i;
    double nearest = tau * tau;
    for (std::size_t j = 0; j < n; ++j) {
      const double d2 = (points[i] - points[j]).squaredNorm();
      if ((density[j] > density[i] || (density[j] == density[i] && j < i)) && d2 < nearest) {
        nearest = d2;
        parent[i] = j;
      }
    }
  }
  std::vector<Cluster> by_root(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t root = i;
    while (parent[root] != root) root = parent[root];
    by_root[root].members.push_back(i);
  }
  std::vector<Cluster> clusters;
  for (Cluster& cluster : by_root) {
    if (static_cast<int>(cluster.members.size()) < std::max(settings.min_cluster_size, 1)) continue;
    for (const std::size_t i : cluster.members) cluster.mean_m += points[i] / static_cast<double>(cluster.members.size());
    for (const std::size_t i : cluster.members) {
      cluster.covariance_m2 += (points[i] - cluster.mean_m) * (points[i] - cluster.mean_m).transpose() /
                               std::max(1.0, static_cast<double>(cluster.members.size()) - 1.0);
    }
    clusters.push_back(cluster);
  }
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const Cluster& a, const Cluster& b) { return a.members.size() > b.members.size(); });
  if (clusters.size() > static_cast<std::size_t>(settings.max_modes)) clusters.resize(static_cast<std::size_t>(settings.max_modes));
  return clusters;
}

/// The modes of one cloud.
std::vector<Mode> modes_of(const Cloud& cloud, const ClusteringSettings& settings) {
  Leaves leaves({cloud}, settings);
  leaves.update();
  return leaves.modes_of(0);
}

Eigen::Matrix3d precision_of(const Mode& mode) {
  const float* p = mode.precision;
  Eigen::Matrix3d m;
  m << p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5];
  return m;
}

void require_alike(const Mode& mode, const Cluster& cluster, const ClusteringSettings& settings) {
  REQUIRE(mode.num_points == cluster.members.size());
  const Eigen::Vector3d mean(static_cast<double>(mode.mean_m[0]), static_cast<double>(mode.mean_m[1]), static_cast<double>(mode.mean_m[2]));
  REQUIRE((mean - cluster.mean_m).norm() < 2e-6);  // single precision at 16 m
  const double floor_m = static_cast<double>(settings.covariance_floor_m);
  const Eigen::Matrix3d expected = (cluster.covariance_m2 + floor_m * floor_m * Eigen::Matrix3d::Identity()).inverse();
  REQUIRE((precision_of(mode) - expected).norm() < 1e-5 * expected.norm());
}

TEST_CASE("exp_minus: is the exponential to 0.7 %") {
  for (float t = 0.0F; t <= 4.5F; t += 0.001F) REQUIRE(exp_minus(t) == Approx(std::exp(-t)).epsilon(0.007));
}

TEST_CASE("LeafModes: finds separate blobs with the counts, means and covariances of the naive algorithm") {
  Random random = test::test_random();
  const ClusteringSettings settings;
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Cloud cloud = blobs(random, 1 + repeat % 9, 10);
    const std::vector<Cluster> expected = naive_quick_shift(cloud, settings);
    REQUIRE(expected.size() == static_cast<std::size_t>(1 + repeat % 9));
    const std::vector<Mode> found = modes_of(cloud, settings);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) require_alike(found[k], expected[k], settings);
  }
}

TEST_CASE("LeafModes: agrees with the naive algorithm on clouds without structure") {
  Random random = test::test_random();
  ClusteringSettings settings;
  settings.max_modes = 64;
  int num_modes = 0;
  int num_alike = 0;
  for (int repeat = 0; repeat < 40; ++repeat) {
    Cloud cloud;
    const float size = random.uniform(80.0F, 400.0F);
    const std::uint32_t count = 50 + random.below(400);
    for (std::uint32_t i = 0; i < count; ++i) cloud.push_back(point_at(random_vector(random, size)));
    const std::vector<Cluster> expected = naive_quick_shift(cloud, settings);
    num_modes += static_cast<int>(expected.size());
    for (const Mode& mode : modes_of(cloud, settings)) {
      const Eigen::Vector3d mean(static_cast<double>(mode.mean_m[0]), static_cast<double>(mode.mean_m[1]),
                                 static_cast<double>(mode.mean_m[2]));
      for (const Cluster& cluster : expected) {
        num_alike += mode.num_points == cluster.members.size() && (mean - cluster.mean_m).norm() < 2e-6 ? 1 : 0;
      }
    }
  }
  REQUIRE(num_modes > 50);
  // Densities are known to 0.7 %, so that some points whose neighbours are as dense choose another parent.
  constexpr double kLeastAlike = 0.9;
  INFO(num_alike << " of " << num_modes);
  REQUIRE(num_alike >= kLeastAlike * num_modes);
}

TEST_CASE("LeafModes: leaves with no point or one") {
  ClusteringSettings settings;
  REQUIRE(modes_of({}, settings).empty());
  const Cloud single = {point_at({-1234.0F, 567.0F, 8910.0F}, 0xffff)};
  REQUIRE(modes_of(single, settings).empty());
  settings.min_cluster_size = 1;
  REQUIRE(modes_of({}, settings).empty());
  const std::vector<Mode> modes = modes_of(single, settings);
  REQUIRE(modes.size() == 1);
  REQUIRE(modes[0].num_points == 1);
  REQUIRE(modes[0].mean_m[0] == Approx(-1.234));
  REQUIRE(modes[0].mean_m[1] == Approx(0.567));
  REQUIRE(modes[0].mean_m[2] == Approx(8.910));
  REQUIRE(modes[0].rgb[0] == 255);
  const double floor_m = static_cast<double>(settings.covariance_floor_m);
  REQUIRE((precision_of(modes[0]) - Eigen::Matrix3d::Identity() / (floor_m * floor_m)).norm() < 1.0);
}

TEST_CASE("LeafModes: points that coincide are one mode with the floor for a covariance") {
  ClusteringSettings settings;
  settings.covariance_floor_m = 0.01F;
  for (const std::size_t count : {8U, 17U, 1024U}) {
    const std::vector<Mode> modes = modes_of(Cloud(count, point_at({32767.0F, -32768.0F, 1.0F}, 31)), settings);
    REQUIRE(modes.size() == 1);
    REQUIRE(modes[0].num_points == count);
    REQUIRE(modes[0].mean_m[0] == Approx(32.767));
    REQUIRE(modes[0].rgb[0] == 0);
    REQUIRE(modes[0].rgb[2] == 255);
    REQUIRE((precision_of(modes[0]) - 1e4 * Eigen::Matrix3d::Identity()).norm() < 1.0);
  }
}

TEST_CASE("LeafModes: keeps the largest max_modes clusters, and none below min_cluster_size") {
  Random random = test::test_random();
  const Cloud cloud = blobs(random, 9, 5);  // of 5, 8, ... 29 points
  ClusteringSettings settings;
  settings.min_cluster_size = 12;
  std::vector<Mode> modes = modes_of(cloud, settings);
  REQUIRE(modes.size() == 6);
  REQUIRE(modes.back().num_points == 14);
  settings.max_modes = 4;
  modes = modes_of(cloud, settings);
  REQUIRE(modes.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) REQUIRE(modes[k].num_points == 29 - 3 * k);
  settings.min_cluster_size = 30;
  REQUIRE(modes_of(cloud, settings).empty());
}

TEST_CASE("LeafModes: the same whatever the number of threads") {
  std::string expected;
  for (const int num_threads : {1, 2, 4}) {
    Random random = test::test_random();
    std::vector<Cloud> clouds;
    for (int i = 0; i < 100; ++i) clouds.push_back(blobs(random, static_cast<int>(random.below(9)), 6));
    Leaves leaves(clouds, ClusteringSettings{}, num_threads);
    for (int repeat = 0; repeat < 3; ++repeat) leaves.update();
    const std::string bytes = test::checked_bytes([&](CheckedWriter& writer) { leaves.modes.save(writer); });
    if (num_threads == 1) expected = bytes;
    REQUIRE((bytes == expected));
  }
}

TEST_CASE("LeafModes: a mode whose numbers no points have is refused") {
  Random random = test::test_random();
  Leaves leaves({blobs(random, 1, 20)}, ClusteringSettings{});
  leaves.update();
  const Mode good = leaves.modes_of(0).at(0);
  const auto load = [&](const std::function<void(Mode&)>& spoil) {
    const LeafModesView view = leaves.modes.view();
    view.modes.at(0, 0) = good;
    spoil(view.modes.at(0, 0));
    const std::string bytes = test::checked_bytes([&](CheckedWriter& writer) { leaves.modes.save(writer); });
    LeafModes loaded(leaves.context, 1, ClusteringSettings{});
    test::read_checked(bytes, [&](CheckedReader& reader) { loaded.load(reader); });
  };
  REQUIRE_NOTHROW(load([](Mode&) {}));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  REQUIRE_THROWS_AS(load([](Mode& mode) { mode.mean_m[1] = kNaN; }), FileError);
  REQUIRE_THROWS_AS(load([](Mode& mode) { mode.mean_m[2] = 40.0F; }), FileError);
  REQUIRE_THROWS_AS(load([](Mode& mode) { mode.precision[1] = -kNaN; }), FileError);
  REQUIRE_THROWS_AS(load([](Mode& mode) { mode.precision[3] = 0.0F; }), FileError);
}

}  // namespace
}  // namespace foothold
