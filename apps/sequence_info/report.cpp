// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/json.h"
#include "common/log.h"
#include "foothold/base/trace.h"
#include "foothold/frames/register_colour.h"

namespace foothold::info {
namespace {

using apps::Json;

constexpr double kDegPerRad = 57.29577951308232;

/// printf() into a string.
template <class... Arguments>
std::string format(const char* pattern, Arguments... arguments) {
  char text[512];
  std::snprintf(text, sizeof(text), pattern, arguments...);
  return text;
}

std::string camera_text(const Intrinsics& k) {
  return format("%g %g %g %g", static_cast<double>(k.fx), static_cast<double>(k.fy), static_cast<double>(k.cx), static_cast<double>(k.cy));
}

double field_of_view_deg(double focal_px, int side_px) { return 2.0 * kDegPerRad * std::atan(0.5 * side_px / focal_px); }

void follow_times(const std::vector<double>& times_s, Course& course) {
  constexpr double kGapInIntervals = 3.0;
  if (times_s.size() < 2) return;
  course.duration_s = times_s.back() - times_s.front();
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < times_s.size(); ++i) intervals_s.push_back(times_s[i] - times_s[i - 1]);
  course.interval_s = quantile(intervals_s, 0.5);
  for (std::size_t i = 0; i < intervals_s.size(); ++i) {
    if (intervals_s[i] <= kGapInIntervals * course.interval_s) continue;
    ++course.num_gaps;
    if (intervals_s[i] <= course.longest_gap_s) continue;
    course.longest_gap_s = intervals_s[i];
    course.longest_gap_frame = static_cast<int>(i);
  }
}

void follow_poses(const std::vector<std::optional<SE3>>& poses, Course& course) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = -low;
  const SE3* last = nullptr;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!poses[i].has_value()) continue;
    ++course.num_with_pose;
    low = low.cwiseMin(poses[i]->translation);
    high = high.cwiseMax(poses[i]->translation);
    if (last != nullptr) {
      const auto step_m = static_cast<double>(translation_distance_m(*last, *poses[i]));
      course.path_m += step_m;
      if (step_m > course.longest_step_m) {
        course.longest_step_m = step_m;
        course.longest_step_frame = static_cast<int>(i);
      }
      course.longest_step_deg =
          std::max(course.longest_step_deg, kDegPerRad * static_cast<double>(rotation_distance_rad(*last, *poses[i])));
    }
    last = &*poses[i];
  }
  course.extent_m = course.num_with_pose > 0 ? (high - low).cast<double>().eval() : Eigen::Vector3d::Zero().eval();
}

std::string course_text(const Course& c) {
  std::string text = format("%.1f s, %.1f frames a second", c.duration_s, c.interval_s > 0.0 ? 1.0 / c.interval_s : 0.0);
  if (c.num_gaps == 0) return text + ", no gaps";
  return text + format(", %d gaps, the longest of %.2f s behind frame %d", c.num_gaps, c.longest_gap_s, c.longest_gap_frame);
}

std::string poses_text(const Recording& recording, const Course& c, const RecordingCheck& check) {
  if (c.num_with_pose == 0) return "none";
  std::string text =
      format("%d of %d frames, convention %s\n", c.num_with_pose, recording.num_frames(), recording.facts().pose_convention.c_str());
  text += format("              within %.2f x %.2f x %.2f m, path %.1f m, longest step %.0f mm (to frame %d), %.1f deg\n", c.extent_m.x(),
                 c.extent_m.y(), c.extent_m.z(), c.path_m, 1e3 * c.longest_step_m, c.longest_step_frame, c.longest_step_deg);
  text += check.num_pose_pairs == 0 ? "              no two frames to compare"
                                    : format("              %.0f %% of the depth agrees between frames some motion apart (%d pairs)",
                                             100.0 * check.pose_agreement, check.num_pose_pairs);
  const Eigen::Vector3d origin = recording.origin_m();
  if (!origin.isZero())
    text += format("\n              far from their origin: worked with relative to %.0f %.0f %.0f m", origin.x(), origin.y(), origin.z());
  return text;
}

std::string colour_text(const RecordingFacts& f) {
  std::string text = format("%dx%d", f.colour_width, f.colour_height);
  const bool same_size = f.colour_width == f.depth_width && f.colour_height == f.depth_height;
  if (same_size && is_registered(f.calibration)) return text + ", registered to depth";
  text += ", camera " + camera_text(f.calibration.colour);
  text += format(", %.1f mm beside that of depth: registered when read",
                 1e3 * static_cast<double>(f.calibration.depth_from_colour.translation.norm()));
  return f.colour_distortion == "none" ? text : text + "; distortion " + f.colour_distortion;
}

Json camera_json(const Intrinsics& k) { return {{"fx", k.fx}, {"fy", k.fy}, {"cx", k.cx}, {"cy", k.cy}}; }

Json depth_json(const RecordingFacts& f, const RecordingCheck& check) {
  return {{"width", f.depth_width},
          {"height", f.depth_height},
          {"units_per_m", f.depth_units_per_m},
          {"unit_source", f.depth_unit_source},
          {"valid_fraction", check.valid_fraction},
          {"median_m", check.median_depth_m},
          {"within_fraction", check.within_fraction}};
}

Json poses_json(const Recording& recording, const Course& course, const RecordingCheck& check) {
  const Eigen::Vector3d origin = recording.origin_m();
  return {{"frames", course.num_with_pose},
          {"convention", recording.facts().pose_convention},
          {"agreement", check.pose_agreement},
          {"better_convention", check.better_convention},
          {"better_depth_units_per_m", check.better_depth_units_per_m},
          {"path_m", course.path_m},
          {"longest_step_m", course.longest_step_m},
          {"longest_step_deg", course.longest_step_deg},
          {"origin_m", Json::array({origin.x(), origin.y(), origin.z()})}};
}

}  // namespace

Course course_of(const RecordingFacts& facts) {
  Course course;
  follow_times(facts.times_s, course);
  follow_poses(facts.world_from_camera, course);
  return course;
}

std::string text_report(const Recording& recording, const Course& course, const RecordingCheck& check) {
  const RecordingFacts& f = recording.facts();
  const Intrinsics& k = f.calibration.depth;
  std::string text =
      f.folder + "\n  layout      " + f.layout + ", " + std::to_string(recording.num_frames()) + " frames, " + course_text(course) + "\n";
  text +=
      format("  depth       %dx%d, in %s (%s)\n", f.depth_width, f.depth_height, depth_unit_text(f).c_str(), f.depth_unit_source.c_str());
  text += format("              %.0f %% of the pixels valid, median %.2f m, %.0f %% of it between %g and %g m (%d frames)\n",
                 100.0 * check.valid_fraction, check.median_depth_m, 100.0 * check.within_fraction, kLeastMedianDepth_m, kMostMedianDepth_m,
                 check.num_depth_frames);
  text += "  intrinsics  " + camera_text(k) + " (" + f.calibration_source + ")\n";
  text +=
      format("              field of view %.0f x %.0f deg; distortion %s\n", field_of_view_deg(static_cast<double>(k.fx), f.depth_width),
             field_of_view_deg(static_cast<double>(k.fy), f.depth_height), f.depth_distortion.c_str());
  text += "  colour      " + colour_text(f) + "\n";
  text += "  poses       " + poses_text(recording, course, check) + "\n";
  return text;
}

std::string json_report(const Recording& recording, const Course& course, const RecordingCheck& check) {
  const RecordingFacts& f = recording.facts();
  Json json = {{"format", "foothold-sequence-info"},
               {"format_version", 1},
               {"folder", f.folder},
               {"layout", f.layout},
               {"frames", recording.num_frames()},
               {"duration_s", course.duration_s},
               {"interval_s", course.interval_s},
               {"gaps", course.num_gaps},
               {"longest_gap_s", course.longest_gap_s}};
  json["depth"] = depth_json(f, check);
  json["intrinsics"] = camera_json(f.calibration.depth);
  json["intrinsics_source"] = f.calibration_source;
  json["distortion"] = f.depth_distortion;
  json["colour"] = {{"width", f.colour_width},
                    {"height", f.colour_height},
                    {"intrinsics", camera_json(f.calibration.colour)},
                    {"registered", is_registered(f.calibration)}};
  json["poses"] = poses_json(recording, course, check);
  json["warnings"] = apps::warnings();
  return json.dump() + "\n";
}

}  // namespace foothold::info
