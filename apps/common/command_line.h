// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The command line of an app. What parses it (CLI11) is seen by command_line.cpp alone, for it takes long to compile.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace foothold::apps {

/// An option that has just been added, of which more can be said.
class CommandLineOption {
 public:
  explicit CommandLineOption(CLI::Option* option) : option_(option) {}

  CommandLineOption& required(bool is_required = true);
  CommandLineOption& show_default();                          ///< --help shows the value that the variable has now
  CommandLineOption& type_name(const std::string& name);      ///< what --help calls the value, such as FILE
  CommandLineOption& range(int smallest, int largest);        ///< both inclusive
  CommandLineOption& range(double smallest, double largest);  ///< both inclusive
  CommandLineOption& one_of(const std::vector<std::string>& values);
  CommandLineOption& repeatable();       ///< for lists: one value each time that it is given
  CommandLineOption& comma_separated();  ///< for lists

 private:
  CLI::Option* option_;
};

/// What an app, or a subcommand of it, understands. Copies are the same command line.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& app_name);

  /// Adds an option "--name", or "name" for one without dashes. The variable must live until parse() has returned.
  /// @tparam Value  std::string, int, std::uint64_t, float, double, or a std::vector of std::string or int.
  template <class Value>
  CommandLineOption add_option(const std::string& name, Value& variable, const std::string& help);
  /// Adds an option without a value, which makes the variable true.
  void add_flag(const std::string& name, bool& variable, const std::string& help);
  /// Text at the end of --help.
  void footer(const std::string& text);

  CommandLine add_subcommand(const std::string& name, const std::string& help);
  /// How many subcommands may be given.
  void require_subcommands(int least, int most);
  /// True for a subcommand that was given.
  bool parsed() const;

  /// Reads the arguments. @return Nothing if all is well. Otherwise what was wrong, or help that was asked for, has been printed, and this
  /// is the exit code: 0 for help.
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  explicit CommandLine(std::shared_ptr<CLI::App> app);

  std::shared_ptr<CLI::App> app_;
};

}  // namespace foothold::apps
