// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// train_forest: trains the branches of a forest offline, makes data-free ones, and tells where a forest comes from.
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include "common/app_main.h"
#include "common/override_settings.h"
#include "common/progress_bar.h"
#include "common/recording_options.h"
#include "foothold/base/error.h"
#include "foothold/base/printable.h"
#include "foothold/io/sequence.h"
#include "foothold/learning/forest_training.h"

namespace foothold::apps {
namespace {

struct Options {
  std::vector<std::string> sequences;
  std::string out;
  std::map<std::string, std::string> settings;  // path and value of the options that are settings
  std::string settings_file;
  std::vector<std::string> assignments;
  std::vector<std::string> notes;
  bool resume = false;
  int num_threads = 0;
  SequenceOptions recording;
  std::string forest_file;
};

/// Options for the settings that people change most; --set knows them all.
constexpr struct {
  const char* option;
  const char* setting;
} kShortcuts[] = {
    {"--trees", "num_trees"},
    {"--depth", "depth"},
    {"--candidates", "num_candidates"},
    {"--examples-per-frame", "examples_per_frame"},
    {"--stride", "frame_stride"},
    {"--memory-limit", "memory_limit_gb"},
    {"--seed", "seed"},
};

template <class Settings>
std::string settings_help() {
  std::string text = "Settings of --set, with their defaults:\n";
  for (const SettingDescription& setting : describe_settings(Settings{})) {
    text += "  " + setting.path + " = " + setting.value + ", in " + setting.range + ": " + setting.help + "\n";
  }
  return text;
}

/// The defaults, overridden by the settings file, by --set, and by options with names of their own, in this order. @throws InvalidSettings,
/// FileError
template <class Settings>
Settings settings_of(const Options& options) {
  Settings settings;
  apps::override_settings(options.settings_file, options.assignments, "setting=value, such as depth=13", settings);
  for (const auto& [path, text] : options.settings) {
    if (!text.empty()) assign_setting(settings, path, text);
  }
  return settings;
}

void print_summary(const Forest& forest, std::ostream& stream) {
  char fingerprint[17];
  std::snprintf(fingerprint, sizeof(fingerprint), "%016llx", static_cast<unsigned long long>(forest.fingerprint()));
  stream << forest.num_trees() << " trees, " << forest.num_leaves() << " leaves, " << forest.features().size() << " features, depth "
         << forest.depth() << ", fingerprint " << fingerprint << "\n";
}

/// Shows both stages of a training and asks it to stop on Ctrl-C.
class ProgressDisplay {
 public:
  bool operator()(const ForestTrainingProgress& progress) {
    if (!bar_ || stage_ != progress.stage) {
      bar_.reset();
      const bool examples = progress.stage == ForestTrainingProgress::Stage::kExamples;
      bar_ = std::make_unique<ProgressBar>(examples ? "reading frames" : "growing trees", progress.total);
      stage_ = progress.stage;
    }
    bar_->set(progress.done);
    return !interrupted();
  }

 private:
  std::unique_ptr<ProgressBar> bar_;
  ForestTrainingProgress::Stage stage_ = ForestTrainingProgress::Stage::kExamples;
};

int train(const Options& options) {
  if (options.sequences.empty()) throw InvalidSettings("--sequence: none given, expected at least one recording to train with");
  if (options.out.empty()) throw InvalidSettings("--out: not given, expected the file to write the forest to");
  const auto settings = settings_of<ForestTrainingSettings>(options);
  settings.validate();
  DeviceOptions device;
  device.num_threads = options.num_threads;
  const Context context = make_context(device);
  std::vector<std::shared_ptr<const Sequence>> sequences;
  for (const std::string& spec : options.sequences) sequences.push_back(open_sequence(spec, context, options.recording));

  ForestTrainingRun run;
  run.checkpoint = options.out + ".checkpoint";
  run.resume = options.resume;
  run.notes = options.notes;
  std::optional<Forest> forest;
  {
    ProgressDisplay display;
    run.progress = [&](const ForestTrainingProgress& progress) { return display(progress); };
    forest = train_forest(context, sequences, settings, run);
  }
  if (!forest) {
    std::cerr << "interrupted; the same command with --resume goes on from " << run.checkpoint << "\n";
    return kInterrupted;
  }
  save_forest(options.out, *forest);
  std::remove(run.checkpoint.c_str());
  std::cout << "wrote " << options.out << ": ";
  print_summary(*forest, std::cout);
  return kSuccess;
}

int make_random(const Options& options) {
  const Forest forest = make_random_forest(settings_of<RandomForestSettings>(options));
  save_forest(options.out, forest);
  std::cout << "wrote " << options.out << ": ";
  print_summary(forest, std::cout);
  return kSuccess;
}

constexpr std::size_t kMaxInfoLine = 1000;

int show_info(const Options& options) {
  const Forest forest = load_forest(options.forest_file);
  print_summary(forest, std::cout);
  std::istringstream lines(forest.provenance());  // written by whoever made the file
  for (std::string line; std::getline(lines, line);) std::cout << printable(line, kMaxInfoLine) << "\n";
  return kSuccess;
}

}  // namespace
}  // namespace foothold::apps

int main(int argc, char** argv) {
  using namespace foothold;
  using namespace foothold::apps;
  CommandLine app("Trains the branches of a forest on recordings with known poses.", "train_forest");
  Options options;
  app.add_option(
         "--sequence", options.sequences,
         "A recording to train with, a scene of its own: a folder or synthetic:ROOM?setting=value&..., with @A:B for a part; repeatable")
      .repeatable();
  app.add_option("--out", options.out, "File to write the forest to").type_name("FILE");
  for (const auto& shortcut : kShortcuts)
    app.add_option(shortcut.option, options.settings[shortcut.setting], std::string("Setting ") + shortcut.setting).type_name("N");
  app.add_option("--settings", options.settings_file, "JSON file of settings").type_name("FILE");
  app.add_option("--set", options.assignments, "One setting as setting=value; repeatable").repeatable();
  app.add_option("--note", options.notes, "A line to add to what `info` prints, such as 'commit = abc'; repeatable").repeatable();
  add_recording_options(app, options.recording);
  app.add_option("--threads", options.num_threads, "Threads; 0 for as many as the machine has. The forest does not depend on it")
      .range(0, 1024)
      .show_default();
  app.add_flag("--resume", options.resume, "Go on with the interrupted training whose checkpoint lies beside --out, if there is one");
  app.footer(settings_help<ForestTrainingSettings>());
  app.require_subcommands(0, 1);

  CommandLine random = app.add_subcommand("random", "Writes a data-free forest: complete trees of random splits");
  random.add_option("--out", options.out, "File to write the forest to").required().type_name("FILE");
  random.add_option("--seed", options.settings["seed"], "Setting seed").type_name("N");
  random.add_option("--settings", options.settings_file, "JSON file of settings").type_name("FILE");
  random.add_option("--set", options.assignments, "One setting as setting=value; repeatable").repeatable();
  random.footer(settings_help<RandomForestSettings>());

  CommandLine info = app.add_subcommand("info", "Tells what a forest file holds and where it comes from");
  info.add_option("file", options.forest_file, "A forest").required().type_name("FILE");

  return run_app(app, argc, argv, [&] {
    if (random.parsed()) return make_random(options);
    return info.parsed() ? show_info(options) : train(options);
  });
}
