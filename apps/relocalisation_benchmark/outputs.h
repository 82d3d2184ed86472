// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The forms in which a result is written. Files appear complete or not at all; docs/benchmark-json.md describes them.
#pragma once

#include <string>

#include "options.h"
#include "result.h"

namespace foothold::benchmark {

/// A Markdown table for people, a row per method.
std::string summary_table(const BenchmarkResult& result);
/// A Markdown table of durations for people, a row per call and stage and a column per method.
std::string duration_table(const BenchmarkResult& result);
/// A Markdown table of recall against novelty, a row per bin and a column per method; empty if the result has no bins.
std::string novelty_table(const BenchmarkResult& result);
/// How many frames were left out or had no depth; empty if there are none.
std::string left_out_text(const BenchmarkResult& result);
/// All tables that the result has something for.
std::string all_tables(const BenchmarkResult& result);
/// The result as a JSON document.
std::string json_document(const BenchmarkResult& result);
/// A fraction in percent with one decimal, for tables.
std::string percent(double fraction);
/// A number that reads back to the same single-precision value; empty if it is not finite.
std::string csv_number(double value);
/// Text for a CSV cell: quoted if need be.
std::string csv_cell(const std::string& text);
/// A line per tested frame and method.
std::string csv_document(const BenchmarkResult& result);
/// The poses of one method: a line per tested frame.
std::string estimates_document(const BenchmarkResult& result, const MethodResult& method);

/// Fails early if a file asked for cannot be written. @throws FileError
void check_outputs(const CommonOptions& options);
/// Fails early if there is no folder for the pictures that --pictures PREFIX asks for; an empty prefix asks for none. @throws FileError
void check_pictures(const std::string& prefix);
/// Writes the files asked for and returns a line for people about each. @throws FileError
std::string write_outputs(const CommonOptions& options, const BenchmarkResult& result);

}  // namespace foothold::benchmark
