// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Files that appear complete or not at all.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>

namespace foothold {

/// How safe a committed file is.
enum class Durability {
  kPowerCut,  ///< the old file or the new one, whole, even if the power fails; waits for the disk
  kCrash,     ///< the same if the program crashes; for files by the thousand, such as the frames of a recording
};

/// Writes under a temporary name, NAME.N.tmp in the same folder, and moves the file to its place on commit(). Without a commit, nothing
/// changes.
///
/// Several writers of one file do not disturb each other: the last to commit wins. What a writer that was killed left behind is deleted by
/// the next one of that file. Symbolic links are followed. A file that is replaced keeps its permissions. Devices and pipes cannot be
/// replaced: they are written to directly.
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
  /// @throws FileError saying why (such as a full disk) if writing has failed so far.
  void check() const;

  /// Flushes, to the disk if asked to, and replaces the file of the final name. @throws FileError as check(); the old file stays.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Replaces a file by what `write` writes, or leaves the old one intact if it throws. @throws FileError
void write_file_atomically(const std::string& path, const std::function<void(std::ostream&)>& write,
                           Durability durability = Durability::kPowerCut);
/// Replaces a file by the given bytes, or leaves the old one intact. @throws FileError
void write_file_atomically(const std::string& path, const std::string& bytes, Durability durability = Durability::kPowerCut);

/// Finds out early whether a file can be written; changes nothing. @throws FileError saying why not
void expect_writable(const std::string& path);

}  // namespace foothold
