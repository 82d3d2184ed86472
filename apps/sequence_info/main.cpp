// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// sequence_info: what Foothold understands of a recording, before anything is made of it.
#include <cstdio>

#include "common/app_main.h"
#include "common/recording_options.h"
#include "contact_sheet.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/io/image_file.h"
#include "report.h"

namespace foothold::info {
namespace {

struct Options {
  std::string folder;
  SequenceOptions recording;
  bool remember = false;
  std::string picture_file;
  std::string json_file;
};

/// Writes what was given into the recording's folder, where every app finds it from then on.
void remember(const Options& options, const RecordingFacts& facts) {
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file_atomically(facts.folder + "/" + name, text + "\n");
    std::printf("wrote %s/%s\n", facts.folder.c_str(), name.c_str());
  };
  char text[128];
  std::snprintf(text, sizeof(text), "%.9g", options.recording.depth_units_per_m);
  if (options.recording.depth_units_per_m != 0.0) write("depth-scale.txt", text);
  if (!options.recording.pose_convention.empty()) write("pose-convention.txt", options.recording.pose_convention);
  const Intrinsics& k = facts.calibration.depth;
  std::snprintf(text, sizeof(text), "%.9g %.9g %.9g %.9g", static_cast<double>(k.fx), static_cast<double>(k.fy), static_cast<double>(k.cx),
                static_cast<double>(k.cy));
  if (!options.recording.intrinsics.empty() && facts.depth_distortion == "none") write("camera-intrinsics.txt", text);
  if (!options.recording.intrinsics.empty() && facts.depth_distortion != "none") {
    throw InvalidSettings(
        "--remember: got intrinsics with distortion, expected those without; put the file beside the recording as camera-intrinsics.txt");
  }
}

int run(const Options& options) {
  if (!options.picture_file.empty()) AtomicFile probe(options.picture_file);  // throws if the folder cannot be written to
  SequenceOptions as_told = options.recording;
  as_told.check = false;  // done below, once
  ContextOptions context_options;
  context_options.num_threads = 1;
  context_options.log = [sink = apps::log_to_stderr()](LogLevel level, const std::string& message) {
    if (level == LogLevel::kWarning) sink(level, message);  // the report says the rest
  };
  const Context context(context_options);
  const std::shared_ptr<const Recording> recording = open_recording(options.folder, context, as_told);
  const RecordingCheck check = check_recording(*recording);
  if (check.num_depth_frames == 0 && check.num_unreadable > 0) throw FileError(check.first_error);
  if (check.num_unreadable > 0) {
    context.log(LogLevel::kWarning, std::to_string(check.num_unreadable) + " of the " +
                                        std::to_string(check.num_unreadable + check.num_depth_frames) +
                                        " frames looked at cannot be read, the first of them " + check.first_error);
  }
  for (const std::string& warning : check.warnings) context.log(LogLevel::kWarning, warning);
  const Course course = course_of(recording->facts());
  std::printf("%s", text_report(*recording, course, check).c_str());
  if (options.remember) remember(options, recording->facts());
  if (!options.picture_file.empty()) write_png(options.picture_file, contact_sheet(*recording));
  if (!options.json_file.empty()) write_file_atomically(options.json_file, json_report(*recording, course, check));
  return apps::kSuccess;
}

}  // namespace
}  // namespace foothold::info

int main(int argc, char** argv) {
  using namespace foothold;
  apps::CommandLine app("Tells what Foothold understands of a recording: layout, frames, cameras, depth, poses, and what looks wrong.",
                        "sequence_info");
  info::Options options;
  app.add_option("folder", options.folder, "A recording's folder, or a .sens file").required().type_name("FOLDER");
  apps::add_recording_options(app, options.recording);
  app.add_flag("--remember", options.remember, "Write what these options say into the folder, where every app will find it");
  app.add_option("--picture", options.picture_file, "Draw a contact sheet of the recording: frames, depth, path").type_name("FILE.png");
  app.add_option("--json", options.json_file, "Write the same for programs").type_name("FILE");
  return apps::run_app(app, argc, argv, [&] { return info::run(options); });
}
