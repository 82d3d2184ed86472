// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Runs a fuzz target once on every file of the folders given, where libFuzzer is not there to do it. Files whose names begin with "good"
/// must be accepted: they would teach a fuzzer nothing once a format has left them behind.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "fuzz.h"

int main(int argc, char** argv) {
  int num_inputs = 0;
  for (int i = 1; i < argc; ++i) {
    if (argv[i][0] == '-') continue;
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
      const std::string name = entry.path().filename().string();
      std::fprintf(stderr, "%s\n", name.c_str());
      const int num_before = foothold::fuzz::num_accepted;
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      ++num_inputs;
      if (name.compare(0, 4, "good") == 0 && foothold::fuzz::num_accepted == num_before) {
        std::fprintf(stderr, "%s was refused; fuzz_make_corpus writes it anew\n", name.c_str());
        return 1;
      }
    }
  }
  std::fprintf(stderr, "replayed %d inputs\n", num_inputs);
  return num_inputs > 0 ? 0 : 1;
}
