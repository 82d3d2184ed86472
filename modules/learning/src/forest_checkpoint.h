// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The memory of an interrupted training: a file to which finished scenes and levels are appended. Format: docs/forest-format.md.
#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "foothold/base/checked_stream.h"
#include "forest_examples.h"
#include "forest_grower.h"

namespace foothold {

class ForestCheckpoint {
 public:
  /// A checkpoint that remembers nothing.
  ForestCheckpoint() = default;

  /// Starts a new file. @throws FileError
  static ForestCheckpoint create(const std::string& path, std::uint64_t training);

  /// Reads a file and goes on behind its last whole record: the rest is what an interruption cut short.
  /// @param training  Names the training; another one's file is refused.
  /// @param examples  Receives the examples of the finished scenes. num_features and paired are set.
  /// @param levels    Receives the finished levels.
  /// @throws FileError naming the file, what was found and what was expected.
  static ForestCheckpoint resume(const std::string& path, std::uint64_t training, ForestExamples& examples,
                                 std::vector<ForestLevel>& levels);

  /// Remembers the last scene of the examples. @throws FileError
  void add_scene(const ForestExamples& examples);
  /// @throws FileError
  void add_level(const ForestLevel& level);

 private:
  ForestCheckpoint(std::string path, std::ofstream stream, std::uint64_t chain)
      : path_(std::move(path)), stream_(std::move(stream)), chain_(chain) {}
  void append(const BinaryFormat& format, const std::function<void(CheckedWriter&)>& write);

  std::string path_;
  std::ofstream stream_;
  std::uint64_t chain_ = kFnvBasis;  ///< checksum of all records so far
};

}  // namespace foothold
