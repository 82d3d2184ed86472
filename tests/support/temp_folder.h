// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A place for the files of one test, which no other test running at the same time shares.
#pragma once

#include <filesystem>
#include <string>

namespace foothold::test {

/// A new folder, deleted with all it holds at the end of the test.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Files directly inside.
  int num_files() const;

 private:
  std::filesystem::path path_;
};

void write_text(const std::string& path, const std::string& text);
std::string read_text(const std::string& path);

}  // namespace foothold::test
