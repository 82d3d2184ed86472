// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <filesystem>

#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"
#include "outputs.h"
#include "plot.h"

namespace foothold::benchmark {
namespace {

/// "poses.txt" of method "ferns" among several becomes "poses.ferns.txt".
std::string estimates_path(const std::string& path, const std::string& method, bool only_method) {
  if (only_method) return path;
  const std::filesystem::path whole(path);
  return (whole.parent_path() / (whole.stem().string() + "." + method + whole.extension().string())).string();
}

}  // namespace

void check_outputs(const CommonOptions& options) {
  for (const std::string& path : {options.json_file, options.csv_file, options.plot_file, options.estimates_file}) {
    if (!path.empty()) expect_writable(path);
  }
  const std::string extension = std::filesystem::path(options.plot_file).extension().string();
  if (!options.plot_file.empty() && extension != ".png")
    throw InvalidSettings("--plot: got '" + options.plot_file + "', expected a name that ends in .png");
}

void check_pictures(const std::string& prefix) {
  if (prefix.empty()) return;
  const std::filesystem::path folder = std::filesystem::absolute(prefix).parent_path();
  if (!std::filesystem::is_directory(folder)) throw FileError(folder.string() + ": no such folder; expected one for --pictures");
}

std::string write_outputs(const CommonOptions& options, const BenchmarkResult& result) {
  std::string told;
  const auto tell = [&](const std::string& what, const std::string& path) { told += "\n" + what + ": " + path; };
  if (!options.json_file.empty()) {
    write_file_atomically(options.json_file, json_document(result));
    tell("results", options.json_file);
  }
  if (!options.csv_file.empty()) {
    write_file_atomically(options.csv_file, csv_document(result));
    tell("frames", options.csv_file);
  }
  if (!options.estimates_file.empty()) {
    for (const MethodResult& method : result.methods) {
      const std::string path = estimates_path(options.estimates_file, method.name, result.methods.size() == 1);
      write_file_atomically(path, estimates_document(result, method));
      tell("poses", path);
    }
  }
  if (!options.plot_file.empty()) {
    write_plot(options.plot_file, result);
    tell("picture", options.plot_file);
  }
  return told.empty() ? told : told + "\n";
}

}  // namespace foothold::benchmark
