// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Runs one protocol with one method after another.
#pragma once

#include <functional>
#include <string>

#include "options.h"
#include "result.h"

namespace foothold::benchmark {

/// A protocol with its inputs, ready for a relocaliser.
using Protocol = std::function<RunLog(Relocaliser&, const ProtocolOptions&)>;

/// Thrown through a protocol to end it when the user presses Ctrl-C.
struct Interrupted {};

/// Runs the protocol with one method, showing progress on stderr behind `label`.
/// @throws Interrupted; Error for anything a user can get wrong.
MethodResult run_method(const Method& method, const MethodInputs& inputs, const CommonOptions& options, const Protocol& protocol,
                        const std::string& label);

/// Runs the protocol with every method of the options, showing progress on stderr, and stores the results.
/// @return False if the user pressed Ctrl-C.  @throws Error for anything a user can get wrong.
bool run_methods(const CommonOptions& options, const Protocol& protocol, BenchmarkResult& result);

}  // namespace foothold::benchmark
