// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// device_benchmark: what training, relocalising and fusing a frame cost on a device, as a whole and stage by stage.
///
/// Frames are loaded beforehand. Whole calls are timed in one pass, with the device idle before and after each; stages in another, because
/// tracing waits for the device after every stage.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "foothold/base/error.h"
#include "foothold/base/trace.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/frames/raw_sequence.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "foothold/synthetic/synthetic_sequence.h"

namespace foothold {
namespace {

struct Options {
  Device device = Device::kCpu;
  int num_threads = 1;
  std::string sequence;  ///< a raw recording; empty for a rendered room
  std::string size = "640x480";
  std::string preset = "tuned";
  int num_frames = 200;
  int num_warm_up = 50;
};

constexpr const char* kUsage =
    "Usage: device_benchmark [--device cpu|cuda] [--threads N] [--sequence FILE] [--size WxH] [--preset tuned|paper] [--frames N]\n"
    "                        [--warm-up N]\n"
    "Times training, relocalisation and fusion, frame by frame: medians and 95th percentiles over the frames behind the warm-up.\n"
    "FILE is a raw recording with poses, made by render_sequence --raw; without one, a room is rendered in the given size.\n";

int number_of(const std::string& option, const std::string& text, int low, int high) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || value < low || value > high) {
    throw InvalidSettings(option + ": got '" + text + "', expected a number in [" + std::to_string(low) + ", " + std::to_string(high) +
                          "]");
  }
  return static_cast<int>(value);
}

Device device_of(const std::string& text) {
  if (text == "cpu") return Device::kCpu;
  if (text == "cuda") return Device::kCuda;
  throw InvalidSettings("--device: got '" + text + "', expected cpu or cuda");
}

/// Nothing if the user only asked for help.
std::optional<Options> parse(const std::vector<std::string>& arguments) {
  constexpr int kMany = 100000;
  Options options;
  const std::map<std::string, std::function<void(const std::string&)>> setters = {
      {"--device", [&](const std::string& text) { options.device = device_of(text); }},
      {"--threads", [&](const std::string& text) { options.num_threads = number_of("--threads", text, 0, 1024); }},
      {"--sequence", [&](const std::string& text) { options.sequence = text; }},
      {"--size", [&](const std::string& text) { options.size = text; }},
      {"--preset", [&](const std::string& text) { options.preset = text; }},
      {"--frames", [&](const std::string& text) { options.num_frames = number_of("--frames", text, 2, kMany); }},
      {"--warm-up", [&](const std::string& text) { options.num_warm_up = number_of("--warm-up", text, 1, kMany); }}};
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    if (arguments[i] == "--help") return std::nullopt;
    const auto setter = setters.find(arguments[i]);
    if (setter == setters.end() || i + 1 == arguments.size())
      throw InvalidSettings(arguments[i] + ": unknown, or without a value; try --help");
    setter->second(arguments[i + 1]);
  }
  if (options.num_warm_up >= options.num_frames) {
    throw InvalidSettings("--warm-up: got " + std::to_string(options.num_warm_up) + ", expected fewer than --frames");
  }
  return options;
}

std::unique_ptr<Sequence> open(const Options& options) {
  if (!options.sequence.empty()) return open_raw_sequence(options.sequence);
  const std::size_t x = options.size.find('x');
  if (x == std::string::npos) throw InvalidSettings("--size: got '" + options.size + "', expected WIDTHxHEIGHT");
  SyntheticSequenceSettings settings;
  settings.width = number_of("--size", options.size.substr(0, x), 16, 4096);
  settings.height = number_of("--size", options.size.substr(x + 1), 16, 4096);
  settings.frames = options.num_frames;
  return make_synthetic_sequence(settings, Context{});
}

std::vector<RgbdFrame> load(const Options& options) {
  const std::unique_ptr<Sequence> sequence = open(options);
  std::vector<RgbdFrame> frames;
  for (int i = 0; i < std::min(options.num_frames, sequence->num_frames()); ++i) {
    RgbdFrame frame = sequence->load(i);
    if (frame.world_from_camera) frames.push_back(std::move(frame));
  }
  if (static_cast<int>(frames.size()) <= options.num_warm_up) {
    throw InvalidSettings("--sequence: got " + std::to_string(frames.size()) + " frames with poses, expected more than the warm-up of " +
                          std::to_string(options.num_warm_up));
  }
  return frames;
}

/// Durations by name, in the order in which names first came.
class Table {
 public:
  void add(const std::string& name, double duration_ms) {
    if (durations_ms_.find(name) == durations_ms_.end()) names_.push_back(name);
    durations_ms_[name].push_back(duration_ms);
  }
  void print(const std::string& title) const {
    std::printf("\n| %s | median [ms] | 95 %% [ms] | calls |\n|---|---:|---:|---:|\n", title.c_str());
    for (const std::string& name : names_) {
      const std::vector<double>& durations = durations_ms_.at(name);
      std::printf("| %s | %.3f | %.3f | %zu |\n", name.c_str(), quantile(durations, 0.5), quantile(durations, 0.95), durations.size());
    }
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> durations_ms_;
};

/// The system under test on one device.
class Rig {
 public:
  Rig(const Options& options, Trace* trace)
      : context_(context_of(options, trace)),
        uploader_(context_),
        relocaliser_(context_, make_random_forest({}), ForestRelocaliserSettings::preset(options.preset)),
        pipeline_(context_, {}, nullptr) {}

  /// Calls `timed(name, call)` for each whole call that a frame brings.
  template <class Timed>
  void process(const RgbdFrame& recorded, const Timed& timed) {
    Frame frame;
    timed("upload of a frame", [&] { frame = uploader_.upload(recorded.view()); });
    timed("whole relocalisation", [&] { num_estimates_ += static_cast<long>(relocaliser_.relocalise(frame).size()); });
    timed("whole training frame", [&] { relocaliser_.train(frame, *recorded.world_from_camera); });
    if (num_frames_++ == 0) pipeline_.start_at(*recorded.world_from_camera);
    timed("whole fused frame: track, grade, integrate, render", [&] { num_fused_ += pipeline_.process(frame).fused ? 1 : 0; });
  }

  const Context& context() const { return context_; }
  long num_estimates() const { return num_estimates_; }
  std::size_t relocaliser_bytes() const { return relocaliser_.state_bytes(); }
  int num_blocks() const { return pipeline_.volume().num_blocks(); }
  long num_fused() const { return num_fused_; }

 private:
  static Context context_of(const Options& options, Trace* trace) {
    ContextOptions result;
    result.device = options.device;
    result.num_threads = options.num_threads;
    result.trace = trace;
    return Context(result);
  }

  Context context_;
  FrameUploader uploader_;
  ForestRelocaliser relocaliser_;
  FusionPipeline pipeline_;
  long num_frames_ = 0;
  long num_fused_ = 0;
  long num_estimates_ = 0;
};

void time_whole_calls(const Options& options, const std::vector<RgbdFrame>& frames) {
  Rig rig(options, nullptr);
  Table table;
  int index = 0;
  for (const RgbdFrame& frame : frames) {
    const bool counts = index++ >= options.num_warm_up;
    rig.process(frame, [&](const char* name, const auto& call) {
      rig.context().synchronise();
      const Stopwatch watch;
      call();
      rig.context().synchronise();
      if (counts) table.add(name, watch.elapsed_ms());
    });
  }
  table.print("whole calls");
  std::printf("\nPoses proposed: %ld; frames fused: %ld of %zu. The scene takes %.1f MB, the map has %d blocks.\n", rig.num_estimates(),
              rig.num_fused(), frames.size(), static_cast<double>(rig.relocaliser_bytes()) / 1e6, rig.num_blocks());
}

void time_stages(const Options& options, const std::vector<RgbdFrame>& frames) {
  Trace trace;
  Rig rig(options, &trace);
  int index = 0;
  for (const RgbdFrame& frame : frames) {
    if (index++ == options.num_warm_up) trace.clear();
    rig.process(frame, [](const char*, const auto& call) { call(); });
  }
  Table table;
  for (const auto& [stage, durations_ms] : trace.stages()) {
    for (const double duration_ms : durations_ms) table.add(stage, duration_ms);
  }
  table.print("stages");
}

int run(const std::vector<std::string>& arguments) {
  const std::optional<Options> options = parse(arguments);
  if (!options) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  { const Context there_is_a_device(ContextOptions{options->device, 1, {}, {}, nullptr}); }
  const std::vector<RgbdFrame> frames = load(*options);
  std::printf("%s, %s preset, %zu frames of %dx%d pixels from %s, the first %d to warm up\n",
              options->device == Device::kCuda ? "CUDA" : ("CPU, " + std::to_string(options->num_threads) + " threads").c_str(),
              options->preset.c_str(), frames.size(), frames[0].depth.width(), frames[0].depth.height(),
              options->sequence.empty() ? "a rendered office" : options->sequence.c_str(), options->num_warm_up);
  time_whole_calls(*options, frames);
  time_stages(*options, frames);
  return 0;
}

}  // namespace
}  // namespace foothold

int main(int argc, char** argv) {
  try {
    return foothold::run({argv + 1, argv + argc});
  } catch (const foothold::Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "unexpected: %s\n", error.what());
    return 1;
  }
}
