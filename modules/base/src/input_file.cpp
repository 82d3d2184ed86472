// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/input_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace foothold {

void throw_file_error(const std::filesystem::path& file, const std::string& found, const std::string& expected) {
  throw FileError(file.string() + ": got " + found + ", expected " + expected);
}

std::string read_file(const std::filesystem::path& file, std::size_t max_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) throw FileError(file.string() + ": no such file");
  if (std::filesystem::is_directory(status)) throw_file_error(file, "a folder", "a file");
  if (!error && !std::filesystem::is_regular_file(status)) throw_file_error(file, "a pipe or device", "a file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string() + ": cannot be opened for reading: " + std::strerror(errno));
  std::string bytes;
  char block[1U << 16U];
  while (stream.read(block, sizeof block) || stream.gcount() > 0) {
    bytes.append(block, static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > max_bytes) {
      throw_file_error(file, "more than " + std::to_string(max_bytes) + " bytes", "a smaller file of this kind");
    }
  }
  if (stream.bad()) throw FileError(file.string() + ": reading failed: " + std::strerror(errno));
  return bytes;
}

}  // namespace foothold
