// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>

#include "foothold/io/sequence.h"
#include "seven_scenes_sequence.h"
#include "text_file.h"

namespace foothold {
namespace {

namespace fs = std::filesystem;

/// Turns "sequence7" into "seq-07".
std::string sequence_folder(const io::TextLine& line, const fs::path& file) {
  constexpr std::string_view kPrefix = "sequence";
  const std::string_view word = line.words.front();
  int number = 0;
  const char* begin = word.data() + std::min(word.size(), kPrefix.size());
  const auto [end, error] = std::from_chars(begin, word.data() + word.size(), number);
  const bool well_formed = line.words.size() == 1 && word.substr(0, kPrefix.size()) == kPrefix && error == std::errc() &&
                           end == word.data() + word.size() && number > 0 && number < 1000;
  if (!well_formed) throw_file_error(file, in_quotes(word) + " in line " + std::to_string(line.number), "sequenceN");
  std::array<char, 16> name{};
  std::snprintf(name.data(), name.size(), "seq-%02d", number);
  return name.data();
}

}  // namespace

std::vector<std::string> io::parse_split(std::string_view text, const fs::path& file) {
  std::vector<std::string> sequences;
  for (const TextLine& line : split_lines(text)) sequences.push_back(sequence_folder(line, file));
  if (sequences.empty()) throw_file_error(file, "no sequence", "lines of sequenceN");
  return sequences;
}

std::vector<std::string> read_split(const std::string& scene_folder, const std::string& split) {
  if (split != "train" && split != "test") throw InvalidSettings("split: got '" + split + "', expected train or test");
  const fs::path folder = scene_folder;
  const fs::path file = folder / (split == "train" ? "TrainSplit.txt" : "TestSplit.txt");
  if (!fs::is_directory(folder)) throw FileError(scene_folder + ": no such folder; expected the folder of a 7-Scenes scene");
  if (!fs::exists(file)) {
    const fs::path parent = fs::absolute(folder).lexically_normal().parent_path();
    const bool is_sequence = fs::exists(folder / "frame-000000.depth.png");
    throw FileError(file.string() + ": no such file; expected the folder of a 7-Scenes scene, which holds seq-01, seq-02, ..." +
                    (is_sequence ? " This is one of its sequences; its scene would be " + parent.string() : ""));
  }
  std::vector<std::string> sequences;
  for (const std::string& name : io::parse_split(io::read_text(file, io::kMaxNumbersFileBytes), file)) {
    const fs::path sequence = folder / name;
    if (!fs::is_directory(sequence)) {
      const fs::path packed = sequence.string() + ".zip";
      throw FileError(sequence.string() + ": no such folder, but " + file.string() + " lists it" +
                      (fs::exists(packed) ? "; unpack " + packed.string() : ""));
    }
    sequences.push_back(sequence.string());
  }
  return sequences;
}

}  // namespace foothold
