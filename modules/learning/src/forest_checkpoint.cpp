// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_checkpoint.h"

#include <filesystem>
#include <utility>

namespace foothold {
namespace {

constexpr BinaryFormat kHeadFormat{"checkpoint of a training", "FHFTRAIN", 2};
constexpr BinaryFormat kRecordFormat{"record of a training", "FHFTRECO", 1};
constexpr std::uint64_t kMaxItems = std::uint64_t{1} << 32U;

enum RecordKind : std::uint32_t { kScene = 1, kLevel = 2 };

/// The records of a file, one after another.
class RecordReader {
 public:
  RecordReader(std::string path, ForestExamples& examples, std::vector<ForestLevel>& levels)
      : path_(std::move(path)), examples_(examples), levels_(levels) {}

  void read_all(std::istream& stream, std::uint64_t training, std::uint64_t num_bytes) {
    CheckedReader head(stream, kHeadFormat, path_);
    if (head.read<std::uint64_t>("name") != training) {
      head.refuse("the checkpoint of another training, expected one with the same sequences and settings");
    }
    chain_ = head.finish();
    num_whole_bytes_ = position(stream);
    while (num_whole_bytes_ < num_bytes) {
      try {
        read_record(stream);
      } catch (const TruncatedFile&) {
        return;
      }
      num_whole_bytes_ = position(stream);
    }
  }

  std::uint64_t num_whole_bytes() const { return num_whole_bytes_; }
  std::uint64_t chain() const { return chain_; }

 private:
  static std::uint64_t position(std::istream& stream) { return static_cast<std::uint64_t>(std::streamoff(stream.tellg())); }

  void read_record(std::istream& stream) {
    CheckedReader reader(stream, kRecordFormat, path_, chain_);
    const auto kind = reader.read<std::uint32_t>("kind");
    if (kind == kScene) {
      const auto points = reader.read_array<Eigen::Vector3f>("points", 0, kMaxItems);
      const std::uint64_t num_values = points.size() * examples_.row_size();
      const auto values = reader.read_array<std::int16_t>("feature values", num_values, num_values);
      chain_ = reader.finish();
      examples_.points_world.insert(examples_.points_world.end(), points.begin(), points.end());
      examples_.values.insert(examples_.values.end(), values.begin(), values.end());
      if (examples_.scene_begins.empty()) examples_.scene_begins.push_back(0);
      examples_.scene_begins.push_back(examples_.size());
    } else if (kind == kLevel) {
      auto level = reader.read_array<NodeDecision>("decisions", 0, kMaxItems);
      chain_ = reader.finish();
      levels_.push_back(std::move(level));
    } else {
      reader.refuse("a record has kind " + std::to_string(kind) + ", expected 1 or 2");
    }
  }

  std::string path_;
  ForestExamples& examples_;
  std::vector<ForestLevel>& levels_;
  std::uint64_t num_whole_bytes_ = 0;
  std::uint64_t chain_ = kFnvBasis;
};

}  // namespace

ForestCheckpoint ForestCheckpoint::create(const std::string& path, std::uint64_t training) {
  ForestCheckpoint checkpoint(path, std::ofstream(path, std::ios::binary | std::ios::trunc), kFnvBasis);
  checkpoint.append(kHeadFormat, [&](CheckedWriter& writer) { writer.write(training); });
  return checkpoint;
}

ForestCheckpoint ForestCheckpoint::resume(const std::string& path, std::uint64_t training, ForestExamples& examples,
                                          std::vector<ForestLevel>& levels) {
  std::error_code error;
  const std::uint64_t file_bytes = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) throw FileError(path + ": cannot be opened; expected a training's checkpoint");
  RecordReader records(path, examples, levels);
  try {
    records.read_all(stream, training, file_bytes);
  } catch (const FileError& damage) {
    throw FileError(damage.what() + std::string("; delete the file to train from the beginning"));
  }
  stream.close();
  std::filesystem::resize_file(path, records.num_whole_bytes(), error);
  if (error) throw FileError(path + ": cannot be shortened to its last whole record; is it writable?");
  return {path, std::ofstream(path, std::ios::binary | std::ios::app), records.chain()};
}

void ForestCheckpoint::add_scene(const ForestExamples& examples) {
  if (path_.empty()) return;
  const std::size_t first = examples.scene_begins[examples.scene_begins.size() - 2];
  const std::size_t count = examples.size() - first;
  append(kRecordFormat, [&](CheckedWriter& writer) {
    writer.write(kScene);
    writer.write_array(Span<const Eigen::Vector3f>(examples.points_world.data() + first, count));
    writer.write_array(Span<const std::int16_t>(examples.row(first), count * examples.row_size()));
  });
}

void ForestCheckpoint::add_level(const ForestLevel& level) {
  if (path_.empty()) return;
  append(kRecordFormat, [&](CheckedWriter& writer) {
    writer.write(kLevel);
    writer.write_array(level);
  });
}

void ForestCheckpoint::append(const BinaryFormat& format, const std::function<void(CheckedWriter&)>& write) {
  try {
    CheckedWriter writer(stream_, format, chain_);
    write(writer);
    chain_ = writer.finish();
  } catch (const FileError&) {
    throw FileError(path_ + ": cannot be written; is the folder there and writable, and the disk not full?");
  }
}

}  // namespace foothold
