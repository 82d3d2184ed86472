// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/files/settings_file.h"

#include "settings_json.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/temp_folder.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;

struct InnerSettings {
  int count = 3;
  float distance_m = 0.1F;
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&InnerSettings::count, "count", "A count.", Range{1, 10});
    v(&InnerSettings::distance_m, "distance_m", "A distance.", Range{0, 1});
  }
};

struct OuterSettings {
  InnerSettings first;
  std::uint64_t seed = 42;
  bool fast = true;
  double tiny = 1e-6;
  std::string name = "a \"name\"";
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&OuterSettings::first, "first");
    v(&OuterSettings::seed, "seed", "A seed.", Range{0, 18446744073709551615.0});
    v(&OuterSettings::fast, "fast", "A switch.");
    v(&OuterSettings::tiny, "tiny", "A small number.", Range{0, 1});
    v(&OuterSettings::name, "name", "A text.");
  }
};

/// What loading a file of this text complains about.
template <class Exception>
std::string load_error(const std::string& text) {
  const TempFolder temp;
  write_text(temp / "s.json", text);
  OuterSettings settings;
  const std::string error = error_of<Exception>([&] { load_settings(temp / "s.json", settings); });
  CHECK(settings.first.count == 3);  // nothing is changed by half
  CHECK_THAT(error, Contains(temp / "s.json"));
  return error;
}

}  // namespace

TEST_CASE("save_settings: every field reads back exactly") {
  const TempFolder temp;
  OuterSettings settings;
  settings.first = {7, 0.3F};
  settings.seed = 18446744073709551615ULL;
  settings.fast = false;
  settings.tiny = 0.1 + 0.2;
  settings.name = "42";
  save_settings(temp / "s.json", settings);
  OuterSettings read;
  load_settings(temp / "s.json", read);
  CHECK(read.first.count == 7);
  CHECK(read.first.distance_m == 0.3F);
  CHECK(read.seed == settings.seed);
  CHECK(read.fast == false);
  CHECK(read.tiny == settings.tiny);
  CHECK(read.name == "42");
}

TEST_CASE("settings_to_json: nests by the dots and keeps the order") {
  OuterSettings settings;
  const std::string json = settings_to_json(describe_settings(settings));
  CHECK(json ==
        "{\n  \"first\": {\n    \"count\": 3,\n    \"distance_m\": 0.1\n  },\n  \"seed\": 42,\n  \"fast\": true,\n  \"tiny\": 1e-06,\n"
        "  \"name\": \"a \\\"name\\\"\"\n}\n");
}

TEST_CASE("load_settings: overrides only what the file names") {
  const TempFolder temp;
  write_text(temp / "s.json", "{\"first\": {\"count\": 5}, \"fast\": false}");
  OuterSettings settings;
  load_settings(temp / "s.json", settings);
  CHECK(settings.first.count == 5);
  CHECK(settings.first.distance_m == 0.1F);
  CHECK_FALSE(settings.fast);
  write_text(temp / "s.json", "{}");
  load_settings(temp / "s.json", settings);
  CHECK(settings.first.count == 5);
}

TEST_CASE("load_settings: an unknown key is named, with the nearest known one") {
  CHECK_THAT(load_error<InvalidSettings>("{\"first\": {\"count\": 5, \"distnce_m\": 0.5}}"),
             Contains("first.distnce_m") && Contains("first.distance_m"));
  CHECK_THAT(load_error<InvalidSettings>("{\"sed\": 5}"), Contains("sed") && Contains("seed"));
}

TEST_CASE("load_settings: a bad value is named, with its range") {
  CHECK_THAT(load_error<InvalidSettings>("{\"first\": {\"count\": 11}}"), Contains("first.count") && Contains("11") && Contains("[1, 10]"));
  CHECK_THAT(load_error<InvalidSettings>("{\"first\": {\"count\": 2.5}}"), Contains("2.5") && Contains("integer"));
  CHECK_THAT(load_error<InvalidSettings>("{\"fast\": \"maybe\"}"), Contains("maybe") && Contains("true or false"));
  CHECK_THAT(load_error<InvalidSettings>("{\"first\": [1, 2]}"), Contains("first") && Contains("a list"));
  CHECK_THAT(load_error<InvalidSettings>("{\"tiny\": null}"), Contains("tiny") && Contains("null"));
  CHECK_THAT(load_error<InvalidSettings>("{\"tiny\": 0.5, \"tiny\": 0.6}"), Contains("tiny") && Contains("twice"));
  CHECK_THAT(load_error<InvalidSettings>("{\"first\": {\"count\": 5}, \"first.count\": 6}"), Contains("twice"));
}

TEST_CASE("load_settings: objects nested by the thousand and names without end are refused at once, in a short message") {
  std::string nested;
  for (int i = 0; i < 50000; ++i) nested += "{\"a\":";
  for (const std::string& text :
       {nested, "{\"" + std::string(1000000, 'a') + "\": 1}", "{\"first\": {\"" + std::string(1000000, 'a') + "\": 1}}"}) {
    const std::string error = load_error<InvalidSettings>(text);
    CHECK_THAT(error, Contains("33 deep") || Contains("characters"));
    CHECK(error.size() < 400);
  }
  const std::string value = load_error<InvalidSettings>("{\"fast\": \"\\u001b[2J" + std::string(1000000, 'x') + "\"}");
  CHECK_THAT(value, Contains("\\x1b[2J"));
  CHECK(value.size() < 400);
}

TEST_CASE("load_settings: bad JSON is placed") {
  CHECK_THAT(load_error<FileError>("{\"first\": {\"count\": 5}"), Contains("byte 23") && Contains("JSON"));
  CHECK_THAT(load_error<FileError>(""), Contains("JSON"));
  CHECK_THAT(load_error<FileError>("[1]"), Contains("a list"));
  CHECK_THAT(load_error<FileError>("5"), Contains("a bare value"));
  CHECK_THAT(load_error<FileError>("{\"tiny\": nan}"), Contains("near"));
  CHECK_THAT(load_error<FileError>("{\"tiny\": 1e999}"), Contains("JSON"));
  CHECK_THAT(load_error<FileError>("{} x"), Contains("JSON"));
}

}  // namespace foothold
