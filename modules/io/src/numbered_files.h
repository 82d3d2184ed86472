// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Images and poses that are numbered in their names.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>

namespace foothold::io {

/// The files of a folder whose names begin with `prefix` and end in one of some extensions, by the first number in their names. Of two
/// files with one number, the one whose extension is named first counts. Empty if there is no such folder.
std::map<long, std::filesystem::path> numbered_files(const std::filesystem::path& folder, const std::string& prefix,
                                                     std::initializer_list<const char*> extensions);

/// The first of some subfolders that exists; empty if none does.
std::filesystem::path first_folder(const std::filesystem::path& folder, std::initializer_list<const char*> names);

}  // namespace foothold::io
