// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/temp_folder.h"

#include <stdlib.h>

#include <fstream>
#include <iterator>

#include "foothold/base/error.h"

namespace foothold::test {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
  std::string name = (fs::temp_directory_path() / "foothold-test-").string() + std::string(6, 'X');  // as mkdtemp asks
  if (::mkdtemp(name.data()) == nullptr) throw FileError(name + ": cannot be created");
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

int TempFolder::num_files() const { return static_cast<int>(std::distance(fs::directory_iterator(path_), fs::directory_iterator())); }

void write_text(const std::string& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
}

std::string read_text(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace foothold::test
