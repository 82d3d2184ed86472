// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/scene_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "foothold/base/binary_stream.h"
#include "foothold/base/checksum.h"
#include "foothold/base/contract.h"
#include "foothold/io/atomic_file.h"
#include "scene_stream.h"
#include "settings_json.h"
#include "text_file.h"

namespace foothold {
namespace io {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<char, 8> kMagic{'F', 'H', 'S', 'C', 'E', 'N', 'E', '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kMaxHeadBytes = 1U << 20U;
constexpr std::uint32_t kMaxNameBytes = 64;

/// What a scene file begins with. Little-endian, like every machine that Foothold runs on.
struct FixedHead {
  std::array<char, 8> magic{};
  std::uint32_t version = 0;
  std::uint32_t text_bytes = 0;
  std::uint64_t text_checksum = 0;
};
static_assert(sizeof(FixedHead) == 24, "written as bytes");

template <class T>
T read_raw(std::istream& file, const std::string& name, const std::string& what) {
  T value{};
  file.read(reinterpret_cast<char*>(&value), sizeof(T));
  if (!file) throw FileError(name + ": ends early, in the " + what + " of the scene");
  return value;
}

/// The description as JSON. Characters that JSON does not allow, such as those of a path in another encoding, are replaced.
std::string to_json(const SceneDescription& description) {
  Json root = Json::object();
  root["settings"] = Json::object();
  root["provenance"] = Json::object();
  for (const SettingText& setting : description.settings) root["settings"][setting.path] = setting.text;
  for (const SettingText& entry : description.provenance) root["provenance"][entry.path] = entry.text;
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

SceneDescription from_json(const std::string& text, const std::string& name) {
  const std::string settings_prefix = "settings.";
  const std::string provenance_prefix = "provenance.";
  SceneDescription description;
  std::vector<SettingText> leaves;
  try {
    leaves = parse_settings_json(text, name);
  } catch (const InvalidSettings& error) {
    throw FileError(error.what());  // nobody typed it
  }
  for (const SettingText& leaf : leaves) {
    if (leaf.path.compare(0, settings_prefix.size(), settings_prefix) == 0) {
      description.settings.push_back({leaf.path.substr(settings_prefix.size()), leaf.text});
    } else if (leaf.path.compare(0, provenance_prefix.size(), provenance_prefix) == 0) {
      description.provenance.push_back({leaf.path.substr(provenance_prefix.size()), leaf.text});
    } else {
      throw_file_error(name, "entry " + in_quotes(leaf.path), "settings and provenance only");
    }
  }
  return description;
}

/// Reads a part's name and contents.
void read_part(std::istream& file, const std::string& name, const LoadedPart& wanted, std::uint64_t& checksum) {
  const auto name_bytes = read_raw<std::uint32_t>(file, name, "name of part '" + wanted.name + "'");
  if (name_bytes == 0 || name_bytes > kMaxNameBytes) {
    throw_file_error(name, "a part's name of " + std::to_string(name_bytes) + " bytes", "1 to " + std::to_string(kMaxNameBytes));
  }
  std::string part_name(name_bytes, '\0');
  file.read(part_name.data(), name_bytes);
  if (!file) throw FileError(name + ": ends early, in the name of part '" + wanted.name + "'");
  if (part_name != wanted.name) throw_file_error(name, "part " + in_quotes(part_name), "part '" + wanted.name + "'");
  checksum = fnv1a(checksum, part_name.data(), part_name.size());

  PieceReader pieces(file, checksum);
  std::istream stream(&pieces);
  const auto check = [&] {
    if (!pieces.error().empty()) throw FileError(name + ": part '" + wanted.name + "' " + pieces.error());
  };
  try {
    wanted.part->load(stream);
  } catch (const FileError& error) {
    check();  // the file's damage explains what the part complains about
    throw FileError(name + ": " + error.what());
  }
  const bool at_end = stream.peek() == std::istream::traits_type::eof();
  check();
  if (!at_end) throw FileError(name + ": part '" + wanted.name + "' goes on where its end was expected");
}

}  // namespace

void write_scene(std::ostream& file, const SceneDescription& description, const std::vector<SavedPart>& parts) {
  const std::string text = to_json(description);
  FOOTHOLD_EXPECTS(text.size() <= kMaxHeadBytes);
  std::uint64_t checksum = fnv1a(kFnvBasis, text.data(), text.size());
  write_value(file, FixedHead{kMagic, kVersion, static_cast<std::uint32_t>(text.size()), checksum});
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  write_value(file, static_cast<std::uint32_t>(parts.size()));
  for (const SavedPart& part : parts) {
    FOOTHOLD_EXPECTS(part.part != nullptr && !part.name.empty() && part.name.size() <= kMaxNameBytes);
    write_value(file, static_cast<std::uint32_t>(part.name.size()));
    file.write(part.name.data(), static_cast<std::streamsize>(part.name.size()));
    checksum = fnv1a(checksum, part.name.data(), part.name.size());
    PieceWriter pieces(file, checksum);
    std::ostream stream(&pieces);
    part.part->save(stream);
    pieces.finish();
  }
}

SceneDescription read_scene_head(std::istream& file, const std::string& name, std::uint64_t& checksum) {
  const auto magic = read_raw<std::array<char, 8>>(file, name, "first bytes");
  if (magic != kMagic) throw FileError(name + ": not a scene of Foothold: unknown first bytes");
  const auto version = read_raw<std::uint32_t>(file, name, "version");
  if (version != kVersion) throw_file_error(name, "a scene of version " + std::to_string(version), "version " + std::to_string(kVersion));
  const auto text_bytes = read_raw<std::uint32_t>(file, name, "head");
  if (text_bytes > kMaxHeadBytes) {
    throw_file_error(name, "a description of " + std::to_string(text_bytes) + " bytes", "at most " + std::to_string(kMaxHeadBytes));
  }
  const auto expected = read_raw<std::uint64_t>(file, name, "head");
  std::string text(text_bytes, '\0');
  file.read(text.data(), text_bytes);
  if (!file) throw FileError(name + ": ends early, in the description of the scene");
  checksum = fnv1a(kFnvBasis, text.data(), text.size());
  if (checksum != expected) {
    throw FileError(name + ": description damaged: checksum " + std::to_string(checksum) + ", expected " + std::to_string(expected));
  }
  return from_json(text, name);
}

SceneDescription read_scene(std::istream& file, const std::string& name, const std::vector<LoadedPart>& parts) {
  std::uint64_t checksum = 0;
  SceneDescription description = read_scene_head(file, name, checksum);
  const auto num_parts = read_raw<std::uint32_t>(file, name, "number of parts");
  if (num_parts != parts.size()) throw_file_error(name, std::to_string(num_parts) + " parts", std::to_string(parts.size()));
  for (const LoadedPart& part : parts) {
    FOOTHOLD_EXPECTS(part.part != nullptr);
    read_part(file, name, part, checksum);
  }
  if (file.peek() != std::istream::traits_type::eof()) throw FileError(name + ": goes on where the scene's end was expected");
  return description;
}

namespace {

std::ifstream open_scene(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path + ": cannot be opened: " + std::strerror(errno));
  return file;
}

}  // namespace
}  // namespace io

void save_scene(const std::string& path, const SceneDescription& description, const std::vector<SavedPart>& parts) {
  AtomicFile file(path);
  try {
    io::write_scene(file.stream(), description, parts);
  } catch (const FileError&) {
    if (!file.stream()) file.commit();  // which knows why
    throw;
  }
  file.commit();
}

SceneDescription read_scene_description(const std::string& path) {
  std::ifstream file = io::open_scene(path);
  std::uint64_t checksum = 0;
  return io::read_scene_head(file, path, checksum);
}

SceneDescription load_scene(const std::string& path, const std::vector<LoadedPart>& parts) {
  std::ifstream file = io::open_scene(path);
  return io::read_scene(file, path, parts);
}

}  // namespace foothold
