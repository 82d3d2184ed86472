// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "run_methods.h"

#include <memory>

#include "common/peak_memory.h"
#include "common/progress_bar.h"

namespace foothold::benchmark {
namespace {

/// The settings that a method reads, without its own name in front of the path.
std::vector<std::pair<std::string, std::string>> settings_of(const Method& method, const BenchmarkSettings& all) {
  const std::string prefix = method.name + ".";
  std::vector<std::pair<std::string, std::string>> settings;
  for (const SettingDescription& setting : describe_settings(all)) {
    if (setting.path.rfind(prefix, 0) == 0) settings.emplace_back(setting.path.substr(prefix.size()), setting.value);
  }
  return settings;
}

}  // namespace

MethodResult run_method(const Method& method, const MethodInputs& inputs, const CommonOptions& options, const Protocol& protocol,
                        const std::string& label) {
  apps::restart_peak_memory();
  Trace trace;
  const std::unique_ptr<Relocaliser> relocaliser = method.create(apps::make_context(options.device, &trace), inputs);
  std::unique_ptr<apps::ProgressBar> bar;
  ProtocolOptions protocol_options;
  protocol_options.trace = &trace;
  protocol_options.progress = [&](const Progress& progress) {
    if (apps::interrupted()) throw Interrupted{};
    if (bar == nullptr) bar = std::make_unique<apps::ProgressBar>(label, progress.num_total);
    bar->set(progress.num_done);
  };
  MethodResult result;
  result.name = method.name;
  result.log = protocol(*relocaliser, protocol_options);
  result.report = make_report(result.log);
  result.peak_mb = apps::peak_memory_mb();
  result.settings = settings_of(method, inputs.settings);
  return result;
}

bool run_methods(const CommonOptions& options, const Protocol& protocol, BenchmarkResult& result) {
  const std::vector<Method> methods = find_methods(options.methods);
  const MethodInputs inputs = method_inputs(options, methods);
  try {
    for (const Method& method : methods) result.methods.push_back(run_method(method, inputs, options, protocol, method.name));
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

}  // namespace foothold::benchmark
