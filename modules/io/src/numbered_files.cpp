// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "numbered_files.h"

#include <algorithm>
#include <charconv>

namespace foothold::io {

namespace fs = std::filesystem;

std::map<long, fs::path> numbered_files(const fs::path& folder, const std::string& prefix, std::initializer_list<const char*> extensions) {
  std::map<long, fs::path> files;
  const auto rank = [&](const fs::path& file) {
    return std::find(extensions.begin(), extensions.end(), file.extension().string()) - extensions.begin();
  };
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(prefix, 0) != 0 || rank(entry.path()) == static_cast<std::ptrdiff_t>(extensions.size())) continue;
    const std::size_t digit = name.find_first_of("0123456789");
    long number = 0;
    if (digit == std::string::npos || std::from_chars(name.data() + digit, name.data() + name.size(), number).ec != std::errc()) continue;
    const auto [place, is_new] = files.emplace(number, entry.path());
    if (!is_new && rank(entry.path()) < rank(place->second)) place->second = entry.path();
  }
  return files;
}

fs::path first_folder(const fs::path& folder, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (fs::is_directory(folder / name)) return folder / name;
  }
  return {};
}

}  // namespace foothold::io
