// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Everything that Foothold saves, to be disturbed.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace foothold::test {

/// One kind of save.
struct SaveCase {
  std::string name;
  /// Leaves an older state in an empty folder. @return What saves the newer one there.
  std::function<std::function<void()>(const std::string& folder)> prepare;
  bool is_one_file = true;  ///< false: a recording, whose frames are several files
};

std::vector<SaveCase> all_saves();

/// The bytes of all files of a folder.
using FolderContents = std::map<std::string, std::string>;
FolderContents contents_of(const std::string& folder);

/// A folder before and after a save that nothing disturbs.
struct SaveStates {
  FolderContents before;
  FolderContents after;
};
SaveStates undisturbed(const SaveCase& save_case);

}  // namespace foothold::test
