// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace foothold {
namespace {

constexpr int kMaxWriters = 1000;  ///< of one file at a time
constexpr int kNumCleared = 8;     ///< names that are looked at for what others left
constexpr int kMaxLinks = 40;      ///< as Linux has it

std::string temporary_name(const std::string& path, int number) { return path + "." + std::to_string(number) + ".tmp"; }

/// True if an open file is the one of that name.
bool is_named(int descriptor, const std::string& name) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// Deletes the file of that name if its writer is dead. @return True if there was one, and it is gone.
bool clear_abandoned(const std::string& name) {
  const int descriptor = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct stat status {};
  // Whoever deletes or renames the file holds its lock: what has its name while we hold the lock is the file itself.
  const bool is_abandoned = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&
                            is_named(descriptor, name) && ::unlink(name.c_str()) == 0;
  ::close(descriptor);
  return is_abandoned;
}

/// Creates and locks a file of a name that nobody has. @return -1 with errno, EEXIST if somebody has it.
int create_locked(const std::string& name) {
  const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) return -1;
  // Another may have found it before it was locked, and deleted it. Where locks are not to be had, nobody gets one, and all files stay.
  const bool is_ours = (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && is_named(descriptor, name);
  if (is_ours) return descriptor;
  ::close(descriptor);
  errno = EEXIST;
  return -1;
}

}  // namespace

int create_temporary(const std::string& path, std::string& temporary_path) {
  int descriptor = -1;
  for (int number = 0; number < kMaxWriters && descriptor < 0; ++number) {
    temporary_path = temporary_name(path, number);
    clear_abandoned(temporary_path);
    descriptor = create_locked(temporary_path);
    if (descriptor < 0 && errno != EEXIST) break;
  }
  const int error = errno;
  for (int number = 0; number < kNumCleared && descriptor >= 0; ++number) {
    const std::string name = temporary_name(path, number);
    if (name != temporary_path) clear_abandoned(name);
  }
  if (descriptor < 0) temporary_path.clear();
  errno = error;
  return descriptor;
}

std::string follow_links(std::string path) {
  for (int i = 0; i < kMaxLinks; ++i) {
    std::error_code error;
    if (path.compare(0, 6, "/proc/") == 0 || !std::filesystem::is_symlink(path, error)) return path;
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);
    if (error) return path;
    path = target.is_absolute() ? target.string() : (std::filesystem::path(path).parent_path() / target).string();
  }
  return {};
}

}  // namespace foothold
