// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/command_line.h"

#include <cstdint>

#include "support/catch.h"

namespace foothold::apps {
namespace {

/// What an app may ask for.
struct Options {
  std::string file = "none";
  int count = 1;
  std::uint64_t seed = 42;
  float size_m = 0.5F;
  bool fast = false;
  std::vector<std::string> names;
  std::vector<int> numbers;
};

/// Parses arguments. @return The exit code, if the app is to end.
std::optional<int> parse(std::vector<const char*> arguments, Options& options) {
  CommandLine line("An app.", "app");
  line.add_option("--file", options.file, "A file");
  line.add_option("--count", options.count, "A number").range(1, 10);
  line.add_option("--seed", options.seed, "A seed");
  line.add_option("--size", options.size_m, "A length").range(0.1, 1.0);
  line.add_flag("--fast", options.fast, "Do not wait");
  line.add_option("--name", options.names, "A name").one_of({"a", "b"}).repeatable();
  line.add_option("--numbers", options.numbers, "Numbers").comma_separated();
  arguments.insert(arguments.begin(), "app");
  return line.parse(static_cast<int>(arguments.size()), arguments.data());
}

TEST_CASE("CommandLine: options are read into their variables, and others keep their defaults") {
  Options options;
  REQUIRE_FALSE(parse({"--count", "7", "--seed", "18446744073709551615", "--size", "0.25", "--fast", "--name", "b", "--name", "a",
                       "--numbers", "1,2,3"},
                      options)
                    .has_value());
  CHECK(options.file == "none");
  CHECK(options.count == 7);
  CHECK(options.seed == 18446744073709551615U);
  CHECK(options.size_m == 0.25F);
  CHECK(options.fast);
  CHECK(options.names == std::vector<std::string>{"b", "a"});
  CHECK(options.numbers == std::vector<int>{1, 2, 3});
}

TEST_CASE("CommandLine: values out of range, of another kind or not in the list end the app with an error") {
  Options options;
  for (const char* argument : {"--count=11", "--count=two", "--size=0.05", "--name=c", "--nonsense", "positional"})
    CHECK(parse({argument}, options).value_or(0) != 0);
}

TEST_CASE("CommandLine: --help ends the app without an error") {
  Options options;
  const std::optional<int> exit_code = parse({"--help"}, options);
  REQUIRE(exit_code.has_value());
  CHECK(*exit_code == 0);
}

TEST_CASE("CommandLine: the subcommand that was given is parsed, and options that are required are asked for") {
  for (const bool complete : {true, false}) {
    CommandLine line("An app.", "app");
    line.require_subcommands(1, 1);
    std::string file;
    CommandLine first = line.add_subcommand("first", "One");
    first.add_option("--file", file, "A file").required();
    const CommandLine second = line.add_subcommand("second", "Another");
    const char* arguments[] = {"app", "first", "--file=x"};
    CHECK(line.parse(complete ? 3 : 2, arguments).has_value() == !complete);
    if (!complete) continue;
    CHECK(first.parsed());
    CHECK_FALSE(second.parsed());
    CHECK(file == "x");
  }
}

}  // namespace
}  // namespace foothold::apps
