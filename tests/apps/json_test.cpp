// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/json.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "support/catch.h"

namespace foothold::apps {
namespace {

TEST_CASE("Json: an object keeps its members in order, a value per line") {
  const Json json = {
      {"name", "kitchen"}, {"found", true}, {"first", nullptr}, {"error", {{"median_m", 0.25}}}, {"frames", Json::array({1, 2})}};
  CHECK(json.dump() ==
        "{\n"
        "  \"name\": \"kitchen\",\n"
        "  \"found\": true,\n"
        "  \"first\": null,\n"
        "  \"error\": {\n"
        "    \"median_m\": 0.25\n"
        "  },\n"
        "  \"frames\": [\n"
        "    1,\n"
        "    2\n"
        "  ]\n"
        "}");
}

TEST_CASE("Json: empty objects and arrays take one line") {
  CHECK(Json::object().dump() == "{}");
  CHECK(Json::array().dump() == "[]");
}

TEST_CASE("Json: numbers read back to the same value, and what is no number is null") {
  CHECK(Json(1.0).dump() == "1.0");
  CHECK(Json(0.1).dump() == "0.1");
  CHECK(Json(0.1F).dump() == "0.10000000149011612");
  CHECK(Json(1e-5).dump() == "1e-05");
  CHECK(Json(std::numeric_limits<std::uint64_t>::max()).dump() == "18446744073709551615");
  CHECK(Json(std::numeric_limits<std::int64_t>::min()).dump() == "-9223372036854775808");
  CHECK(Json(std::nan("")).dump() == "null");
  CHECK(Json(std::numeric_limits<double>::infinity()).dump() == "null");
}

TEST_CASE("Json: texts are escaped, and bytes that are not UTF-8 replaced") {
  CHECK(Json("a \"b\"\n\\").dump() == R"("a \"b\"\n\\")");
  CHECK(Json("caf\xC3\xA9").dump() == "\"caf\xC3\xA9\"");
  CHECK(Json("caf\xE9").dump() == "\"caf\xEF\xBF\xBD\"");
}

TEST_CASE("Json: null becomes what is put into it") {
  Json json;
  json["a"]["b"] = 1;
  json["c"].push_back("d");
  CHECK(json.dump() == "{\n  \"a\": {\n    \"b\": 1\n  },\n  \"c\": [\n    \"d\"\n  ]\n}");
}

TEST_CASE("Json: update replaces members of the same name where they are, and adds others at the end") {
  Json json = {{"a", 1}, {"b", 2}};
  json.update({{"a", 3}, {"c", 4}});
  json.erase("b");
  CHECK(json.dump() == "{\n  \"a\": 3,\n  \"c\": 4\n}");
}

TEST_CASE("Json: nested makes a tree of dotted paths, and numbers of texts that are some") {
  const Json json =
      Json::nested({{"pose.seed", "18446744073709551615"}, {"device", "cpu"}, {"pose.fast", "false"}, {"pose.scale", "1e-3"}});
  const Json expected = {{"pose", {{"seed", std::numeric_limits<std::uint64_t>::max()}, {"fast", false}, {"scale", 1e-3}}},
                         {"device", "cpu"}};
  CHECK(json.dump() == expected.dump());
}

}  // namespace
}  // namespace foothold::apps
