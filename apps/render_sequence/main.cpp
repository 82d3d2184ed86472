// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// render_sequence: writes a rendered room, or any other recording, as a folder in the layout of 7-Scenes or as one raw file.
#include <iostream>

#include "common/app_main.h"
#include "common/progress_bar.h"
#include "common/recording_options.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/frames/raw_sequence.h"
#include "foothold/io/sequence.h"
#include "foothold/io/sequence_player.h"
#include "foothold/io/seven_scenes_writer.h"
#include "foothold/synthetic/synthetic_sequence.h"

namespace foothold::apps {
namespace {

struct Options {
  std::string sequence;
  std::string out;
  int stride = 1;
  bool raw = false;
  int num_threads = 0;
  SequenceOptions recording;
};

/// What can be rendered and how, for --help.
std::string rooms_help() {
  std::string text = "Rooms:";
  for (const std::string& room : synthetic_room_names()) text += " " + room + ",";
  text += " and training-K for K = 0, 1, 2, ...\nSettings of synthetic:ROOM?setting=value&setting=value:\n";
  for (const SettingDescription& setting : describe_settings(SyntheticSequenceSettings{})) {
    if (setting.path != "room") text += "  " + setting.path + " = " + setting.value + ": " + setting.help + "\n";
  }
  return text;
}

/// Hands every chosen frame to a writer until the user has enough.
template <class Writer>
int write_frames(const std::shared_ptr<const Sequence>& sequence, const std::vector<int>& indices, Writer& writer) {
  SequencePlayer player(sequence, indices);
  RgbdFrame frame;
  {
    ProgressBar progress("writing", static_cast<std::int64_t>(indices.size()));
    while (!interrupted() && player.read(frame) == ReadStatus::kFrame) {
      writer.write(frame);
      progress.advance();
    }
  }
  if (writer.num_frames() > 0) writer.finish();
  return writer.num_frames();
}

int write_folder(const std::shared_ptr<const Sequence>& sequence, const std::vector<int>& indices, const std::string& folder) {
  SevenScenesWriter writer(folder);
  return write_frames(sequence, indices, writer);
}

int write_raw(const std::shared_ptr<const Sequence>& sequence, const std::vector<int>& indices, const std::string& path) {
  AtomicFile file(path);
  try {
    RawSequenceWriter writer(file.stream());
    const int num_frames = write_frames(sequence, indices, writer);
    if (num_frames > 0) file.commit();
    return num_frames;
  } catch (const FileError&) {
    file.check();  // which knows the file and the reason, where writing is what failed
    throw;
  }
}

int render(const Options& options) {
  ContextOptions context_options;
  context_options.num_threads = options.num_threads;
  context_options.log = log_to_stderr();
  const Context context(context_options);
  SequenceOptions sequence_options = options.recording;
  sequence_options.register_colour = options.raw;  // a folder is a copy; raw files are used as they are
  const std::shared_ptr<const Sequence> sequence = open_sequence(options.sequence, context, sequence_options);
  const std::vector<int> indices = frame_indices(*sequence, options.stride);
  const int num_frames = options.raw ? write_raw(sequence, indices, options.out) : write_folder(sequence, indices, options.out);
  std::cout << "wrote " << num_frames << " of " << indices.size() << " frames of " << sequence->name() << " to " << options.out << "\n";
  return interrupted() ? kInterrupted : kSuccess;
}

}  // namespace
}  // namespace foothold::apps

int main(int argc, char** argv) {
  using namespace foothold::apps;
  CommandLine app("Writes a rendered room, or any other recording, as a folder in the layout of 7-Scenes, or as one raw file.",
                  "render_sequence");
  Options options;
  app.add_option("--sequence", options.sequence, kRecordingHelp).required();
  app.add_option("--out", options.out, "Folder to write, which must not hold frames already; with --raw, a file")
      .required()
      .type_name("DIR");
  app.add_flag("--raw", options.raw, "Write one file without compression instead, for machines without an image library");
  app.add_option("--stride", options.stride, "Use every Nth frame").range(1, 1000000).show_default();
  add_recording_options(app, options.recording);
  app.add_option("--threads", options.num_threads, "Host threads; 0 for as many as the machine has").range(0, 1024).show_default();
  app.footer(rooms_help());
  return run_app(app, argc, argv, [&] { return render(options); });
}
