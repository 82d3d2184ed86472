// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>

namespace foothold::apps {

CommandLineOption& CommandLineOption::required(bool is_required) {
  option_->required(is_required);
  return *this;
}

CommandLineOption& CommandLineOption::show_default() {
  option_->capture_default_str();
  return *this;
}

CommandLineOption& CommandLineOption::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

CommandLineOption& CommandLineOption::range(int smallest, int largest) {
  option_->check(CLI::Range(smallest, largest));
  return *this;
}

CommandLineOption& CommandLineOption::range(double smallest, double largest) {
  option_->check(CLI::Range(smallest, largest));
  return *this;
}

CommandLineOption& CommandLineOption::one_of(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

CommandLineOption& CommandLineOption::repeatable() {
  option_->take_all();
  return *this;
}

CommandLineOption& CommandLineOption::comma_separated() {
  option_->delimiter(',');
  return *this;
}

CommandLine::CommandLine(const std::string& description, const std::string& app_name)
    : app_(std::make_shared<CLI::App>(description, app_name)) {}

CommandLine::CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}

template <class Value>
CommandLineOption CommandLine::add_option(const std::string& name, Value& variable, const std::string& help) {
  return CommandLineOption(app_->add_option(name, variable, help));
}
template CommandLineOption CommandLine::add_option(const std::string&, std::string&, const std::string&);
template CommandLineOption CommandLine::add_option(const std::string&, int&, const std::string&);
template CommandLineOption CommandLine::add_option(const std::string&, std::uint64_t&, const std::string&);
template CommandLineOption CommandLine::add_option(const std::string&, float&, const std::string&);
template CommandLineOption CommandLine::add_option(const std::string&, double&, const std::string&);
template CommandLineOption CommandLine::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template CommandLineOption CommandLine::add_option(const std::string&, std::vector<int>&, const std::string&);

void CommandLine::add_flag(const std::string& name, bool& variable, const std::string& help) { app_->add_flag(name, variable, help); }

void CommandLine::footer(const std::string& text) { app_->footer(text); }

CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& help) {
  return CommandLine(app_->get_subcommand_ptr(app_->add_subcommand(name, help)));
}

void CommandLine::require_subcommands(int least, int most) {
  app_->require_subcommand(static_cast<std::size_t>(least), static_cast<std::size_t>(most));
}

bool CommandLine::parsed() const { return app_->parsed(); }

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error);  // also how --help ends
  }
  return std::nullopt;
}

}  // namespace foothold::apps
