// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Bytes under a path, for parsers that want one.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <string>

namespace foothold::fuzz {

/// A file that lies in memory alone.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    if (descriptor_ < 0 || ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) __builtin_trap();
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace foothold::fuzz
