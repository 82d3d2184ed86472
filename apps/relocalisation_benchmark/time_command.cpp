// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/text_table.h"
#include "foothold/evaluation/train_test.h"
#include "memory_input.h"
#include "outputs.h"
#include "run_methods.h"
#include "scene_tables.h"

namespace foothold::benchmark {
namespace {

struct TimeOptions {
  CommonOptions common;
  std::string sequence;
  std::string frames;
  int num_training = 150;
  int num_tests = 40;
  std::vector<std::string> swept_methods = {"forest"};
};

/// Frames that are learnt in order, and others, spread evenly between them, that are tested afterwards.
struct TimedFrames {
  FrameList training;
  FrameList tests;
};

/// One run of a sweep.
struct SweepPoint {
  double value = 0.0;
  MethodResult result;
};

/// How cost grows with one quantity.
struct Sweep {
  std::string method;
  std::string quantity;
  std::vector<SweepPoint> points;
};

TimedFrames load_frames(const TimeOptions& options) {
  EvaluationInput input = open_input(options.common, options.sequence, options.frames);
  const int num_wanted = options.num_training + options.num_tests;
  if (input.num_frames < num_wanted) {
    throw InvalidSettings(input.name + ": has " + std::to_string(input.num_frames) + " frames; expected at least " +
                          std::to_string(num_wanted) + " for --train-frames " + std::to_string(options.num_training) +
                          " and --test-frames " + std::to_string(options.num_tests));
  }
  const std::unique_ptr<FrameSource> source = input.open();
  TimedFrames frames;
  for (int i = 0; i < num_wanted; ++i) {
    auto frame = std::make_shared<RgbdFrame>();
    if (apps::interrupted()) throw Interrupted{};
    if (source->read(*frame) != ReadStatus::kFrame) throw FileError(input.name + ": ended at frame " + std::to_string(i));
    const bool is_test = (i + 1) * options.num_tests / num_wanted > i * options.num_tests / num_wanted;
    (is_test ? frames.tests : frames.training).push_back(std::move(frame));
  }
  return frames;
}

/// Runs methods on frames in memory.
class Stopclock {
 public:
  explicit Stopclock(const TimeOptions& options) : options_(options) {}

  MethodResult run(const Method& method, const MethodInputs& inputs, const TimedFrames& frames, const std::string& label) const {
    const Protocol protocol = [&](Relocaliser& relocaliser, const ProtocolOptions& protocol_options) {
      return run_train_test(relocaliser, {memory_input(options_.sequence, frames.training)},
                            {memory_input(options_.sequence, frames.tests)}, 0, protocol_options);
    };
    return run_method(method, inputs, options_.common, protocol, label);
  }

  Sweep sweep_trained_frames(const Method& method, const MethodInputs& inputs, const TimedFrames& frames) const {
    Sweep sweep{method.name, "trained_frames", {}};
    for (const int divisor : {16, 8, 4, 2, 1}) {
      const std::size_t count = frames.training.size() / static_cast<std::size_t>(divisor);
      if (count == 0) continue;
      TimedFrames some = frames;
      some.training.resize(count);
      add(sweep, static_cast<double>(count), run(method, inputs, some, label_of(sweep, std::to_string(count))));
    }
    return sweep;
  }

  Sweep sweep_image_width(const Method& method, const MethodInputs& inputs, const TimedFrames& frames) const {
    Sweep sweep{method.name, "image_width_px", {}};
    for (const int divisor : {4, 2, 1}) {
      TimedFrames reduced;
      for (const auto& frame : frames.training) reduced.training.push_back(std::make_shared<RgbdFrame>(reduce_frame(*frame, divisor)));
      for (const auto& frame : frames.tests) reduced.tests.push_back(std::make_shared<RgbdFrame>(reduce_frame(*frame, divisor)));
      const int width = reduced.tests.front()->depth.width();
      add(sweep, width, run(method, inputs, reduced, label_of(sweep, std::to_string(width))));
    }
    return sweep;
  }

  Sweep sweep_hypotheses(const Method& method, const MethodInputs& inputs, const TimedFrames& frames) const {
    Sweep sweep{method.name, "hypotheses", {}};
    for (const int count : {64, 128, 256, 512, 1024, 2048}) {
      MethodInputs changed = inputs;
      changed.settings.forest.pose.num_hypotheses = count;
      changed.settings.paper.pose.num_hypotheses = count;
      add(sweep, count, run(method, changed, frames, label_of(sweep, std::to_string(count))));
    }
    return sweep;
  }

  /// Complete data-free forests of different depths: only there can leaves be chosen.
  Sweep sweep_leaves(const Method& method, const MethodInputs& inputs, const TimedFrames& frames) const {
    Sweep sweep{method.name, "leaves", {}};
    for (const int depth : {7, 9, 11, 13, 15}) {
      MethodInputs changed = inputs;
      changed.settings.random_forest.depth = depth;
      changed.forest = std::make_shared<const Forest>(make_random_forest(changed.settings.random_forest));
      const int num_leaves = changed.forest->num_leaves();
      add(sweep, num_leaves, run(method, changed, frames, label_of(sweep, std::to_string(num_leaves))));
    }
    return sweep;
  }

 private:
  static std::string label_of(const Sweep& sweep, const std::string& value) { return sweep.method + ", " + value + " " + sweep.quantity; }
  static void add(Sweep& sweep, double value, MethodResult result) { sweep.points.push_back({value, std::move(result)}); }

  const TimeOptions& options_;
};

std::vector<Sweep> run_sweeps(const Stopclock& clock, const std::vector<Method>& methods, const MethodInputs& inputs,
                              const TimedFrames& frames) {
  std::vector<Sweep> sweeps;
  for (const Method& method : methods) {
    sweeps.push_back(clock.sweep_trained_frames(method, inputs, frames));
    sweeps.push_back(clock.sweep_image_width(method, inputs, frames));
    if (!method.uses_forest) continue;
    sweeps.push_back(clock.sweep_hypotheses(method, inputs, frames));
    sweeps.push_back(clock.sweep_leaves(method, inputs, frames));
  }
  return sweeps;
}

Json sweeps_json(const std::vector<Sweep>& sweeps) {
  Json json = Json::array();
  for (const Sweep& sweep : sweeps) {
    Json points = Json::array();
    for (const SweepPoint& point : sweep.points) {
      Json entry = {{"value", point.value}};
      entry.update(accuracy_json(point.result.report));
      entry["timing"] = timing_json(point.result);
      points.push_back(std::move(entry));
    }
    json.push_back({{"method", sweep.method}, {"quantity", sweep.quantity}, {"points", std::move(points)}});
  }
  return json;
}

std::string sweeps_table(const std::vector<Sweep>& sweeps) {
  const auto spread = [](const Spread& ms) { return format_number(ms.median, 2) + "/" + format_number(ms.p95, 2); };
  std::vector<std::vector<std::string>> rows;
  for (const Sweep& sweep : sweeps) {
    for (const SweepPoint& point : sweep.points) {
      const MethodReport& report = point.result.report;
      rows.push_back({sweep.method, sweep.quantity, format_number(point.value, 0), spread(report.train.wall_ms),
                      spread(report.relocalise.wall_ms), format_number(100.0 * report.recall[2].fraction, 1),
                      format_number(report.state_mb, 1)});
    }
  }
  return rows.empty() ? std::string()
                      : "\n" + format_table({"method", "quantity", "value", "train ms", "relocalise ms", "5/5 %", "state MB"}, rows);
}

std::string timings_csv(const std::vector<Sweep>& sweeps) {
  std::string csv = "method,quantity,value,train_ms,train_p95_ms,relocalise_ms,relocalise_p95_ms,recall_5cm_5deg,state_mb\n";
  for (const Sweep& sweep : sweeps) {
    for (const SweepPoint& point : sweep.points) {
      const MethodReport& report = point.result.report;
      csv += csv_cell(sweep.method) + "," + sweep.quantity;
      for (const double value : {point.value, report.train.wall_ms.median, report.train.wall_ms.p95, report.relocalise.wall_ms.median,
                                 report.relocalise.wall_ms.p95, report.recall[2].fraction, report.state_mb})
        csv += "," + csv_number(value);
      csv += "\n";
    }
  }
  return csv;
}

int run_time(const TimeOptions& options) {
  check_outputs(options.common);
  const std::vector<Method> methods = find_methods(options.common.methods);
  const std::vector<Method> swept = find_methods(options.swept_methods);
  std::vector<Method> all = methods;
  all.insert(all.end(), swept.begin(), swept.end());
  const MethodInputs inputs = method_inputs(options.common, all);
  const Stopclock clock(options);
  BenchmarkResult result;
  std::vector<Sweep> sweeps;
  try {
    const TimedFrames frames = load_frames(options);
    for (const Method& method : methods) result.methods.push_back(clock.run(method, inputs, frames, method.name));
    sweeps = run_sweeps(clock, swept, inputs, frames);
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("Learnt %d frames, tested %d others between them; frames in memory\n\n%s\n%s%s", options.num_training, options.num_tests,
              summary_table(result).c_str(), duration_table(result).c_str(), sweeps_table(sweeps).c_str());
  std::vector<std::pair<std::string, std::string>> described = describe_options(options.common);
  described.emplace_back("train_frames", std::to_string(options.num_training));
  described.emplace_back("test_frames", std::to_string(options.num_tests));
  Json json = document_head("time", described);
  json["sequence"] = options.frames.empty() ? options.sequence : options.sequence + "@" + options.frames;
  json["methods"] = Json::object();
  for (const MethodResult& method : result.methods) {
    json["methods"][method.name] = accuracy_json(method.report);
    json["methods"][method.name]["timing"] = timing_json(method);
  }
  json["sweeps"] = sweeps_json(sweeps);
  std::printf("%s", write_documents(options.common, json, timings_csv(sweeps)).c_str());
  return apps::kSuccess;
}

}  // namespace

Command add_time_command(apps::CommandLine& app) {
  const auto options = std::make_shared<TimeOptions>();
  options->common.methods = {"forest", "ferns"};
  apps::CommandLine command = app.add_subcommand("time", "What learning and finding cost, by stage, and how it grows: the paper's Table 3");
  command.add_option("--sequence", options->sequence, "A folder (7-Scenes, TUM RGB-D, ICL-NUIM) or synthetic:NAME?key=value").required();
  command.add_option("--frames", options->frames, "Use only frames A:B, the last one excluded").type_name("A:B");
  command.add_option("--train-frames", options->num_training, "Frames to learn; all frames are held in memory, 2 MB each")
      .range(1, 100000)
      .show_default();
  command.add_option("--test-frames", options->num_tests, "Frames to test, spread evenly between them").range(1, 100000).show_default();
  command
      .add_option("--sweep", options->swept_methods,
                  "Methods of which to measure how cost grows with trained frames, image size, hypotheses and leaves; 'none' for none")
      .comma_separated()
      .show_default();
  add_forest_option(command, options->common);
  add_experiment_options(command, options->common);
  return {command, [options] {
            if (options->swept_methods == std::vector<std::string>{"none"}) options->swept_methods.clear();
            return run_time(*options);
          }};
}

}  // namespace foothold::benchmark
