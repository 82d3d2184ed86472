// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/files/scene_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "foothold/base/atomic_file.h"
#include "foothold/base/checked_stream.h"
#include "foothold/base/contract.h"
#include "foothold/base/input_file.h"
#include "foothold/base/printable.h"
#include "settings_json.h"

namespace foothold {
namespace {

using Json = nlohmann::ordered_json;

constexpr BinaryFormat kSceneFormat{"scene", "FHSCENE\n", 3};
constexpr BinaryFormat kPartFormat{"part of a scene", "FHPART\r\n", 1};
constexpr std::uint64_t kMaxDescriptionBytes = 1U << 20U;
constexpr std::uint64_t kMaxParts = 64;
constexpr std::uint64_t kMaxNameBytes = 64;

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
    leaves = files::parse_settings_json(text, name);
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

/// What a scene file begins with.
struct Head {
  SceneDescription description;
  std::vector<std::string> part_names;
  std::uint64_t checksum = 0;  ///< with which the parts go on
};

Head read_head(std::istream& file, const std::string& name) {
  CheckedReader reader(file, kSceneFormat, name);
  const std::string text = reader.read_text("bytes of description", kMaxDescriptionBytes);
  const auto num_parts = reader.read<std::uint64_t>("number of parts");
  reader.check_range("parts", num_parts, 0, kMaxParts);
  Head head;
  while (head.part_names.size() < num_parts) head.part_names.push_back(reader.read_text("bytes of a part's name", kMaxNameBytes));
  head.checksum = reader.finish();
  head.description = from_json(text, name);
  return head;
}

void check_names(const std::vector<std::string>& names, const std::vector<LoadedPart>& wanted, const std::string& file) {
  if (names.size() != wanted.size()) throw_file_error(file, std::to_string(names.size()) + " parts", std::to_string(wanted.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    FOOTHOLD_EXPECTS(wanted[i].part != nullptr);
    if (names[i] != wanted[i].name) throw_file_error(file, "part " + in_quotes(names[i]), "part '" + wanted[i].name + "'");
  }
}

/// @param checksum  of all that came before; receives that of all so far.
void read_part(std::istream& file, const std::string& name, const LoadedPart& wanted, std::uint64_t& checksum) {
  const std::string source = name + ": part '" + wanted.name + "'";
  CheckedReader reader(file, kPartFormat, source, checksum);
  try {
    wanted.part->load(reader.stream());
  } catch (const FileError& error) {
    reader.check();  // the file's damage explains what the part complains about
    throw FileError(source + ": " + error.what());
  }
  checksum = reader.finish();
}

std::ifstream open_scene(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path + ": cannot be opened: " + std::strerror(errno));
  return file;
}

}  // namespace

void write_scene(std::ostream& stream, const SceneDescription& description, const std::vector<SavedPart>& parts) {
  const std::string text = to_json(description);
  FOOTHOLD_EXPECTS(text.size() <= kMaxDescriptionBytes && parts.size() <= kMaxParts);
  CheckedWriter head(stream, kSceneFormat);
  head.write_text(text);
  head.write(static_cast<std::uint64_t>(parts.size()));
  for (const SavedPart& part : parts) {
    FOOTHOLD_EXPECTS(part.part != nullptr && !part.name.empty() && part.name.size() <= kMaxNameBytes);
    head.write_text(part.name);
  }
  std::uint64_t checksum = head.finish();
  for (const SavedPart& part : parts) {
    CheckedWriter writer(stream, kPartFormat, checksum);
    part.part->save(writer.stream());
    checksum = writer.finish();
  }
}

SceneDescription read_scene(std::istream& stream, const std::string& name, const std::vector<LoadedPart>& parts, const SceneCheck& check) {
  Head head = read_head(stream, name);
  if (check) check(head.description);
  check_names(head.part_names, parts, name);
  for (const LoadedPart& part : parts) read_part(stream, name, part, head.checksum);
  if (stream.peek() != std::istream::traits_type::eof()) throw FileError(name + ": goes on where the scene's end was expected");
  return head.description;
}

void save_scene(const std::string& path, const SceneDescription& description, const std::vector<SavedPart>& parts) {
  write_file_atomically(path, [&](std::ostream& file) { write_scene(file, description, parts); });
}

SceneDescription read_scene_description(const std::string& path) {
  std::ifstream file = open_scene(path);
  return read_head(file, path).description;
}

SceneDescription load_scene(const std::string& path, const std::vector<LoadedPart>& parts, const SceneCheck& check) {
  std::ifstream file = open_scene(path);
  return read_scene(file, path, parts, check);
}

}  // namespace foothold
