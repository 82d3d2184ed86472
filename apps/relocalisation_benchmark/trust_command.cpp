// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "common/canvas.h"
#include "common/progress_bar.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "foothold/evaluation/train_test.h"
#include "foothold/io/image_file.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "outputs.h"
#include "scene_tables.h"
#include "trust_evidence.h"
#include "trust_questions.h"
#include "trust_report.h"

namespace foothold::benchmark {
namespace {

struct TrustOptions {
  SceneOptions scenes;
  TrustAmounts amounts;
  bool quick = false;
  std::string pictures;
  std::string evidence;
  int most_pictures = 24;
};

/// Few of everything: some two minutes on two cores.
TrustAmounts quick_amounts() {
  TrustAmounts amounts;
  amounts.num_rooms = 5;
  amounts.num_own = 24;
  amounts.num_strangers = 60;
  amounts.num_spoilt = 6;
  amounts.views.num_training = 60;
  return amounts;
}

/// Asks the map of one subject everything, and adds up how the questions ended.
class Inquiry {
 public:
  Inquiry(const TrustOptions& options, const std::vector<TrustSubject>& subjects) : options_(options), subjects_(subjects) {}

  MethodTrust run(const Method& method, const MethodInputs& inputs) {
    MethodTrust trust;
    trust.method = method.name;
    std::vector<ConfidenceSample> all;
    for (std::size_t map = 0; map < subjects_.size(); ++map) {
      const std::vector<QuestionSet> sets = questions_for(subjects_, map, options_.amounts, options_.scenes.common.seed);
      const RunLog log = ask(method, inputs, subjects_[map], sets);
      trust.acceptance_threshold = static_cast<double>(log.acceptance_threshold);
      const std::vector<ConfidenceSample> samples = judge(log, subjects_[map], sets, trust);
      all.insert(all.end(), samples.begin(), samples.end());
    }
    trust.confidence = make_confidence_report(all, trust.acceptance_threshold);
    return trust;
  }

 private:
  RunLog ask(const Method& method, const MethodInputs& inputs, const TrustSubject& subject, const std::vector<QuestionSet>& sets) const {
    std::vector<EvaluationInput> tests;
    for (const QuestionSet& set : sets) tests.push_back(memory_input(subject.name + ", " + set.kind, set.frames));
    const Protocol protocol = [&](Relocaliser& relocaliser, const ProtocolOptions& protocol_options) {
      return run_train_test(relocaliser, {memory_input(subject.name, subject.training)}, tests, options_.scenes.num_settling_updates,
                            protocol_options);
    };
    return run_method(method, inputs, options_.scenes.common, protocol, method.name + " on " + subject.name).log;
  }

  std::vector<ConfidenceSample> judge(const RunLog& log, const TrustSubject& subject, const std::vector<QuestionSet>& sets,
                                      MethodTrust& trust) {
    std::vector<ConfidenceSample> samples;
    MapTrust map;
    map.name = subject.name;
    std::size_t frame = 0;  // within its set
    for (std::size_t i = 0; i < log.tests.size(); ++i) {
      const TestRecord& test = log.tests[i];
      frame = i > 0 && log.tests[i - 1].input_index == test.input_index ? frame + 1 : 0;
      const QuestionSet& set = sets[static_cast<std::size_t>(test.input_index)];
      samples.push_back(confidence_sample(test, !set.is_elsewhere));
      BeliefCounts counts;
      counts.count(samples.back(), trust.acceptance_threshold);
      trust.kinds[set.kind] += counts;
      trust.all += counts;
      map.beliefs += counts;
      if (set.is_elsewhere) trust.elsewhere += counts;
      if (counts.num_wrong_believed > 0) trust.wrong_beliefs.push_back(wrong_belief(test, subject, set, *set.frames[frame]));
    }
    map.confidence = make_confidence_report(samples, trust.acceptance_threshold);
    trust.maps.push_back(std::move(map));
    return samples;
  }

  WrongBelief wrong_belief(const TestRecord& test, const TrustSubject& subject, const QuestionSet& set, const RgbdFrame& frame) {
    WrongBelief wrong{subject.name, set.kind, test.frame_index, static_cast<double>(test.best->confidence), test.error, {}};
    if (!options_.pictures.empty() && num_pictures_ < options_.most_pictures) {
      const std::string path = options_.pictures + "." + std::to_string(++num_pictures_) + ".png";
      wrong.picture = std::filesystem::path(path).filename().string();
      draw(path, wrong, frame, *nearest_learnt(subject, test.best->world_from_camera));
    }
    return wrong;
  }

  /// The learnt view that a pose would be nearest to: half a metre counts as much as a radian.
  static std::shared_ptr<const RgbdFrame> nearest_learnt(const TrustSubject& subject, const SE3& world_from_camera) {
    const auto distance = [&](const std::shared_ptr<const RgbdFrame>& frame) {
      return translation_distance_m(*frame->world_from_camera, world_from_camera) +
             0.5F * rotation_distance_rad(*frame->world_from_camera, world_from_camera);
    };
    return *std::min_element(subject.training.begin(), subject.training.end(),
                             [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  }

  static void draw(const std::string& path, const WrongBelief& wrong, const RgbdFrame& asked, const RgbdFrame& learnt) {
    constexpr int width = 1000;
    constexpr int height = 430;
    apps::Canvas canvas(width, height);
    char words[160];
    std::snprintf(words, sizeof words, "%s: %s, frame %lld, believed with %.3f", wrong.map.c_str(), wrong.kind.c_str(),
                  static_cast<long long>(wrong.frame_index), wrong.confidence);
    canvas.text({12.0, 18.0}, words, 12.0, {40, 40, 40});
    canvas.text({12.0, 44.0}, "what was asked", 10.0, {40, 40, 40});
    canvas.text({512.0, 44.0}, "the learnt view nearest to the answer", 10.0, {40, 40, 40});
    canvas.picture(cv::Rect(10, 58, 480, 360), asked.colour);
    canvas.picture(cv::Rect(510, 58, 480, 360), learnt.colour);
    write_png(path, canvas.image());
  }

  const TrustOptions& options_;
  const std::vector<TrustSubject>& subjects_;
  int num_pictures_ = 0;
};

std::vector<std::pair<std::string, std::string>> describe(const TrustOptions& options) {
  std::vector<std::pair<std::string, std::string>> described = describe_scene_options(options.scenes);
  const TrustAmounts& amounts = options.amounts;
  const std::pair<const char*, int> numbers[] = {{"rooms", amounts.num_rooms},          {"frames", amounts.views.num_training},
                                                 {"room_stride", amounts.views.stride}, {"own", amounts.num_own},
                                                 {"strangers", amounts.num_strangers},  {"spoilt", amounts.num_spoilt},
                                                 {"width", amounts.views.width},        {"height", amounts.views.height}};
  for (const auto& [name, value] : numbers) described.emplace_back(name, std::to_string(value));
  return described;
}

int run_trust(const TrustOptions& options) {
  check_outputs(options.scenes.common);
  const std::vector<Method> methods = find_methods(options.scenes.common.methods);
  const MethodInputs inputs = method_inputs(options.scenes.common, methods);
  const std::vector<Scene> recordings = open_scenes(options.scenes);
  if (options.amounts.num_rooms == 0 && recordings.empty())
    throw InvalidSettings("--rooms: got 0 without --scene; expected something to learn");
  check_pictures(options.pictures);
  std::vector<MethodTrust> results;
  try {
    const std::vector<TrustSubject> subjects = load_subjects(options.amounts, recordings, options.scenes.common.device.num_threads);
    Inquiry inquiry(options, subjects);
    for (const Method& method : methods) results.push_back(inquiry.run(method, inputs));
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  std::printf("How far answers can be trusted: %d questions to %d maps, %d of them about another place\n\n%s",
              results.front().all.num_questions, static_cast<int>(results.front().maps.size()), results.front().elsewhere.num_questions,
              trust_tables(results).c_str());
  Json json = document_head("trust", describe(options));
  json["scenes"] = scenes_json(recordings);
  json["methods"] = trust_json(results);
  std::printf("%s", write_documents(options.scenes.common, json, trust_csv(results)).c_str());
  if (!options.scenes.common.plot_file.empty()) {
    write_trust_plot(options.scenes.common.plot_file, results);
    std::printf("picture: %s\n", options.scenes.common.plot_file.c_str());
  }
  return apps::kSuccess;
}

/// Writes what the forest's confidence is made from, instead of measuring it.
int write_evidence(const TrustOptions& options) {
  const SceneOptions& scenes = options.scenes;
  const MethodInputs inputs = method_inputs(scenes.common, find_methods({"forest"}));
  const std::vector<TrustSubject> subjects = load_subjects(options.amounts, open_scenes(scenes), scenes.common.device.num_threads);
  ForestRelocaliser relocaliser(apps::make_context(scenes.common.device), *inputs.forest, inputs.settings.forest);
  EvidenceTable table;
  apps::ProgressBar bar("maps", static_cast<int>(subjects.size()));
  try {
    for (std::size_t map = 0; map < subjects.size(); ++map) {
      table.add(relocaliser, subjects[map], questions_for(subjects, map, options.amounts, scenes.common.seed), scenes.num_settling_updates);
      bar.advance();
    }
  } catch (const Interrupted&) {
    return apps::kInterrupted;
  }
  AtomicFile file(options.evidence);
  file.stream() << table.csv();
  file.commit();
  return apps::kSuccess;
}

/// Numbers as typed; those below 0 were not.
struct TypedAmounts {
  int num_rooms = -1;
  int num_frames = -1;
  int num_own = -1;
  int num_strangers = -1;
  int num_spoilt = -1;
  int first_room = -1;
};

/// The full or quick amounts, but for those typed.
TrustAmounts amounts_of(const TypedAmounts& typed, bool quick) {
  TrustAmounts amounts = quick ? quick_amounts() : TrustAmounts{};
  amounts.first_room = typed.first_room;
  const std::pair<int, int*> numbers[] = {{typed.num_rooms, &amounts.num_rooms},
                                          {typed.num_frames, &amounts.views.num_training},
                                          {typed.num_own, &amounts.num_own},
                                          {typed.num_strangers, &amounts.num_strangers},
                                          {typed.num_spoilt, &amounts.num_spoilt}};
  for (const auto& [number, amount] : numbers) {
    if (number >= 0) *amount = number;
  }
  return amounts;
}

void add_amount(apps::CommandLine& command, const char* name, int& typed, const std::string& help, std::pair<int, int> full_and_quick,
                int least) {
  const std::string defaults =
      " (" + std::to_string(full_and_quick.first) + "; with --quick " + std::to_string(full_and_quick.second) + ")";
  command.add_option(name, typed, help + defaults).range(least, 1000000);
}

}  // namespace

Command add_trust_command(apps::CommandLine& app) {
  const auto options = std::make_shared<TrustOptions>();
  const auto typed = std::make_shared<TypedAmounts>();
  apps::CommandLine command =
      app.add_subcommand("trust", "How far answers can be trusted: many maps, many questions, right or wrong, believed or not, by kind");
  add_scene_options(command, options->scenes, false);
  command.add_flag("--quick", options->quick, "Few of everything: some two minutes on two cores");
  const TrustAmounts full;
  const TrustAmounts quick = quick_amounts();
  add_amount(command, "--rooms", typed->num_rooms, "Rendered rooms to learn, a map each; 0 for recordings alone",
             {full.num_rooms, quick.num_rooms}, 0);
  add_amount(command, "--frames", typed->num_frames, "Frames to learn of each room", {full.views.num_training, quick.views.num_training},
             1);
  add_amount(command, "--own", typed->num_own, "Other views of each scene to ask about", {full.num_own, quick.num_own}, 2);
  add_amount(command, "--strangers", typed->num_strangers, "Views of the other scenes to ask each map about",
             {full.num_strangers, quick.num_strangers}, 0);
  add_amount(command, "--spoilt", typed->num_spoilt, "Views of each kind that is spoilt, or changed, to ask each map about",
             {full.num_spoilt, quick.num_spoilt}, 1);
  command.add_option("--pictures", options->pictures, "Draw the first wrong answers that are believed to PREFIX.N.png").type_name("PREFIX");
  command
      .add_option("--evidence", options->evidence,
                  "Instead, write what the forest's confidence in each answer is made from to FILE, to fit it (scripts/fit_confidence.py)")
      .type_name("FILE.csv");
  command
      .add_option(
          "--first-room", typed->first_room,
          "Learn rooms training-N, N + 1, ... alone; from 100 on they are for tests, and come behind the named rooms if this is not given")
      .range(0, 100000);
  add_forest_option(command, options->scenes.common);
  add_experiment_options(command, options->scenes.common);
  add_plot_option(command, options->scenes.common, "Draw risk against coverage, reliability and how questions ended to FILE.png");
  return {command, [options, typed] {
            options->amounts = amounts_of(*typed, options->quick);
            return options->evidence.empty() ? run_trust(*options) : write_evidence(*options);
          }};
}

}  // namespace foothold::benchmark
