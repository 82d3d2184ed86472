// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/file_size_limit.h"
#include "support/temp_folder.h"

namespace foothold {

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

TEST_CASE("AtomicFile: what a writer that was killed left behind is cleared by the next, and what a living one writes is not") {
  const TempFolder temp;
  const AtomicFile living(temp / "a.txt");
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    AtomicFile first(temp / "a.txt");
    AtomicFile second(temp / "a.txt");
    first.stream() << "half" << std::flush;
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  REQUIRE(temp.num_files() == 3);
  write_file_atomically(temp / "a.txt", "whole");
  CHECK(read_text(temp / "a.txt") == "whole");
  CHECK(temp.num_files() == 2);  // with that of the living
}

TEST_CASE("AtomicFile: files that only look temporary stay") {
  const TempFolder temp;
  std::filesystem::create_directory(temp / "a.txt.0.tmp");
  std::filesystem::create_symlink(temp / "other", temp / "a.txt.1.tmp");
  write_text(temp / "b.txt.0.tmp", "b");
  write_file_atomically(temp / "a.txt", "a");
  CHECK(temp.num_files() == 4);
}

TEST_CASE("AtomicFile: writers of one file in many threads never lose one another's, nor leave anything") {
  const TempFolder temp;
  const auto write_often = [&](char letter) {
    for (int i = 0; i < 100; ++i) write_file_atomically(temp / "a.txt", std::string(1000, letter), Durability::kCrash);
  };
  std::vector<std::thread> threads;
  for (const char letter : {'a', 'b', 'c', 'd'}) threads.emplace_back(write_often, letter);
  for (int i = 0; i < 100; ++i) {
    const std::string text = read_text(temp / "a.txt");
    if (!text.empty()) CHECK(text == std::string(1000, text[0]));
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(temp.num_files() == 1);
}

TEST_CASE("AtomicFile: symbolic links stay, and what they lead to is replaced or made") {
  const TempFolder temp;
  std::filesystem::create_directory(temp / "folder");
  std::filesystem::create_symlink("folder/a.txt", temp / "link");
  std::filesystem::create_symlink("link", temp / "link to link");
  for (const char* text : {"new", "replaced"}) {
    write_file_atomically(temp / "link to link", text);
    CHECK(std::filesystem::is_symlink(temp / "link"));
    CHECK(std::filesystem::is_symlink(temp / "link to link"));
    CHECK(read_text(temp / "folder/a.txt") == text);
  }
  std::filesystem::create_symlink("circle", temp / "circle");
  CHECK_THAT(error_of([&] { expect_writable(temp / "circle"); }), Contains(temp / "circle") && Contains("symbolic links"));
}

TEST_CASE("AtomicFile: devices and pipes are written to, and stay what they are") {
  const TempFolder temp;
  write_file_atomically("/dev/null", "nothing");
  CHECK(std::filesystem::is_character_file("/dev/null"));
  CHECK_THAT(error_of([] { write_file_atomically("/dev/full", "x"); }), Contains("/dev/full: cannot be written: No space left"));
  CHECK(std::filesystem::is_character_file("/dev/full"));

  REQUIRE(::mkfifo((temp / "pipe").c_str(), 0666) == 0);
  expect_writable(temp / "pipe");  // neither waits for a reader nor disturbs one
  std::string received;
  std::thread reader([&] { received = read_text(temp / "pipe"); });
  write_file_atomically(temp / "pipe", "through the pipe");
  reader.join();
  CHECK(received == "through the pipe");
  CHECK(std::filesystem::is_fifo(temp / "pipe"));
}

TEST_CASE("AtomicFile: a file that a process has open, as /dev/stdout, is appended to and not replaced") {
  const TempFolder temp;
  const int descriptor = ::open((temp / "out.txt").c_str(), O_WRONLY | O_CREAT, 0666);
  REQUIRE(descriptor >= 0);
  REQUIRE(::write(descriptor, "first ", 6) == 6);
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(descriptor), temp / "stdout");
  write_file_atomically(temp / "stdout", "second");
  ::close(descriptor);
  CHECK(read_text(temp / "out.txt") == "first second");
}

TEST_CASE("AtomicFile: a file that is replaced keeps its permissions") {
  namespace fs = std::filesystem;
  const TempFolder temp;
  write_text(temp / "a.txt", "old");
  const fs::perms permissions = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(temp / "a.txt", permissions);
  write_file_atomically(temp / "a.txt", "new");
  CHECK(fs::status(temp / "a.txt").permissions() == permissions);
}

TEST_CASE("write_file_atomically: if the writer gives up, or the disk is full, the old file stays and the reason is told") {
  const TempFolder temp;
  write_text(temp / "a.txt", "old");
  const auto give_up = [](std::ostream&) { throw FileError("no more"); };
  CHECK(error_of([&] { write_file_atomically(temp / "a.txt", give_up); }) == "no more");
  const auto fill = [](std::ostream& stream) {
    stream << std::string(1U << 20U, 'x');
    if (!stream) throw FileError("a worse reason");
  };
  const FileSizeLimit limit(100000);
  CHECK_THAT(error_of([&] { write_file_atomically(temp / "a.txt", fill); }), Contains(temp / "a.txt") && Contains("File too large"));
  CHECK(read_text(temp / "a.txt") == "old");
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
