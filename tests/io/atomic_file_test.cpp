// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/io/atomic_file.h"

#include <sys/resource.h>

#include <csignal>

#include "io_fixtures.h"
#include "support/catch.h"

namespace foothold {
namespace {

/// Makes writes beyond a size fail with EFBIG, as a full disk would with ENOSPC.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t num_bytes) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{num_bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit old_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace

using namespace test;
using Catch::Matchers::Contains;

TEST_CASE("AtomicFile: the file appears on commit, and nothing else remains") {
  const TempFolder temp;
  {
    AtomicFile file(temp / "a.txt");
    file.stream() << "hello " << 42;
    CHECK_FALSE(std::filesystem::exists(temp / "a.txt"));
    file.commit();
  }
  CHECK(read_text(temp / "a.txt") == "hello 42");
  CHECK(temp.num_files() == 1);
}

TEST_CASE("AtomicFile: without a commit the old file stays, and nothing else remains") {
  const TempFolder temp;
  write_text(temp / "a.txt", "old");
  {
    AtomicFile file(temp / "a.txt");
    file.stream() << std::string(1U << 20U, 'x');
  }
  CHECK(read_text(temp / "a.txt") == "old");
  CHECK(temp.num_files() == 1);
}

TEST_CASE("AtomicFile: when the disk has no room, the old file stays and the reason is told") {
  const TempFolder temp;
  write_text(temp / "a.txt", "old");
  {
    const FileSizeLimit limit(100000);
    AtomicFile file(temp / "a.txt");
    file.stream() << std::string(1U << 20U, 'x');
    CHECK_THAT(error_of([&] { file.commit(); }), Contains(temp / "a.txt") && Contains("File too large"));
  }
  CHECK(read_text(temp / "a.txt") == "old");
  CHECK(temp.num_files() == 1);
}

TEST_CASE("AtomicFile: a place that cannot be written to is named") {
  const TempFolder temp;
  CHECK_THAT(error_of([&] { AtomicFile(temp / "absent/a.txt"); }), Contains(temp / "absent/a.txt") && Contains("No such file"));
  CHECK_THAT(error_of([&] { AtomicFile file(temp.path()); }), Contains(temp.path()) && Contains("it is a folder"));
}

TEST_CASE("AtomicFile: two writers of one file do not disturb each other, and the last to commit wins") {
  const TempFolder temp;
  AtomicFile first(temp / "a.txt");
  AtomicFile second(temp / "a.txt");
  first.stream() << "first";
  second.stream() << "second";
  second.commit();
  first.commit();
  CHECK(read_text(temp / "a.txt") == "first");
  CHECK(temp.num_files() == 1);
}

TEST_CASE("write_file_atomically: replaces a file by any bytes") {
  const TempFolder temp;
  std::string bytes(200000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i);
  write_text(temp / "a", "old");
  write_file_atomically(temp / "a", bytes);
  CHECK(read_text(temp / "a") == bytes);
}

}  // namespace foothold
