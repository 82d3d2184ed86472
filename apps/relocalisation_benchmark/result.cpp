// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "result.h"

namespace foothold::benchmark {

std::map<std::string, Spread> stages_of(const MethodReport& report) {
  const std::pair<const char*, const CallReport&> kinds[] = {
      {"train/", report.train}, {"relocalise/", report.relocalise}, {"update/", report.update}};
  std::map<std::string, Spread> stages;
  for (const auto& [prefix, calls] : kinds) {
    for (const auto& [stage, ms] : calls.stages_ms) stages.emplace(stage.find('/') == std::string::npos ? prefix + stage : stage, ms);
  }
  return stages;
}

}  // namespace foothold::benchmark
