// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "descriptor_buffer.h"
#include "foothold/base/error.h"
#include "temporary_file.h"

namespace foothold {

enum class FileKind { kAbsent, kRegular, kDevice };

/// What a path names, once symbolic links are followed.
struct Target {
  std::string path;
  FileKind kind = FileKind::kAbsent;
  mode_t permissions = 0;  ///< of a file that is there
};

namespace {

[[noreturn]] void throw_write_error(const std::string& path, int error) {
  throw FileError(path + ": cannot be written: " + std::strerror(error));
}

Target find_target(const std::string& path) {
  struct stat status {};
  Target target;
  const bool is_there = ::stat(path.c_str(), &status) == 0;
  if (!is_there && errno != ENOENT) throw_write_error(path, errno);
  if (is_there && S_ISDIR(status.st_mode)) throw FileError(path + ": cannot be written: it is a folder");
  target.path = follow_links(path);
  if (target.path.empty()) throw_write_error(path, ELOOP);
  if (!is_there) return target;
  // Behind /proc/self/fd, as behind /dev/stdout, is a file that somebody has open: a new one in its place would not reach him.
  target.kind = S_ISREG(status.st_mode) && target.path.compare(0, 6, "/proc/") != 0 ? FileKind::kRegular : FileKind::kDevice;
  target.permissions = status.st_mode & 07777U;
  return target;
}

void sync_folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder that may be written to, but not read
  ::fsync(descriptor);         // the file is complete either way
  ::close(descriptor);
}

}  // namespace

struct AtomicFile::State {
  std::string path;
  Durability durability = Durability::kPowerCut;
  Target target;
  std::string temporary_path;  ///< empty for a device
  int descriptor = -1;
  std::unique_ptr<DescriptorBuffer> buffer;
  std::unique_ptr<std::ostream> stream;

  ~State() {
    if (!temporary_path.empty()) ::unlink(temporary_path.c_str());  // before its lock goes
    if (descriptor >= 0) ::close(descriptor);
  }
};

AtomicFile::AtomicFile(const std::string& path, Durability durability) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = path;
  s.durability = durability;
  s.target = find_target(path);
  if (s.target.kind == FileKind::kDevice) {
    s.descriptor = ::open(s.target.path.c_str(), O_WRONLY | O_APPEND | O_NOCTTY | O_CLOEXEC);
  } else {
    s.descriptor = create_temporary(s.target.path, s.temporary_path);
  }
  if (s.descriptor < 0) throw_write_error(path, errno);
  if (s.target.kind == FileKind::kRegular) ::fchmod(s.descriptor, s.target.permissions);  // another's file keeps ours
  s.buffer = std::make_unique<DescriptorBuffer>(s.descriptor);
  s.stream = std::make_unique<std::ostream>(s.buffer.get());
}

AtomicFile::~AtomicFile() = default;

std::ostream& AtomicFile::stream() { return *state_->stream; }

void AtomicFile::check() const {
  if (state_->buffer->error() != 0) throw_write_error(state_->path, state_->buffer->error());
}

void AtomicFile::commit() {
  State& s = *state_;
  s.stream->flush();
  check();
  if (!*s.stream) throw FileError(s.path + ": cannot be written: the stream was marked as failed");
  // Some file systems tell of failed writes only when a descriptor is closed. The lock stays with the other one.
  const int copy = ::dup(s.descriptor);
  if (copy < 0 || ::close(copy) != 0) throw_write_error(s.path, errno);
  if (s.temporary_path.empty()) return;
  if (s.durability == Durability::kPowerCut && ::fsync(s.descriptor) != 0) throw_write_error(s.path, errno);
  if (std::rename(s.temporary_path.c_str(), s.target.path.c_str()) != 0) throw_write_error(s.path, errno);
  s.temporary_path.clear();
  if (s.durability == Durability::kPowerCut) sync_folder_of(s.target.path);
}

void write_file_atomically(const std::string& path, const std::function<void(std::ostream&)>& write, Durability durability) {
  AtomicFile file(path, durability);
  try {
    write(file.stream());
  } catch (const FileError&) {
    file.check();  // knows the reason
    throw;
  }
  file.commit();
}

void write_file_atomically(const std::string& path, const std::string& bytes, Durability durability) {
  write_file_atomically(
      path, [&](std::ostream& stream) { stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); }, durability);
}

void expect_writable(const std::string& path) {
  const Target target = find_target(path);
  if (target.kind != FileKind::kDevice) {
    AtomicFile(path, Durability::kCrash);
  } else if (::access(target.path.c_str(), W_OK) != 0) {  // opening a pipe would wait for its reader, and closing it end its reading
    throw_write_error(path, errno);
  }
}

}  // namespace foothold
