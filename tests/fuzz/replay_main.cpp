// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Runs a fuzz target once on every file of a folder, where libFuzzer is not there to do it:
///
///     fuzz_replay TARGET FOLDER
///
/// Files whose names begin with "good" must be accepted: they would teach a fuzzer nothing once a format has left them behind.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fuzz.h"

int main(int argc, char** argv) {
  using namespace foothold::fuzz;
  const auto target = argc == 3 ? targets().find(argv[1]) : targets().end();
  if (target == targets().end()) {
    std::fprintf(stderr, "usage: fuzz_replay TARGET FOLDER; got %d arguments, and no target that is known\n", argc - 1);
    return 2;
  }
  int num_inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[2])) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const std::string name = entry.path().filename().string();
    std::fprintf(stderr, "%s\n", name.c_str());
    const int num_before = num_accepted;
    target->second(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++num_inputs;
    if (name.compare(0, 4, "good") == 0 && num_accepted == num_before) {
      std::fprintf(stderr, "%s was refused; fuzz_make_corpus writes it anew\n", name.c_str());
      return 1;
    }
  }
  std::fprintf(stderr, "replayed %d inputs\n", num_inputs);
  return num_inputs > 0 ? 0 : 1;
}
