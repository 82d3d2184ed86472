// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "methods.h"

#include <algorithm>

#include "foothold/base/error.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "mapping_relocaliser.h"
#include "uploading_relocaliser.h"

namespace foothold::benchmark {
namespace {

std::unique_ptr<Relocaliser> make_forest_relocaliser(const Context& context, const Forest& forest,
                                                     const ForestRelocaliserSettings& settings) {
  auto relocaliser = std::make_unique<ForestRelocaliser>(context, forest, settings);
  if (context.memory() == MemoryKind::kHost) return relocaliser;
  return std::make_unique<UploadingRelocaliser>(context, std::move(relocaliser));
}

std::unique_ptr<Relocaliser> make_mapping_relocaliser(const Context& context, const MethodInputs& inputs, Refinement refinement) {
  return std::make_unique<MappingRelocaliser>(context, make_forest_relocaliser(context, *inputs.forest, inputs.settings.forest),
                                              inputs.settings.map, inputs.settings.refiner, refinement);
}

std::vector<Method> list_methods() {
  return {
      {"forest", "forest adapted online, tuned settings", true,
       [](const Context& context, const MethodInputs& inputs) {
         return make_forest_relocaliser(context, *inputs.forest, inputs.settings.forest);
       }},
      {"paper", "forest adapted online, the paper's settings", true,
       [](const Context& context, const MethodInputs& inputs) {
         return make_forest_relocaliser(context, *inputs.forest, inputs.settings.paper);
       }},
      {"forest+icp", "forest, its first estimate aligned with a map of what was learnt", true,
       [](const Context& context, const MethodInputs& inputs) { return make_mapping_relocaliser(context, inputs, Refinement::kFirst); }},
      {"forest+icp+rank", "forest, its estimates aligned with the map and ranked by rendering", true,
       [](const Context& context, const MethodInputs& inputs) { return make_mapping_relocaliser(context, inputs, Refinement::kRanked); }},
      {"ferns", "random ferns, the nearest keyframe's pose; on the host whatever the device", false,
       [](const Context& context, const MethodInputs& inputs) {
         return std::make_unique<KeyframeRelocaliser>(context, inputs.settings.ferns);
       }}};
}

}  // namespace

void set_seeds(BenchmarkSettings& settings, std::uint64_t seed) {
  settings.forest.seed = seed;
  settings.paper.seed = seed;
  settings.ferns.seed = seed;
  settings.random_forest.seed = seed;
}

const std::vector<Method>& all_methods() {
  static const std::vector<Method> methods = list_methods();
  return methods;
}

std::vector<Method> find_methods(const std::vector<std::string>& names) {
  std::vector<Method> found;
  for (const std::string& name : names) {
    const auto is_it = [&](const Method& method) { return method.name == name; };
    const auto method = std::find_if(all_methods().begin(), all_methods().end(), is_it);
    if (method == all_methods().end()) {
      std::string known;
      for (const Method& each : all_methods()) known += (known.empty() ? "" : ", ") + each.name;
      throw InvalidSettings("--method: unknown method '" + name + "'; expected one or more of " + known);
    }
    if (std::any_of(found.begin(), found.end(), is_it))
      throw InvalidSettings("--method: '" + name + "' is given twice; expected each once");
    found.push_back(*method);
  }
  return found;
}

}  // namespace foothold::benchmark
