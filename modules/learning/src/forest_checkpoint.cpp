// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "forest_checkpoint.h"

#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"

namespace foothold {
namespace {

constexpr char kMagic[8] = {'F', 'H', 'F', 'T', 'R', 'A', 'I', 'N'};
constexpr std::uint32_t kVersion = 1;

struct FileHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t reserved;
  std::uint64_t training;
};
static_assert(sizeof(FileHeader) == 24, "the file format");

enum RecordKind : std::uint32_t { kScene = 1, kLevel = 2 };

/// A record holds `count` examples (their points, then their rows) or `count` decisions.
struct RecordHeader {
  std::uint32_t kind;
  std::uint32_t reserved;
  std::uint64_t count;
  std::uint64_t checksum;  // FNV-1a of kind, count and all that follows
};
static_assert(sizeof(RecordHeader) == 24, "the file format");

std::uint64_t begin_checksum(RecordKind kind, std::uint64_t count) {
  const std::uint64_t words[2] = {kind, count};
  return fnv1a(kFnvBasis, words, sizeof(words));
}

std::size_t bytes_per_item(RecordKind kind, const ForestExamples& examples) {
  return kind == kScene ? sizeof(Eigen::Vector3f) + examples.row_size() * sizeof(std::int16_t) : sizeof(NodeDecision);
}

void write_bytes(std::ostream& stream, const void* data, std::size_t num_bytes) {
  stream.write(static_cast<const char*>(data), static_cast<std::streamsize>(num_bytes));
}

void read_bytes(std::istream& stream, void* data, std::size_t num_bytes) {
  stream.read(static_cast<char*>(data), static_cast<std::streamsize>(num_bytes));
}

[[noreturn]] void reject(const std::string& path, const std::string& what) {
  throw FileError(path + ": " + what + "; delete the file to train from the beginning");
}

void check_header(const std::string& path, std::istream& stream, std::uint64_t training) {
  FileHeader header{};
  read_bytes(stream, &header, sizeof(header));
  if (!stream || std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
    reject(path, "not a training's checkpoint, expected the magic FHFTRAIN");
  if (header.version != kVersion)
    reject(path, "checkpoint format version is " + std::to_string(header.version) + ", expected " + std::to_string(kVersion));
  if (header.training != training) reject(path, "the checkpoint of another training, expected one with the same sequences and settings");
}

void read_scene(std::istream& stream, std::uint64_t count, ForestExamples& examples, std::uint64_t& checksum) {
  const std::size_t first = examples.size();
  examples.points_world.resize(first + count);
  examples.values.resize((first + count) * examples.row_size());
  auto* points = examples.points_world.data() + first;
  auto* values = examples.values.data() + first * examples.row_size();
  read_bytes(stream, points, count * sizeof(Eigen::Vector3f));
  read_bytes(stream, values, count * examples.row_size() * sizeof(std::int16_t));
  checksum = fnv1a(checksum, points, count * sizeof(Eigen::Vector3f));
  checksum = fnv1a(checksum, values, count * examples.row_size() * sizeof(std::int16_t));
  if (examples.scene_begins.empty()) examples.scene_begins.push_back(0);
  examples.scene_begins.push_back(examples.size());
}

/// Reads all whole records. @return The bytes of the file that they and the header take.
std::uint64_t read_records(const std::string& path, std::istream& stream, std::uint64_t file_bytes, ForestExamples& examples,
                           std::vector<ForestLevel>& levels) {
  std::uint64_t end = sizeof(FileHeader);
  while (file_bytes - end >= sizeof(RecordHeader)) {
    RecordHeader header{};
    read_bytes(stream, &header, sizeof(header));
    if (header.reserved != 0 || (header.kind != kScene && header.kind != kLevel))
      reject(path, "damaged, a record has kind " + std::to_string(header.kind) + ", expected 1 or 2");
    const auto kind = static_cast<RecordKind>(header.kind);
    const std::uint64_t room = (file_bytes - end - sizeof(header)) / bytes_per_item(kind, examples);
    if (header.count > room) break;
    std::uint64_t checksum = begin_checksum(kind, header.count);
    if (kind == kScene) {
      read_scene(stream, header.count, examples, checksum);
    } else {
      ForestLevel level(header.count);
      read_bytes(stream, level.data(), level.size() * sizeof(NodeDecision));
      checksum = fnv1a(checksum, level.data(), level.size() * sizeof(NodeDecision));
      levels.push_back(std::move(level));
    }
    if (!stream) reject(path, "cannot be read");
    if (checksum != header.checksum)
      reject(path, "damaged, a record's checksum is " + std::to_string(checksum) + ", expected " + std::to_string(header.checksum));
    end += sizeof(header) + header.count * bytes_per_item(kind, examples);
  }
  return end;
}

}  // namespace

ForestCheckpoint ForestCheckpoint::create(const std::string& path, std::uint64_t training) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  FileHeader header{{}, kVersion, 0, training};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  write_bytes(stream, &header, sizeof(header));
  ForestCheckpoint checkpoint(path, std::move(stream));
  checkpoint.finish_record();
  return checkpoint;
}

ForestCheckpoint ForestCheckpoint::resume(const std::string& path, std::uint64_t training, ForestExamples& examples,
                                          std::vector<ForestLevel>& levels) {
  std::error_code error;
  const std::uint64_t file_bytes = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) throw FileError(path + ": cannot be opened; expected a training's checkpoint");
  check_header(path, stream, training);
  const std::uint64_t end = read_records(path, stream, file_bytes, examples, levels);
  stream.close();
  std::filesystem::resize_file(path, end, error);
  if (error) throw FileError(path + ": cannot be shortened to its last whole record; is it writable?");
  return {path, std::ofstream(path, std::ios::binary | std::ios::app)};
}

void ForestCheckpoint::add_scene(const ForestExamples& examples) {
  if (path_.empty()) return;
  const std::size_t first = examples.scene_begins[examples.scene_begins.size() - 2];
  const std::uint64_t count = examples.size() - first;
  const std::size_t row_bytes = count * examples.row_size() * sizeof(std::int16_t);
  std::uint64_t checksum = begin_checksum(kScene, count);
  checksum = fnv1a(checksum, examples.points_world.data() + first, count * sizeof(Eigen::Vector3f));
  checksum = fnv1a(checksum, examples.row(first), row_bytes);
  const RecordHeader header{kScene, 0, count, checksum};
  write_bytes(stream_, &header, sizeof(header));
  write_bytes(stream_, examples.points_world.data() + first, count * sizeof(Eigen::Vector3f));
  write_bytes(stream_, examples.row(first), row_bytes);
  finish_record();
}

void ForestCheckpoint::add_level(const ForestLevel& level) {
  if (path_.empty()) return;
  const std::size_t num_bytes = level.size() * sizeof(NodeDecision);
  const RecordHeader header{kLevel, 0, level.size(), fnv1a(begin_checksum(kLevel, level.size()), level.data(), num_bytes)};
  write_bytes(stream_, &header, sizeof(header));
  write_bytes(stream_, level.data(), num_bytes);
  finish_record();
}

void ForestCheckpoint::finish_record() {
  stream_.flush();
  if (!stream_) throw FileError(path_ + ": cannot be written; is the folder there and writable, and the disk not full?");
}

}  // namespace foothold
