// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Saves that a fault or a signal cuts short.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "faults/failing_calls.h"
#include "faults/saves.h"
#include "foothold/base/error.h"
#include "foothold/io/sequence.h"
#include "support/catch.h"
#include "support/random_seed.h"
#include "support/temp_folder.h"

namespace foothold::test {
namespace {

bool is_temporary(const std::string& name) { return name.size() > 4 && name.compare(name.size() - 4, 4, ".tmp") == 0; }

/// Saves while a call fails. @return False if there were not so many calls.
bool save_with_fault(const SaveCase& save_case, const SaveStates& states, int number, bool lasting) {
  const TempFolder temp;
  const std::function<void()> save = save_case.prepare(temp.path());
  std::string error;
  bool has_failed = false;
  {
    const FailingCall fault(CallKind::kFile, number, lasting);
    try {
      save();
    } catch (const FileError& told) {
      error = told.what();
    }
    has_failed = fault.has_failed();
  }
  INFO(save_case.name << ", call " << number << (lasting ? " and all later ones" : "") << " fails: " << error);
  const FolderContents found = contents_of(temp.path());
  const bool is_old = found == states.before;
  const bool is_new = found == states.after;
  CHECK((is_old || is_new));
  CHECK(is_new == error.empty());
  if (!error.empty()) CHECK_THAT(error, Catch::Matchers::Contains(temp.path()) && Catch::Matchers::Contains("No space left on device"));
  if (is_old) {
    save();
    CHECK((contents_of(temp.path()) == states.after));
  }
  return has_failed;
}

/// Saves in a process that is killed meanwhile.
void save_and_be_killed(const std::function<void()>& save, std::chrono::microseconds after) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    save();
    ::_exit(0);
  }
  std::this_thread::sleep_for(after);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

/// Each file is whole, and what was there before is still there or was replaced.
void check_what_the_killed_left(const FolderContents& found, const SaveStates& states) {
  for (const auto& [name, bytes] : states.before) CHECK(found.count(name) == 1);
  for (const auto& [name, bytes] : found) {
    if (is_temporary(name)) continue;
    const auto before = states.before.find(name);
    const auto after = states.after.find(name);
    const bool is_whole =
        (before != states.before.end() && before->second == bytes) || (after != states.after.end() && after->second == bytes);
    INFO(name << ": " << bytes.size() << " bytes");
    CHECK(is_whole);
  }
}

}  // namespace

TEST_CASE(
    "saves: whichever call of the file system fails, the old state or the new one is there, whole and alone, and the reason is told") {
  for (const SaveCase& save_case : all_saves()) {
    const SaveStates states = undisturbed(save_case);
    REQUIRE((states.before != states.after));
    for (const bool lasting : {false, true}) {
      int number = 0;
      while (save_with_fault(save_case, states, number, lasting)) ++number;
      CHECK(number >= 3);  // to create, write and rename a file
    }
  }
}

TEST_CASE("saves: killed at any moment, the old state or the new one is there, and the next save leaves nothing else") {
  Random random = test_random();
  for (const SaveCase& save_case : all_saves()) {
    const SaveStates states = undisturbed(save_case);
    for (int repeat = 0; repeat < 12; ++repeat) {
      const TempFolder temp;
      const std::function<void()> save = save_case.prepare(temp.path());
      const std::chrono::microseconds after(static_cast<int>(random.uniform(0.0F, 8000.0F)));
      INFO(save_case.name << ", killed after " << after.count() << " us");
      save_and_be_killed(save, after);
      check_what_the_killed_left(contents_of(temp.path()), states);
      if (!save_case.is_one_file) {
        const int num_frames = open_sequence(temp / "recording", Context())->num_frames();
        CHECK((num_frames == 1 || num_frames == 2));
      }
      save();
      CHECK((contents_of(temp.path()) == states.after));
    }
  }
}

}  // namespace foothold::test
