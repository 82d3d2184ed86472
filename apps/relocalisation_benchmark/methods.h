// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The methods that the benchmark knows.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmark_settings.h"
#include "foothold/api/relocaliser.h"
#include "foothold/base/context.h"
#include "foothold/relocalisation/forest.h"

namespace foothold::benchmark {

/// What methods are made from.
struct MethodInputs {
  BenchmarkSettings settings;
  std::shared_ptr<const Forest> forest;  ///< null if no method uses one
};

/// A way to relocalise, by name; the section of BenchmarkSettings that it reads has the same name.
struct Method {
  std::string name;
  std::string description;
  bool uses_forest = false;
  std::function<std::unique_ptr<Relocaliser>(const Context&, const MethodInputs&)> create;
};

/// All methods, in the order of the documentation.
const std::vector<Method>& all_methods();

/// Finds methods by their names. @throws InvalidSettings naming the one that is unknown or repeated, and those that there are.
std::vector<Method> find_methods(const std::vector<std::string>& names);

}  // namespace foothold::benchmark
