// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Whole reconstructions in one file: the map, what the relocaliser has learnt, the settings, and where it all comes from.
///
/// The file (docs/scene-format.md) is versioned and checksummed throughout: damage is told before a part sees it.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "foothold/base/persistent.h"
#include "foothold/files/settings_file.h"

namespace foothold {

/// What a scene file says of itself. Paths and names occur once each.
struct SceneDescription {
  std::vector<SettingText> settings;    ///< all that it was made with
  std::vector<SettingText> provenance;  ///< for people: program, source of the frames, time, ...
};

/// The settings of a struct as a scene file keeps them.
template <class Settings>
std::vector<SettingText> scene_settings(const Settings& settings) {
  std::vector<SettingText> result;
  for (const SettingDescription& setting : describe_settings(settings)) result.push_back({setting.path, setting.value});
  return result;
}

/// Something that belongs to a scene and can be written to a stream.
struct SavedPart {
  std::string name;                  ///< 1 to 64 characters
  const Persistent* part = nullptr;  ///< what is written; not owned
};

/// Something that receives what was saved under its name.
struct LoadedPart {
  std::string name;            ///< the name under which it was saved
  Persistent* part = nullptr;  ///< what reads it; not owned
};

/// Writes a scene. @throws FileError if a part cannot be written.
void write_scene(std::ostream& stream, const SceneDescription& description, const std::vector<SavedPart>& parts);

/// Writes a scene. The file of that name is replaced once all of it is on the disk; on failure it stays. @throws FileError
void save_scene(const std::string& path, const SceneDescription& description, const std::vector<SavedPart>& parts);

/// Reads what a scene file says of itself, without its parts.
/// @throws FileError naming the file: missing, not a scene, of another version, cut short or damaged.
SceneDescription read_scene_description(const std::string& path);

/// Refuses a scene by its description, before any part is read, by throwing.
using SceneCheck = std::function<void(const SceneDescription&)>;

/// Reads a scene's parts, in the order in which they were saved, to the end of the stream.
///
/// A part keeps its former state unless it was read whole, but those before it have theirs replaced by then: load into fresh objects, and
/// drop them on failure.
/// @param name   Stands for the stream in messages.
/// @param check  May refuse the scene; none accepts all.
/// @throws FileError as read_scene_description(), if the parts are others than those saved, or if one of them refuses what it reads; and
///         what `check` throws.
SceneDescription read_scene(std::istream& stream, const std::string& name, const std::vector<LoadedPart>& parts,
                            const SceneCheck& check = nullptr);

/// read_scene() from a file.
SceneDescription load_scene(const std::string& path, const std::vector<LoadedPart>& parts, const SceneCheck& check = nullptr);

}  // namespace foothold
