// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "benchmark_options.h"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>

#include "foothold/base/error.h"

namespace foothold::benchmark {
namespace {

constexpr const char* kUsage = R"(Usage: device_benchmark ACTION [OPTION VALUE]...

  time      durations of whole calls and of stages, frame by frame: medians and 95th percentiles behind the warm-up
  compare   what CUDA learns, finds and fuses against what the CPU does; fails where they differ by more than rounding
  soak      the same frames again and again for some time; fails if results change from lap to lap, or memory grows
  pack      a recording in a file that is small enough to be carried: depth in millimetres, colour in steps of 8

  --device cpu|cuda|cuda:N   for time and soak (cpu)
  --threads N                on the host; 0 for as many as it has (1)
  --sequence FILE            a recording made by `pack` or by render_sequence --raw, or synthetic:ROOM?setting=value&... (synthetic:office)
  --elsewhere FILE           the same for views of another place, for time (synthetic:stairs)
  --preset tuned|paper       settings of the relocaliser (tuned)
  --frames N                 how many of the sequence to use (200)
  --warm-up N                frames that are not counted, for time (50)
  --seconds N                how long to soak (60)
  --out FILE                 what to write, for pack
)";

int number_of(const std::string& option, const std::string& text, int low, int high) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || value < low || value > high) {
    throw InvalidSettings(option + ": got '" + text + "', expected a number in [" + std::to_string(low) + ", " + std::to_string(high) +
                          "]");
  }
  return static_cast<int>(value);
}

void set_device(const std::string& text, Options& options) {
  options.device = text == "cpu" ? Device::kCpu : Device::kCuda;
  if (text == "cpu" || text == "cuda") return;
  if (text.rfind("cuda:", 0) != 0) throw InvalidSettings("--device: got '" + text + "', expected cpu, cuda or cuda:N");
  options.cuda_device = number_of("--device", text.substr(5), 0, 1000);
}

void check(const Options& options) {
  if (options.action != "time" && options.action != "compare" && options.action != "soak" && options.action != "pack") {
    throw InvalidSettings("got '" + options.action + "', expected time, compare, soak or pack; try --help");
  }
  if (options.action == "time" && options.num_warm_up >= options.num_frames) {
    throw InvalidSettings("--warm-up: got " + std::to_string(options.num_warm_up) + ", expected fewer than --frames");
  }
  if (options.action == "pack" && options.out.empty()) throw InvalidSettings("--out: missing, expected the file to write");
}

}  // namespace

std::optional<Options> parse_options(const std::vector<std::string>& arguments) {
  constexpr int kMany = 100000;
  Options options;
  const auto text_into = [](std::string& value) { return [&value](const std::string& text) { value = text; }; };
  const auto number_into = [](const char* option, int& value, int low, int high) {
    return [=, &value](const std::string& text) { value = number_of(option, text, low, high); };
  };
  const std::map<std::string, std::function<void(const std::string&)>> setters = {
      {"--device", [&](const std::string& text) { set_device(text, options); }},
      {"--threads", number_into("--threads", options.num_threads, 0, 1024)},
      {"--sequence", text_into(options.sequence)},
      {"--elsewhere", text_into(options.elsewhere)},
      {"--preset", text_into(options.preset)},
      {"--out", text_into(options.out)},
      {"--frames", number_into("--frames", options.num_frames, 2, kMany)},
      {"--warm-up", number_into("--warm-up", options.num_warm_up, 1, kMany)},
      {"--seconds", number_into("--seconds", options.num_seconds, 0, kMany)}};
  for (const std::string& argument : arguments) {
    if (argument != "--help") continue;
    std::fputs(kUsage, stdout);
    return std::nullopt;
  }
  if (!arguments.empty()) options.action = arguments[0];
  for (std::size_t i = 1; i < arguments.size(); i += 2) {
    const auto setter = setters.find(arguments[i]);
    if (setter == setters.end() || i + 1 == arguments.size()) {
      throw InvalidSettings(arguments[i] + ": unknown, or without a value; try --help");
    }
    setter->second(arguments[i + 1]);
  }
  check(options);
  return options;
}

Context make_context(const Options& options, Trace* trace) {
  ContextOptions result;
  result.device = options.device;
  result.cuda_device = options.cuda_device;
  result.num_threads = options.num_threads;
  result.trace = trace;
  return Context(result);
}

}  // namespace foothold::benchmark
