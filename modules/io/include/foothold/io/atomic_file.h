// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Files that appear complete or not at all.
#pragma once

#include <memory>
#include <ostream>
#include <string>

namespace foothold {

/// How safe a committed file is.
enum class Durability {
  kPowerCut,  ///< the old file or the new one, whole, even if the power fails; waits for the disk
  kCrash,     ///< the same if the program crashes; for files by the thousand, such as the frames of a recording
};

/// Writes under a temporary name in the same folder and moves the file to its place on commit(). Without a commit, nothing changes.
class AtomicFile {
 public:
  /// @throws FileError if the folder does not exist or may not be written to.
  explicit AtomicFile(const std::string& path, Durability durability = Durability::kPowerCut);
  /// Deletes the temporary file unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write. Not seekable. Failures are remembered and reported by commit().
  std::ostream& stream();

  /// Flushes, to the disk if asked to, and replaces the file of the final name. @throws FileError saying why not (such as a full disk); the
  /// old file stays.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Replaces a file by the given bytes, or leaves the old one intact. @throws FileError
void write_file_atomically(const std::string& path, const std::string& bytes, Durability durability = Durability::kPowerCut);

}  // namespace foothold
