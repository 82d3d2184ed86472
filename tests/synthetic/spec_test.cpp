// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/error.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "support/catch.h"

namespace foothold {
namespace {

using Catch::Matchers::Contains;

TEST_CASE("parse_synthetic_spec: reads room and settings, with or without prefix") {
  const SyntheticSequenceSettings settings =
      parse_synthetic_spec("synthetic:stairs?trajectory=test&frames=12&width=320&height=240&noise=0&seed=7&roll_deg=-30");
  REQUIRE(settings.room == "stairs");
  REQUIRE(settings.trajectory == "test");
  REQUIRE(settings.frames == 12);
  REQUIRE(settings.width == 320);
  REQUIRE(settings.height == 240);
  REQUIRE(settings.noise == 0);
  REQUIRE(settings.seed == 7);
  REQUIRE(settings.roll_deg == -30.0F);
  REQUIRE(parse_synthetic_spec("training-17").room == "training-17");
  REQUIRE(parse_synthetic_spec("office?noise=false").noise == 0);
  REQUIRE(parse_synthetic_spec("office?noise=true").noise == 1);
}

TEST_CASE("parse_synthetic_spec: every default") {
  const SyntheticSequenceSettings settings = parse_synthetic_spec("synthetic:office");
  REQUIRE(settings.trajectory == "train");
  REQUIRE(settings.frames == 300);
  REQUIRE(settings.width == 640);
  REQUIRE(settings.height == 480);
  REQUIRE(settings.noise == 1);
  REQUIRE(settings.seed == 42);
  REQUIRE(settings.roll_deg == 0.0F);
  REQUIRE(settings.moved == 0.0F);
  REQUIRE(settings.removed == 0.0F);
  REQUIRE(settings.added == 0.0F);
  REQUIRE_FALSE(settings.mirrored);
  REQUIRE(settings.change_seed == 0);
  REQUIRE(settings.exposure == 1.0F);
  REQUIRE(settings.gamma == 1.0F);
  REQUIRE(settings.warmth == 0.0F);
  REQUIRE(settings.blur_px == 0.0F);
  REQUIRE(settings.holes == 0.0F);
  REQUIRE(settings.person == 0.0F);
}

TEST_CASE("synthetic_spec: is read back as the same settings") {
  for (const char* spec :
       {"synthetic:office", "synthetic:stairs?trajectory=test&frames=12&noise=0", "synthetic:training-3?seed=9&roll_deg=45.5",
        "synthetic:corridor?moved=0.5&mirrored=true&change_seed=3&exposure=0.5&person=0.25"}) {
    REQUIRE(synthetic_spec(parse_synthetic_spec(spec)) == spec);
  }
}

TEST_CASE("parse_synthetic_spec: explains what is wrong") {
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:offfice"), Contains("'offfice'") && Contains("office") && Contains("training-K"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:training-"), Contains("training-K"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:training--1"), Contains("training-K"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:office?frame=3"), Contains("did you mean 'frames'"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:office?frames"), Contains("key=value"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:office?frames=0"), Contains("frames"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:office?noise=3"), Contains("noise"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:office?moved=2"), Contains("moved") && Contains("[0, 1]"));
  REQUIRE_THROWS_WITH(parse_synthetic_spec("synthetic:office?trajectory=best"), Contains("train or test"));
  REQUIRE_THROWS_AS(parse_synthetic_spec("synthetic:office?width=nan"), InvalidSettings);
}

}  // namespace
}  // namespace foothold
