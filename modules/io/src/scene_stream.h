// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Scene files as streams. See docs/scene-format.md.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "foothold/io/scene_file.h"

namespace foothold::io {

/// save_scene() to a stream. @throws FileError if a part cannot be written.
void write_scene(std::ostream& file, const SceneDescription& description, const std::vector<SavedPart>& parts);

/// load_scene() from a stream. @param name stands for the file in messages. @throws FileError
SceneDescription read_scene(std::istream& file, const std::string& name, const std::vector<LoadedPart>& parts);

}  // namespace foothold::io
