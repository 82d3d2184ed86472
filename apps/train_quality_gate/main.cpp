// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// train_quality_gate: trains the classifiers that grade tracking and accept relocalised poses, from recordings with known poses.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "common/app_main.h"
#include "common/json.h"
#include "common/override_settings.h"
#include "common/progress_bar.h"
#include "common/recording_options.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/io/image_file.h"
#include "foothold/io/sequence.h"
#include "foothold/learning/classifier_training.h"
#include "foothold/learning/quality_examples.h"
#include "roc_plot.h"

namespace foothold::apps {
namespace {

/// What the gate says is followed by other checks, so it may err; what acceptance says is final.
struct GateSettings {
  QualityExampleSettings examples;
  ClassifierTrainingSettings tracking = {1.0F, 0.1F, 0.002F, 20000};
  ClassifierTrainingSettings acceptance = {1.0F, 0.01F, 0.002F, 20000};
  FusionSettings fusion;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&GateSettings::examples, "examples");
    v(&GateSettings::tracking, "tracking");
    v(&GateSettings::acceptance, "acceptance");
    v(&GateSettings::fusion, "fusion");
  }
};

struct Options {
  std::vector<std::string> sequences;
  std::vector<std::string> views;
  std::vector<std::string> test_sequences;
  std::vector<std::string> test_views;
  std::string out_folder = ".";
  bool save_examples = false;
  std::vector<std::string> examples_folders;
  std::string settings_file;
  std::vector<std::string> assignments;
  DeviceOptions device;
  SequenceOptions recording;
};

GateSettings settings_of(const Options& options) {
  GateSettings settings;
  apps::override_settings(options.settings_file, options.assignments, "setting=value", settings);
  return settings;
}

/// Collects the examples of several recordings, one group each; each is also tried with frames of the next. Empty if interrupted.
QualityExamples collect(const Context& context, const SequenceOptions& options, const std::vector<std::string>& specs,
                        const std::vector<std::string>& views, const GateSettings& settings) {
  if (!views.empty() && views.size() != specs.size()) {
    throw InvalidSettings("--views: got " + std::to_string(views.size()) + ", expected one for each of the " +
                          std::to_string(specs.size()) + " recordings, or none");
  }
  std::vector<std::shared_ptr<Sequence>> mapped;
  for (const std::string& spec : specs) mapped.push_back(open_sequence(spec, context, options));
  QualityExamples examples;
  for (std::size_t i = 0; i < specs.size() && !interrupted(); ++i) {
    const std::shared_ptr<Sequence> other_views = views.empty() ? nullptr : open_sequence(views[i], context, options);
    const Sequence* const foreign = specs.size() > 1 ? mapped[(i + 1) % specs.size()].get() : nullptr;
    const QualityRecording recording{mapped[i].get(), other_views.get(), foreign, static_cast<int>(i)};
    ProgressBar bar(specs[i], num_example_frames(recording, settings.examples));
    collect_quality_examples(context, recording, settings.fusion, settings.examples, examples, [&](int done) {
      bar.set(done);
      return !interrupted();
    });
  }
  return examples;
}

Json to_json(const ClassifierReport& report) {
  Json roc = Json::array();
  for (const RocPoint& point : report.roc) roc.push_back(Json::array({point.false_positive_rate, point.true_positive_rate}));
  return {{"num_positive", report.num_positive},
          {"num_negative", report.num_negative},
          {"auc", report.auc},
          {"good", {{"true_positive_rate", report.true_positive_rate_good}, {"false_positive_rate", report.false_positive_rate_good}}},
          {"poor", {{"false_negative_rate", report.false_negative_rate_poor}, {"true_negative_rate", report.true_negative_rate_poor}}},
          {"roc", roc}};
}

/// How a trained classifier does on recordings that it was not trained on.
ClassifierReport test_classifier(const ClassifierModel& model, const std::vector<ClassifierExample>& examples) {
  ClassifierReport report;
  std::vector<float> scores;
  std::vector<std::uint8_t> positive;
  double above_good[2] = {};
  double above_poor[2] = {};
  for (const ClassifierExample& example : examples) {
    scores.push_back(model.score(example.values));
    positive.push_back(example.positive ? 1 : 0);
    (example.positive ? report.num_positive : report.num_negative) += 1;
    above_good[positive.back()] += scores.back() > model.good_threshold ? 1.0 : 0.0;
    above_poor[positive.back()] += scores.back() > model.poor_threshold ? 1.0 : 0.0;
  }
  report.roc = receiver_operating_characteristic(scores, positive, &report.auc);
  report.true_positive_rate_good = above_good[1] / std::max(1, report.num_positive);
  report.false_positive_rate_good = above_good[0] / std::max(1, report.num_negative);
  report.false_negative_rate_poor = 1.0 - above_poor[1] / std::max(1, report.num_positive);
  report.true_negative_rate_poor = 1.0 - above_poor[0] / std::max(1, report.num_negative);
  return report;
}

std::string csv_header(const std::vector<std::string>& features) {
  std::string header = "recording,right,distance_m,angle_deg";
  for (const std::string& feature : features) header += "," + feature;
  return header;
}

/// Every example as a line, for those who want to look.
std::string to_csv(const std::vector<std::string>& features, const std::vector<ClassifierExample>& examples) {
  std::ostringstream text;
  text.precision(9);
  text << csv_header(features);
  for (const ClassifierExample& example : examples) {
    text << '\n' << example.group << ',' << (example.positive ? 1 : 0) << ',' << example.distance_m << ',' << example.angle_deg;
    for (const float value : example.values) text << ',' << value;
  }
  text << '\n';
  return text.str();
}

/// Reads what to_csv() wrote. @throws FileError
std::vector<ClassifierExample> read_csv(const std::filesystem::path& path, const std::vector<std::string>& features) {
  std::ifstream stream(path);
  std::string line;
  if (!std::getline(stream, line) || line != csv_header(features)) {
    throw FileError(path.string() + ": got '" + line.substr(0, 80) + "', expected the line '" + csv_header(features) + "'");
  }
  std::vector<ClassifierExample> examples;
  while (std::getline(stream, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    ClassifierExample example;
    example.values.resize(features.size());
    words >> example.group >> example.positive >> example.distance_m >> example.angle_deg;
    for (float& value : example.values) words >> value;
    if (!words)
      throw FileError(path.string() + ": got '" + line.substr(0, 80) + "', expected " + std::to_string(features.size() + 4) + " numbers");
    examples.push_back(example);
  }
  return examples;
}

std::vector<std::string> read_lines(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) throw FileError(path.string() + ": cannot be read, expected what --save-examples wrote");
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void print_report(const std::string& title, const ClassifierReport& report) {
  std::printf(
      "%-34s %6d right %6d wrong  AUC %.4f  good: %5.1f %% of right, %5.2f %% of wrong  poor or good: %5.1f %% of right, %5.1f %% of "
      "wrong\n",
      title.c_str(), report.num_positive, report.num_negative, report.auc, 100.0 * report.true_positive_rate_good,
      100.0 * report.false_positive_rate_good, 100.0 * (1.0 - report.false_negative_rate_poor),
      100.0 * (1.0 - report.true_negative_rate_poor));
}

std::vector<std::string> provenance(const Options& options, const GateSettings& settings) {
  std::vector<std::string> lines = {"trained by train_quality_gate of Foothold 0.1.0 on:"};
  lines.insert(lines.end(), options.sequences.begin(), options.sequences.end());
  lines.insert(lines.end(), options.views.begin(), options.views.end());
  const std::vector<SettingDescription> defaults = describe_settings(GateSettings{});
  const std::vector<SettingDescription> used = describe_settings(settings);
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i].value != defaults[i].value) lines.push_back("setting " + used[i].path + " = " + used[i].value);
  }
  return lines;
}

/// A classifier and what it learns from.
struct Task {
  std::string name;
  std::vector<std::string> features;
  ClassifierTrainingSettings settings;
  std::vector<ClassifierExample> examples;
  std::vector<ClassifierExample> unseen;
};

std::vector<Task> list_tasks(const GateSettings& settings) {
  const auto tracking = quality_feature_names();
  const auto acceptance = acceptance_feature_names();
  return {{"tracking_quality", {tracking.begin(), tracking.end()}, settings.tracking, {}, {}},
          {"pose_acceptance", {acceptance.begin(), acceptance.end()}, settings.acceptance, {}, {}}};
}

/// Appends examples to others, as of further recordings.
void append_groups(std::vector<ClassifierExample>& all, std::vector<ClassifierExample> more, int first_group) {
  for (ClassifierExample& example : more) {
    example.group += first_group;
    all.push_back(std::move(example));
  }
}

/// Reads what --save-examples wrote into several folders. @throws FileError
void load_examples(const std::vector<std::string>& folders, std::vector<Task>& tasks, std::vector<std::string>& origin) {
  constexpr int kMostGroups = 10000;  // of a folder
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::filesystem::path folder(folders[i]);
    const int first_group = static_cast<int>(i) * kMostGroups;
    for (Task& task : tasks) {
      append_groups(task.examples, read_csv(folder / (task.name + ".csv"), task.features), first_group);
      const std::filesystem::path unseen = folder / (task.name + "_test.csv");
      if (std::filesystem::exists(unseen)) append_groups(task.unseen, read_csv(unseen, task.features), first_group);
    }
    for (const std::string& line : read_lines(folder / "provenance.txt")) {
      if (std::find(origin.begin(), origin.end(), line) == origin.end()) origin.push_back(line);
    }
  }
}

/// Fills in the examples, from recordings or from folders, and says where they come from. False if interrupted.
bool gather(const Options& options, const GateSettings& settings, std::vector<Task>& tasks, std::vector<std::string>& origin) {
  if (!options.examples_folders.empty()) {
    load_examples(options.examples_folders, tasks, origin);
    return true;
  }
  if (options.sequences.size() < 2) {
    throw InvalidSettings("--sequence: got " + std::to_string(options.sequences.size()) +
                          ", expected two or more recordings for cross-validation, or --examples");
  }
  const Context context = make_context(options.device);
  if (context.memory() != MemoryKind::kHost) throw InvalidSettings("--device: got cuda, expected cpu: examples are gathered on the host");
  QualityExamples examples = collect(context, options.recording, options.sequences, options.views, settings);
  QualityExamples unseen = collect(context, options.recording, options.test_sequences, options.test_views, settings);
  tasks[0].examples = std::move(examples.tracking);
  tasks[0].unseen = std::move(unseen.tracking);
  tasks[1].examples = std::move(examples.acceptance);
  tasks[1].unseen = std::move(unseen.acceptance);
  origin = provenance(options, settings);
  return !interrupted();
}

void save_examples(const std::filesystem::path& folder, const std::vector<Task>& tasks, const std::vector<std::string>& origin) {
  std::string lines;
  for (const std::string& line : origin) lines += line + "\n";
  write_file_atomically((folder / "provenance.txt").string(), lines);
  for (const Task& task : tasks) {
    write_file_atomically((folder / (task.name + ".csv")).string(), to_csv(task.features, task.examples));
    if (!task.unseen.empty()) write_file_atomically((folder / (task.name + "_test.csv")).string(), to_csv(task.features, task.unseen));
  }
}

int train(const Options& options) {
  const GateSettings settings = settings_of(options);
  std::vector<Task> tasks = list_tasks(settings);
  std::vector<std::string> origin;
  if (!gather(options, settings, tasks, origin)) return kInterrupted;
  const std::filesystem::path folder(options.out_folder);
  std::filesystem::create_directories(folder);
  if (options.save_examples) save_examples(folder, tasks, origin);

  Json json;
  std::vector<NamedReport> plots;
  for (const Task& task : tasks) {
    ClassifierReport report;
    ClassifierModel model = train_classifier(task.name, task.features, task.examples, task.settings, report);
    model.provenance = origin;
    std::ostringstream text;
    write_classifier(text, model);
    write_file_atomically((folder / (task.name + ".txt")).string(), text.str());
    print_report(task.name + ", cross-validated", report);
    json[task.name]["cross_validated"] = to_json(report);
    plots.push_back({task.name, report});
    if (task.unseen.empty()) continue;
    const ClassifierReport test = test_classifier(model, task.unseen);
    print_report(task.name + ", other recordings", test);
    json[task.name]["other_recordings"] = to_json(test);
  }
  write_png((folder / "roc.png").string(), draw_roc(plots));
  write_file_atomically((folder / "report.json").string(), json.dump() + "\n");
  return kSuccess;
}

}  // namespace
}  // namespace foothold::apps

int main(int argc, char** argv) {
  using namespace foothold;
  using namespace foothold::apps;
  CommandLine app("Trains the classifiers that grade tracking and accept relocalised poses, and plots how well they tell right from wrong.",
                  "train_quality_gate");
  Options options;
  app.add_option("--sequence", options.sequences,
                 "A recording with known poses to train on: a folder or synthetic:ROOM?setting=value&..., with @A:B for a part; repeatable")
      .repeatable();
  app.add_option("--views", options.views, "Other frames of the same world, tried on its map; one for each --sequence, in their order")
      .repeatable();
  app.add_option("--test-sequence", options.test_sequences, "A recording to test on, not to train on; repeatable").repeatable();
  app.add_option("--test-views", options.test_views, "Other frames of the same world; one for each --test-sequence, in their order")
      .repeatable();
  app.add_option("--out", options.out_folder, "Folder for tracking_quality.txt, pose_acceptance.txt, report.json and roc.png")
      .type_name("FOLDER")
      .show_default();
  app.add_flag("--save-examples", options.save_examples, "Write the examples into the folder, too, as CSV files");
  app.add_option("--examples", options.examples_folders,
                 "Train on what --save-examples wrote into FOLDER instead of on recordings; repeatable, for collections made side by side")
      .type_name("FOLDER")
      .repeatable();
  app.add_option("--settings", options.settings_file, "JSON file of settings").type_name("FILE");
  app.add_option("--set", options.assignments, "One setting as setting=value; repeatable").repeatable();
  add_device_options(app, options.device);
  add_recording_options(app, options.recording);
  return run_app(app, argc, argv, [&] { return train(options); });
}
