// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "json_parts.h"
#include "outputs.h"

namespace foothold::benchmark {
namespace {

/// One level for everything: the interface that loss and split had first.
Json method_json(const MethodResult& method) {
  Json json = accuracy_json(method.report);
  json.update(timing_json(method));
  if (!method.novelty.empty()) json["novelty"] = novelty_json(method.novelty);
  json["settings"] = Json::nested(method.settings);
  return json;
}

}  // namespace

std::string json_document(const BenchmarkResult& result) {
  Json json = document_head(result.protocol, result.options);
  json["sequence"] = result.tested.size() == 1 ? Json(result.tested.front()) : Json(result.tested);
  if (!result.training.empty()) json["training"] = result.training;
  json["methods"] = Json::object();
  for (const MethodResult& method : result.methods) json["methods"][method.name] = method_json(method);
  return json.dump() + "\n";
}

}  // namespace foothold::benchmark
