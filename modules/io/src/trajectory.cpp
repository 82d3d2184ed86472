// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trajectory.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "foothold/base/atomic_file.h"
#include "foothold/base/number_text.h"
#include "text_file.h"

namespace foothold {
namespace io {
namespace {

StampedPose parse_line(const TextLine& line, const std::filesystem::path& file) {
  constexpr std::size_t kNumColumns = 8;
  constexpr std::array<const char*, kNumColumns> kColumns{"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  constexpr double kLengthTolerance = 1e-2;
  const std::string where = "line " + std::to_string(line.number);
  if (line.words.size() != kNumColumns) {
    throw_file_error(file, std::to_string(line.words.size()) + " numbers in " + where, "8: timestamp tx ty tz qx qy qz qw");
  }
  std::array<double, kNumColumns> x{};
  for (std::size_t i = 0; i < kNumColumns; ++i) x[i] = parse_number(line.words[i], file, std::string(kColumns[i]) + " in " + where);
  const Eigen::Quaterniond rotation(x[7], x[4], x[5], x[6]);
  if (!(std::abs(rotation.norm() - 1.0) <= kLengthTolerance)) {
    throw_file_error(file, "a quaternion of length " + std::to_string(rotation.norm()) + " in " + where, "length 1");
  }
  const Eigen::Vector3d translation(x[1], x[2], x[3]);
  constexpr double kMaxDistance_m = 1e6;
  if (translation.cwiseAbs().maxCoeff() > kMaxDistance_m) throw_file_error(file, "a position beyond 1e6 m in " + where, "metres");
  return {x[0], {rotation.normalized().toRotationMatrix().cast<float>(), translation.cast<float>()}};
}

SE3 blend(const SE3& a, const SE3& b, double t) {
  const Eigen::Quaterniond qa(a.rotation.cast<double>());
  const Eigen::Quaterniond qb(b.rotation.cast<double>());
  const Eigen::Vector3d translation = (1.0 - t) * a.translation.cast<double>() + t * b.translation.cast<double>();
  return {qa.slerp(t, qb).normalized().toRotationMatrix().cast<float>(), translation.cast<float>()};
}

}  // namespace

std::vector<StampedPose> parse_trajectory(std::string_view text, const std::filesystem::path& file) {
  std::vector<StampedPose> trajectory;
  for (const TextLine& line : split_lines(text)) trajectory.push_back(parse_line(line, file));
  if (trajectory.empty()) throw_file_error(file, "no pose", "lines of timestamp tx ty tz qx qy qz qw");
  const auto earlier = [](const StampedPose& a, const StampedPose& b) { return a.timestamp_s < b.timestamp_s; };
  const auto same_time = [](const StampedPose& a, const StampedPose& b) { return a.timestamp_s == b.timestamp_s; };
  std::stable_sort(trajectory.begin(), trajectory.end(), earlier);
  trajectory.erase(std::unique(trajectory.begin(), trajectory.end(), same_time), trajectory.end());
  return trajectory;
}

std::optional<SE3> interpolate(const std::vector<StampedPose>& trajectory, double timestamp_s, double max_gap_s) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), timestamp_s,
                                      [](const StampedPose& pose, double time_s) { return pose.timestamp_s < time_s; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->timestamp_s == timestamp_s) return after->world_from_camera;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = after - 1;
  const double gap_s = after->timestamp_s - before->timestamp_s;
  if (gap_s > max_gap_s) return std::nullopt;
  return blend(before->world_from_camera, after->world_from_camera, (timestamp_s - before->timestamp_s) / gap_s);
}

}  // namespace io

std::vector<StampedPose> read_trajectory(const std::string& path) {
  return io::parse_trajectory(io::read_file(path, io::kMaxListFileBytes), path);
}

void write_trajectory(const std::string& path, const std::vector<StampedPose>& trajectory) {
  AtomicFile file(path);
  file.stream() << "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.world_from_camera.rotation.cast<double>()).normalized();
    const Eigen::Vector3f& t = pose.world_from_camera.translation;
    std::string line = fixed_text(pose.timestamp_s, 6);
    for (const double value : {double{t.x()}, double{t.y()}, double{t.z()}, q.x(), q.y(), q.z(), q.w()})
      line += " " + general_text(value, 9);
    file.stream() << line + "\n";
  }
  file.commit();
}

}  // namespace foothold
