// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/trajectory.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "foothold/base/angle.h"
#include "foothold/base/contract.h"
#include "foothold/base/random.h"
#include "view_check.h"

namespace foothold {
namespace {

using namespace synthetic_detail;
using Eigen::Vector3f;

constexpr double kPi = 3.14159265358979323846;

// The training path: loops around the middle of the eye box, a control point every 45 degrees. (T) by the motion of 7-Scenes: about
// 0.3 m/s and 20 deg/s.
constexpr int kNumLoops = 3;
constexpr int kPointsPerLoop = 8;
constexpr int kNumPoints = kNumLoops * kPointsPerLoop;
constexpr double kPointInterval_s = 1.8;
constexpr float kLargestTurn_rad = 70.0F * kRadPerDeg;  // between the viewing directions of neighbouring control points
constexpr float kLowestGaze = -0.75F;                   // z of the viewing direction
constexpr float kHighestGaze = 0.35F;

// The test path beside it. Control points; the spline smooths them to about two thirds.
constexpr int kNumOffsets = 29;
constexpr double kOffsetInterval_s = 1.6;
constexpr float kSmallestOffset_m = 0.25F;
constexpr float kLargestOffset_m = 1.0F;
constexpr float kLargestYaw_rad = 45.0F * kRadPerDeg;
constexpr float kLargestPitch_rad = 18.0F * kRadPerDeg;
constexpr float kLargestRoll_rad = 18.0F * kRadPerDeg;
constexpr float kSmallestOverlap = 0.5F;  // share of a test view that lies in training views of the last seconds
constexpr double kOverlapWindow_s = 8.0;
constexpr float kShrink = 0.93F;  // of offsets that lead too near to something

constexpr float kSlowestBlend = 0.7F;  // length of blended unit directions; shorter ones turn fast
constexpr int kReach = 3;              // control points to either side whose surroundings a redrawn one changes
constexpr int kMostRepairs = 60;
constexpr double kCheckInterval_s = 0.2;

/// A periodic uniform cubic B-spline with control points at multiples of an interval.
Vector3f spline(const std::vector<Vector3f>& points, double time_s, double interval_s) {
  const double position = time_s / interval_s;
  const double cell = std::floor(position);
  const auto f = static_cast<float>(position - cell);
  const auto n = static_cast<long long>(points.size());
  const auto point = [&](long long k) -> const Vector3f& {
    return points[static_cast<std::size_t>(((static_cast<long long>(cell) + k) % n + n) % n)];
  };
  const float g = 1.0F - f;
  return (g * g * g * point(-1) + (3.0F * f * f * f - 6.0F * f * f + 4.0F) * point(0) +
          (3.0F * g * g * g - 6.0F * g * g + 4.0F) * point(1) + f * f * f * point(2)) /
         6.0F;
}

/// The trembling of a hand in six degrees of freedom, each a sum of sines.
std::array<float, 6> tremor(double time_s, std::uint64_t seed) {
  constexpr float kShift_m = 0.0025F;
  constexpr float kTurn_rad = 0.2F * kRadPerDeg;
  Random random(seed, 11);
  std::array<float, 6> result{};
  for (std::size_t axis = 0; axis < result.size(); ++axis) {
    for (int wave = 0; wave < 3; ++wave) {
      const double frequency_hz = 0.6 + 0.7 * wave + 0.3 * static_cast<double>(random.uniform());
      const double phase = 2.0 * kPi * static_cast<double>(random.uniform());
      result[axis] += (axis < 3 ? kShift_m : kTurn_rad) / static_cast<float>(wave + 1) *
                      static_cast<float>(std::sin(2.0 * kPi * frequency_hz * time_s + phase));
    }
  }
  return result;
}

/// The upright camera that looks along a direction.
Eigen::Matrix3f looking_along(const Vector3f& direction_world) {
  const Vector3f forward = direction_world.normalized();
  const Vector3f right = forward.cross(Vector3f::UnitZ()).normalized();
  Eigen::Matrix3f world_from_camera;
  world_from_camera << right, forward.cross(right), forward;
  return world_from_camera;
}

Eigen::Matrix3f turned_by(const Vector3f& yaw_pitch_roll) {
  return (Eigen::AngleAxisf(yaw_pitch_roll.x(), Vector3f::UnitY()) * Eigen::AngleAxisf(yaw_pitch_roll.y(), Vector3f::UnitX()) *
          Eigen::AngleAxisf(yaw_pitch_roll.z(), Vector3f::UnitZ()))
      .toRotationMatrix();
}

/// The test path runs at a varying pace that never overtakes the training path.
double training_time_s(double test_time_s) { return 0.6 + 0.88 * test_time_s + 0.6 * std::sin(0.37 * test_time_s); }

Vector3f draw_in_box(Random& random, const Vector3f& half) {
  const float x = random.uniform(-half.x(), half.x());
  const float y = random.uniform(-half.y(), half.y());
  return {x, y, random.uniform(-half.z(), half.z())};
}

}  // namespace

/// Draws and redraws control points.
struct Trajectory::Path {
  const Room& room;
  Random random;

  Vector3f draw_eye(int k) {
    const Vector3f middle = 0.5F * (room.eye_low_world + room.eye_high_world);
    const Vector3f half = 0.5F * (room.eye_high_world - room.eye_low_world);
    const float angle =
        static_cast<float>(2.0 * kPi) * (static_cast<float>(k) + random.uniform(-0.35F, 0.35F)) / static_cast<float>(kPointsPerLoop);
    const float radius = random.uniform(0.5F, 1.15F);
    return middle + half.cwiseProduct(Vector3f{radius * std::cos(angle), radius * std::sin(angle), random.uniform(-1.2F, 1.2F)});
  }

  /// Looks at a target that needs no large turn from where the camera looked before.
  Vector3f draw_direction(const Vector3f& eye_world, const Vector3f& before_world) {
    constexpr int kNumDraws = 24;
    Vector3f best = before_world;
    float best_turn = static_cast<float>(kPi);
    for (int i = 0; i < kNumDraws; ++i) {
      const std::size_t target = random.below(static_cast<std::uint32_t>(room.targets_world.size()));
      Vector3f direction = room.targets_world[target] + draw_in_box(random, Vector3f::Constant(0.25F)) - eye_world;
      direction.normalize();
      direction.z() = std::clamp(direction.z(), kLowestGaze, kHighestGaze);
      direction.normalize();
      const float turn = std::acos(std::clamp(direction.dot(before_world), -1.0F, 1.0F));
      if (turn < best_turn) {
        best = direction;
        best_turn = turn;
      }
      if (turn < kLargestTurn_rad) return direction;
    }
    return best;
  }

  void draw(Trajectory& t, int k) {
    t.eyes_world_[static_cast<std::size_t>(k)] = draw_eye(k);
    draw_gaze(t, k);
  }
  void draw_gaze(Trajectory& t, int k) {
    const auto i = static_cast<std::size_t>(k);
    const Vector3f& before = t.directions_world_[(i + kNumPoints - 1) % kNumPoints];
    t.directions_world_[i] = draw_direction(t.eyes_world_[i], before);
  }

  void draw_offset(Trajectory& t, int k) {
    Vector3f direction = draw_in_box(random, {1.0F, 1.0F, 0.35F});
    direction.normalize();
    t.eye_offsets_world_[static_cast<std::size_t>(k)] = direction * random.uniform(kSmallestOffset_m, kLargestOffset_m);
    t.turns_rad_[static_cast<std::size_t>(k)] = draw_in_box(random, {kLargestYaw_rad, kLargestPitch_rad, kLargestRoll_rad});
  }

  /// True if the training path comes too close to something, or turns too fast, within half an interval of a control point.
  bool is_faulty(const Trajectory& t, int k) const {
    return any_time_near(k, kPointInterval_s, [&](double time_s) {
      const SE3 world_from_camera = t.world_from_camera(time_s);
      const bool swings = spline(t.directions_world_, time_s, kPointInterval_s).norm() < kSlowestBlend;
      return swings || !is_good_view(room, world_from_camera, sample_view(room, world_from_camera));
    });
  }

  /// True if the test path comes too close to something, or sees too little of what training saw.
  bool is_offset_faulty(const Trajectory& t, const Trajectory& train, int k) const {
    return any_time_near(k, kOffsetInterval_s, [&](double time_s) {
      const SE3 world_from_camera = t.world_from_camera(time_s);
      const std::vector<Vector3f> points_camera = sample_view(room, world_from_camera);
      return !is_good_view(room, world_from_camera, points_camera) ||
             share_in_view(world_from_camera, points_camera, training_poses(train, time_s)) < kSmallestOverlap;
    });
  }

  /// Training poses of the seconds before a time, and of the beginning.
  static std::vector<SE3> training_poses(const Trajectory& train, double time_s) {
    std::vector<SE3> poses;
    const double last_s = std::max(time_s, kOverlapWindow_s);
    for (double before_s = 0.0; before_s < kOverlapWindow_s; before_s += 0.5) poses.push_back(train.world_from_camera(last_s - before_s));
    return poses;
  }

  template <class Condition>
  static bool any_time_near(int k, double interval_s, const Condition& condition) {
    for (double offset_s = -0.5 * interval_s; offset_s < 0.5 * interval_s; offset_s += kCheckInterval_s) {
      if (condition(std::max(0.0, k * interval_s + offset_s))) return true;
    }
    return false;
  }

  /// Redraws faulty control points, looking again only where that changed the path, until none is left or patience ends.
  template <class IsFaulty, class Redraw>
  static void repair(int num_points, const IsFaulty& faulty, const Redraw& redraw) {
    std::vector<int> suspects(static_cast<std::size_t>(num_points));
    std::iota(suspects.begin(), suspects.end(), 0);
    for (int round = 0; round < kMostRepairs && !suspects.empty(); ++round) {
      std::set<int> touched;
      for (const int k : suspects) {
        if (!faulty(k)) continue;
        redraw(k, round);
        for (int near = -kReach; near <= kReach; ++near) touched.insert((k + near + num_points) % num_points);
      }
      suspects.assign(touched.begin(), touched.end());
    }
  }

  void make_training_path(Trajectory& t) {
    t.eyes_world_.resize(kNumPoints);
    t.directions_world_.assign(kNumPoints, Vector3f::UnitX());
    t.directions_world_.back() = (room.targets_world.front() - 0.5F * (room.eye_low_world + room.eye_high_world)).normalized();
    for (int k = 0; k < kNumPoints; ++k) draw(t, k);
    repair(
        kNumPoints, [&](int k) { return is_faulty(t, k); },
        [&](int k, int) {
          draw(t, k);
          draw_gaze(t, (k + 1) % kNumPoints);
        });
  }

  void make_test_path(Trajectory& t, const Trajectory& train) {
    t.eye_offsets_world_.resize(kNumOffsets);
    t.turns_rad_.resize(kNumOffsets);
    for (int k = 0; k < kNumOffsets; ++k) draw_offset(t, k);
    repair(
        kNumOffsets, [&](int k) { return is_offset_faulty(t, train, k); },
        [&](int k, int round) {
          const float scale = std::pow(kShrink, static_cast<float>(round));
          draw_offset(t, k);
          t.eye_offsets_world_[static_cast<std::size_t>(k)] *= scale;
          t.turns_rad_[static_cast<std::size_t>(k)] *= scale;
        });
  }
};

Trajectory::Trajectory(const Room& room, TrajectoryKind kind, std::uint64_t seed)
    : kind_(TrajectoryKind::kTrain), seed_(derive_seed(seed, 0)) {
  FOOTHOLD_EXPECTS(!room.targets_world.empty());
  Path{room, Random(room.seed, 1)}.make_training_path(*this);
  if (kind == TrajectoryKind::kTrain) return;
  const Trajectory train = *this;
  kind_ = kind;
  seed_ = derive_seed(seed, 1);
  Path{room, Random(room.seed, 2)}.make_test_path(*this, train);
}

SE3 Trajectory::world_from_camera(double time_s) const {
  const bool test = kind_ == TrajectoryKind::kTest;
  const double path_time_s = test ? training_time_s(time_s) : time_s;
  Vector3f eye = spline(eyes_world_, path_time_s, kPointInterval_s);
  Eigen::Matrix3f rotation = looking_along(spline(directions_world_, path_time_s, kPointInterval_s));
  if (test) {
    eye += spline(eye_offsets_world_, time_s, kOffsetInterval_s);
    rotation = rotation * turned_by(spline(turns_rad_, time_s, kOffsetInterval_s));
  }
  const std::array<float, 6> hand = tremor(time_s, seed_);
  rotation = rotation * turned_by({hand[3], hand[4], hand[5] + 3.0F * kRadPerDeg * static_cast<float>(std::sin(0.9 * time_s))});
  return {nearest_rotation(rotation), eye + Vector3f(hand[0], hand[1], hand[2])};
}

}  // namespace foothold
