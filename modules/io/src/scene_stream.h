// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scene files as streams: pieces of bounded size, each with the checksum of all that came before. See docs/scene-format.md.
#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

#include "foothold/io/scene_file.h"

namespace foothold::io {

/// Bytes in a piece at most.
inline constexpr std::uint32_t kMaxPieceBytes = 1U << 20U;

/// Cuts what is written to it into pieces.
class PieceWriter : public std::streambuf {
 public:
  /// @param checksum  continued over all that is written.
  PieceWriter(std::ostream& file, std::uint64_t& checksum);
  /// Writes what is left and the end mark.
  void finish();

 protected:
  int_type overflow(int_type c) override;

 private:
  void write_piece();

  std::ostream& file_;
  std::uint64_t& checksum_;
  std::vector<char> buffer_;
};

/// Hands out the contents of pieces, each only when its checksum is right, until the end mark.
class PieceReader : public std::streambuf {
 public:
  PieceReader(std::istream& file, std::uint64_t& checksum) : file_(file), checksum_(checksum) {}
  /// What is wrong with the file; empty as long as nothing is.
  const std::string& error() const { return error_; }

 protected:
  int_type underflow() override;

 private:
  bool read_piece();

  std::istream& file_;
  std::uint64_t& checksum_;
  std::vector<char> buffer_;
  std::string error_;
  bool ended_ = false;
};

/// save_scene() to a stream. @throws FileError if a part cannot be written.
void write_scene(std::ostream& file, const SceneDescription& description, const std::vector<SavedPart>& parts);

/// Reads the head of a scene. @param name stands for the file in messages. @param checksum receives that of the head. @throws FileError
SceneDescription read_scene_head(std::istream& file, const std::string& name, std::uint64_t& checksum);

/// load_scene() from a stream. @throws FileError
SceneDescription read_scene(std::istream& file, const std::string& name, const std::vector<LoadedPart>& parts);

}  // namespace foothold::io
