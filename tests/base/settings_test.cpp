// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/settings.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

struct PartSettings {
  float radius_m = 0.1F;
  bool enabled = true;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&PartSettings::radius_m, "radius_m", "A radius.", Range{0.001, 10});
    v(&PartSettings::enabled, "enabled", "A switch.");
  }
};

struct WholeSettings {
  int count = 5;
  double weight = 0.25;
  std::uint64_t seed = 42;
  std::uint16_t small = 3;
  std::string name = "kitchen";
  PartSettings part;

  template <class Visitor>
  static void fields(Visitor& v) {
    using S = WholeSettings;
    v(&S::count, "count", "A count.", Range{1, 100});
    v(&S::weight, "weight", "A weight.", Range{0, 1});
    v(&S::seed, "seed", "A seed.", Range{0, 1.8446744073709552e19});
    v(&S::small, "small", "A small number.", Range{0, 65535});
    v(&S::name, "name", "A name.");
    v(&S::part, "part");
  }
};

std::map<std::string, SettingDescription> described(const WholeSettings& settings) {
  std::map<std::string, SettingDescription> result;
  for (const SettingDescription& description : describe_settings(settings)) result[description.path] = description;
  return result;
}

TEST_CASE("describe_settings: lists every field in order with value, range and help") {
  const auto list = describe_settings(WholeSettings{});
  std::string paths;
  for (const SettingDescription& description : list) paths += description.path + " ";
  REQUIRE(paths == "count weight seed small name part.radius_m part.enabled ");
  const auto by_path = described({});
  REQUIRE(by_path.at("count").value == "5");
  REQUIRE(by_path.at("count").range == "[1, 100]");
  REQUIRE(by_path.at("count").help == "A count.");
  REQUIRE(by_path.at("weight").value == "0.25");
  REQUIRE(by_path.at("name").range.empty());
  REQUIRE(by_path.at("part.radius_m").value == "0.1");
  REQUIRE(by_path.at("part.enabled").range == "true or false");
}

TEST_CASE("describe_settings: prints numbers as people write them") {
  WholeSettings settings;
  for (const auto& [value, text] :
       {std::pair<double, const char*>{0.0, "0"}, {100.0, "100"}, {0.0001, "0.0001"}, {1e6, "1000000"}, {-2.5, "-2.5"}}) {
    settings.weight = value;
    REQUIRE(described(settings).at("weight").value == text);
  }
  settings.part.radius_m = 0.02F;
  REQUIRE(described(settings).at("part.radius_m").value == "0.02");
}

TEST_CASE("assign_setting: reads back every type that describe_settings printed") {
  WholeSettings original;
  original.count = 99;
  original.weight = 1e-20 / 3.0;
  original.seed = std::numeric_limits<std::uint64_t>::max();
  original.small = 65535;
  original.name = "two words";
  original.part.radius_m = 1.0F / 3.0F;
  original.part.enabled = false;
  WholeSettings copy;
  for (const SettingDescription& description : describe_settings(original)) assign_setting(copy, description.path, description.value);
  REQUIRE(copy.count == original.count);
  REQUIRE(copy.weight == original.weight);
  REQUIRE(copy.seed == original.seed);
  REQUIRE(copy.small == original.small);
  REQUIRE(copy.name == original.name);
  REQUIRE(copy.part.radius_m == original.part.radius_m);
  REQUIRE(copy.part.enabled == original.part.enabled);
}

TEST_CASE("assign_setting: takes the ends of a range and nothing beyond") {
  WholeSettings settings;
  assign_setting(settings, "count", "1");
  assign_setting(settings, "count", "100");
  REQUIRE(settings.count == 100);
  for (const char* text : {"0", "101", "-5", "1e9"}) {
    const std::string message = test::error_message<InvalidSettings>([&] { assign_setting(settings, "count", text); });
    REQUIRE(test::contains(message, "count"));
    REQUIRE(test::contains(message, "[1, 100]"));
  }
  REQUIRE(settings.count == 100);
}

TEST_CASE("assign_setting: refuses text that is not wholly a value of the type") {
  WholeSettings settings;
  const std::pair<const char*, const char*> kWrong[] = {
      {"count", ""},      {"count", "1.5"},   {"count", "five"},       {"count", "5 "},      {"count", " 5"},
      {"count", "nan"},   {"weight", "0,5"},  {"weight", "0.5x"},      {"weight", "nan"},    {"weight", "inf"},
      {"seed", "-1"},     {"seed", " -1"},    {"seed", "1.5"},         {"seed", ""},         {"seed", "18446744073709551616"},
      {"small", "65536"}, {"small", "65539"}, {"part.enabled", "yes"}, {"part.enabled", ""}, {"part.radius_m", "0"},
  };
  for (const auto& [path, text] : kWrong) {
    INFO(path << " = '" << text << "'");
    REQUIRE(test::contains(test::error_message<InvalidSettings>([&, p = path, t = text] { assign_setting(settings, p, t); }), path));
  }
  const WholeSettings defaults;
  REQUIRE(settings.seed == defaults.seed);
  REQUIRE(settings.small == defaults.small);
}

TEST_CASE("assign_setting: suggests the nearest known name for an unknown one") {
  WholeSettings settings;
  const std::string message = test::error_message<InvalidSettings>([&] { assign_setting(settings, "part.radios_m", "1"); });
  REQUIRE(test::contains(message, "'part.radios_m'"));
  REQUIRE(test::contains(message, "did you mean 'part.radius_m'"));
  REQUIRE(test::contains(test::error_message<InvalidSettings>([&] { assign_setting(settings, "wieght", "1"); }), "'weight'"));
}

TEST_CASE("validate_settings: names the first field out of range") {
  WholeSettings settings;
  REQUIRE_NOTHROW(validate_settings(settings));
  settings.part.radius_m = std::numeric_limits<float>::quiet_NaN();
  REQUIRE(test::contains(test::error_message<InvalidSettings>([&] { validate_settings(settings); }), "part.radius_m"));
  settings = {};
  settings.weight = 1.5;
  const std::string message = test::error_message<InvalidSettings>([&] { validate_settings(settings); });
  REQUIRE(test::contains(message, "weight"));
  REQUIRE(test::contains(message, "1.5"));
  REQUIRE(test::contains(message, "[0, 1]"));
}

/// Limits that single precision rounds up (0.1) and down (0.7).
struct LimitedSettings {
  float above = 0.1F;
  float below = 0.7F;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&LimitedSettings::above, "above", "At most a number whose nearest float is greater.", Range{0, 0.1});
    v(&LimitedSettings::below, "below", "At least a number whose nearest float is less.", Range{0.7, 1});
  }
};

TEST_CASE("validate_settings: a float at its very limit is in range, and the next one beyond is not") {
  LimitedSettings settings;
  REQUIRE(static_cast<double>(settings.above) > 0.1);
  REQUIRE(static_cast<double>(settings.below) < 0.7);
  REQUIRE_NOTHROW(validate_settings(settings));
  for (const SettingDescription& description : describe_settings(settings)) assign_setting(settings, description.path, description.value);
  REQUIRE_NOTHROW(validate_settings(settings));
  settings.above = std::nextafter(0.1F, 1.0F);
  REQUIRE(test::contains(test::error_message<InvalidSettings>([&] { validate_settings(settings); }), "above: got 0.1000"));
  settings = {};
  settings.below = std::nextafter(0.7F, 0.0F);
  REQUIRE(test::contains(test::error_message<InvalidSettings>([&] { validate_settings(settings); }), "below: got 0.6999"));
}

}  // namespace
}  // namespace foothold
