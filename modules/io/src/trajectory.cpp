// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trajectory.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "foothold/base/atomic_file.h"
#include "foothold/base/number_text.h"
#include "text_file.h"

namespace foothold {
namespace io {
namespace {

constexpr std::array<const char*, 8> kColumns{"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};

void check_width(const TextLine& line, const std::filesystem::path& file) {
  if (line.words.size() == kColumns.size()) return;
  throw_file_error(file, std::to_string(line.words.size()) + " numbers in line " + std::to_string(line.number),
                   "8: timestamp tx ty tz qx qy qz qw");
}

TruePose parse_line(const TextLine& line, const std::filesystem::path& file) {
  check_width(line, file);
  const std::string where = "line " + std::to_string(line.number);
  const auto number = [&](std::size_t i) { return parse_number(line.words[i], file, std::string(kColumns[i]) + " in " + where); };
  std::array<double, 7> pose{};
  for (std::size_t i = 0; i < pose.size(); ++i) {
    pose[i] = is_not_finite(line.words[i + 1]) ? std::numeric_limits<double>::quiet_NaN() : number(i + 1);
  }
  return {number(0), pose_from_quaternion(pose, file, where)};
}

/// A sample that was not lost. @throws FileError if it was.
StampedPose parse_known_line(const TextLine& line, const std::filesystem::path& file) {
  const TruePose sample = parse_line(line, file);
  if (!sample.pose.has_value()) {
    for (std::size_t i = 1; i < kColumns.size(); ++i)
      parse_number(line.words[i], file, std::string(kColumns[i]) + " in line " + std::to_string(line.number));
    throw_file_error(file, "a quaternion of length 0 in line " + std::to_string(line.number), "length 1");
  }
  return {sample.timestamp_s, {sample.pose->rotation.cast<float>(), sample.pose->translation_m.cast<float>()}};
}

/// By rising time; of samples with equal times, the first.
template <class Sample>
void sort_by_time(std::vector<Sample>& samples) {
  const auto earlier = [](const Sample& a, const Sample& b) { return a.timestamp_s < b.timestamp_s; };
  const auto same_time = [](const Sample& a, const Sample& b) { return a.timestamp_s == b.timestamp_s; };
  std::stable_sort(samples.begin(), samples.end(), earlier);
  samples.erase(std::unique(samples.begin(), samples.end(), same_time), samples.end());
}

template <class Sample, class ParseLine>
std::vector<Sample> parse_samples(std::string_view text, const std::filesystem::path& file, ParseLine&& parse) {
  std::vector<Sample> samples;
  for (const TextLine& line : split_lines(text)) samples.push_back(parse(line, file));
  if (samples.empty()) throw_file_error(file, "no pose", "lines of timestamp tx ty tz qx qy qz qw");
  sort_by_time(samples);
  return samples;
}

RecordedPose blend(const RecordedPose& a, const RecordedPose& b, double t) {
  const Eigen::Quaterniond qa(a.rotation);
  const Eigen::Quaterniond qb(b.rotation);
  return {qa.slerp(t, qb).normalized().toRotationMatrix(), (1.0 - t) * a.translation_m + t * b.translation_m};
}

}  // namespace

std::vector<StampedPose> parse_trajectory(std::string_view text, const std::filesystem::path& file) {
  return parse_samples<StampedPose>(text, file, parse_known_line);
}

std::vector<TruePose> parse_ground_truth(std::string_view text, const std::filesystem::path& file) {
  return parse_samples<TruePose>(text, file, parse_line);
}

std::optional<RecordedPose> interpolate(const std::vector<TruePose>& trajectory, double timestamp_s, double max_gap_s) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), timestamp_s,
                                      [](const TruePose& sample, double time_s) { return sample.timestamp_s < time_s; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->timestamp_s == timestamp_s) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const auto before = after - 1;
  const double gap_s = after->timestamp_s - before->timestamp_s;
  if (gap_s > max_gap_s || !before->pose.has_value() || !after->pose.has_value()) return std::nullopt;
  return blend(*before->pose, *after->pose, (timestamp_s - before->timestamp_s) / gap_s);
}

}  // namespace io

std::vector<StampedPose> read_trajectory(const std::string& path) {
  return io::parse_trajectory(io::read_text(path, io::kMaxListFileBytes), path);
}

void write_trajectory(const std::string& path, const std::vector<StampedPose>& trajectory, const Eigen::Vector3d& origin_m) {
  AtomicFile file(path);
  const int digits = origin_m.isZero() ? 9 : 13;  // single precision, or as much of it far from the origin
  file.stream() << "# timestamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(pose.world_from_camera.rotation.cast<double>()).normalized();
    const Eigen::Vector3d t = pose.world_from_camera.translation.cast<double>() + origin_m;
    std::string line = fixed_text(pose.timestamp_s, 6);
    for (const double coordinate_m : {t.x(), t.y(), t.z()}) line += " " + general_text(coordinate_m, digits);
    for (const double value : {q.x(), q.y(), q.z(), q.w()}) line += " " + general_text(value, 9);
    file.stream() << line + "\n";
  }
  file.commit();
}

}  // namespace foothold
