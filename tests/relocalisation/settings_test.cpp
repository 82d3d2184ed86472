// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/settings.h"

#include <limits>
#include <map>
#include <memory>
#include <string>

#include "foothold/relocalisation/forest.h"
#include "pose/search_plan.h"
#include "support/catch.h"
#include "support/error_message.h"

namespace foothold {
namespace {

using Values = std::map<std::string, std::string>;

template <class Settings>
Values values_of(const Settings& settings) {
  Values values;
  for (const SettingDescription& setting : describe_settings(settings)) values[setting.path] = setting.value;
  return values;
}

/// The defaults, as documented.
const Values kTuned = {
    {"features.downscale", "4"},
    {"reservoirs.capacity", "112"},
    {"reservoirs.grid_spacing_px", "8"},
    {"reservoirs.examples_per_view", "255"},
    {"reservoirs.jitter", "true"},
    {"clustering.min_cluster_size", "8"},
    {"clustering.max_modes", "10"},
    {"clustering.covariance_floor_m", "0.005"},
    {"clustering.touched_first", "true"},
    {"clustering.leaves_per_frame", "1024"},
    {"clustering.point_budget", "16000"},
    {"pose.pool_size", "4000"},
    {"pose.num_hypotheses", "256"},
    {"pose.num_candidates", "16"},
    {"pose.as_published", "false"},
    {"acceptance_threshold", "0.75"},
    {"num_rolls", "8"},
    {"sure_confidence", "0.97"},
    {"place_radius_m", "4"},
    {"max_relocalise_ms", "0"},
    {"memory_budget_mb", "0"},
    {"seed", "42"},
};

/// What the paper, or its authors' code, has instead.
const Values kPaperDiffers = {
    {"features.downscale", "1"},           {"reservoirs.capacity", "1024"},
    {"reservoirs.grid_spacing_px", "4"},   {"reservoirs.jitter", "false"},
    {"clustering.min_cluster_size", "20"}, {"clustering.covariance_floor_m", "0.02"},
    {"clustering.touched_first", "false"}, {"clustering.leaves_per_frame", "256"},
    {"clustering.point_budget", "0"},      {"pose.num_hypotheses", "1024"},
    {"pose.as_published", "true"},         {"num_rolls", "1"},
    {"reservoirs.examples_per_view", "0"}, {"place_radius_m", "16"},
};

const Values kRandomForest = {
    {"num_trees", "5"},         {"depth", "13"},
    {"num_features", "256"},    {"min_offset_px_m", "2"},
    {"max_offset_px_m", "65"},  {"depth_threshold_mm", "300"},
    {"colour_threshold", "25"}, {"seed", "42"},
};

TEST_CASE("ForestRelocaliserSettings: every default is as documented") {
  REQUIRE(values_of(ForestRelocaliserSettings{}) == kTuned);
  REQUIRE(values_of(ForestRelocaliserSettings::preset("tuned")) == kTuned);
  REQUIRE_NOTHROW(ForestRelocaliserSettings{}.validate());
}

TEST_CASE("ForestRelocaliserSettings: the preset 'paper' holds the paper's values") {
  Values expected = kTuned;
  for (const auto& [path, value] : kPaperDiffers) expected[path] = value;
  const ForestRelocaliserSettings paper = ForestRelocaliserSettings::preset("paper");
  REQUIRE(values_of(paper) == expected);
  REQUIRE_NOTHROW(paper.validate());
}

TEST_CASE("SearchPlan: the numbers of the paper and of its authors' code, and the tuned ones") {
  const SearchPlan tuned(PoseEstimatorSettings{}, 7);
  REQUIRE(tuned.seed == 7);
  REQUIRE(tuned.max_draws == 100);
  REQUIRE(tuned.max_rigidity_error_m == 0.05F);
  REQUIRE(tuned.scan_modes);
  REQUIRE(tuned.first_cull_samples == 100);
  REQUIRE(tuned.cull_survivors == 32);
  REQUIRE(tuned.round_samples == 250);
  REQUIRE(tuned.energy_truncation == 3.0F);
  REQUIRE(tuned.round_iterations == 3);
  REQUIRE(tuned.final_iterations == 4);
  REQUIRE(tuned.confronts_scene);
  const SearchPlan paper(ForestRelocaliserSettings::preset("paper").pose, 7);
  REQUIRE(paper.max_draws == 6000);
  REQUIRE(paper.max_rigidity_error_m == 0.025F);
  REQUIRE_FALSE(paper.scan_modes);
  REQUIRE(paper.first_cull_samples == kCullSamples);
  REQUIRE(paper.cull_survivors == 64);
  REQUIRE(paper.round_samples == 500);
  REQUIRE(paper.energy_truncation == 1e6F);
  REQUIRE(paper.round_iterations == 10);
  REQUIRE(paper.final_iterations == 10);
  REQUIRE_FALSE(paper.confronts_scene);
}

TEST_CASE("SearchPlan: returns no more candidates than hypotheses are drawn") {
  PoseEstimatorSettings settings;
  settings.num_hypotheses = 20;
  settings.num_candidates = 64;
  REQUIRE(SearchPlan(settings, 1).num_candidates == 20);
}

TEST_CASE("ForestRelocaliserSettings: an unknown preset is refused, and the known ones named") {
  const std::string message = test::error_message<InvalidSettings>([] { ForestRelocaliserSettings::preset("fast"); });
  REQUIRE(test::contains(message, "fast"));
  REQUIRE(test::contains(message, "tuned"));
  REQUIRE(test::contains(message, "paper"));
}

TEST_CASE("RandomForestSettings: every default is as documented") { REQUIRE(values_of(RandomForestSettings{}) == kRandomForest); }

/// Sets each number of a settings object below and above its range and to NaN, and expects `validate` to name it.
template <class Settings, class Validate>
void expect_every_field_named(const Validate& validate) {
  int num_fields = 0;
  detail::walk_fields(*std::make_unique<Settings>(), [&](const std::string& path, const auto& value, const char*, const Range& range) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (!std::is_same_v<T, bool> && !std::is_same_v<T, std::uint64_t>) {
      ++num_fields;
      for (const int side : {-1, 1, 0}) {
        if (side == 0 && !std::is_floating_point_v<T>) continue;
        const T bad = side == 0  ? std::numeric_limits<T>::quiet_NaN()
                      : side < 0 ? static_cast<T>(range.low - 1.0)
                                 : static_cast<T>(range.high * 1.1 + 1.0);
        Settings settings;
        detail::walk_fields(settings, [&](const std::string& other, auto& field, const char*, const Range&) {
          if constexpr (std::is_same_v<std::decay_t<decltype(field)>, T>) {
            if (other == path) field = bad;
          }
        });
        const std::string message = test::error_message<InvalidSettings>([&] { validate(settings); });
        INFO(path << ": " << message);
        REQUIRE(test::contains(message, path));
        REQUIRE(test::contains(message, detail::range_text(range)));
      }
    }
  });
  REQUIRE(num_fields > 5);
}

TEST_CASE("ForestRelocaliserSettings: validate names every field that is out of range") {
  expect_every_field_named<ForestRelocaliserSettings>([](const ForestRelocaliserSettings& settings) { settings.validate(); });
}

TEST_CASE("RandomForestSettings: make_random_forest names every field that is out of range") {
  expect_every_field_named<RandomForestSettings>([](const RandomForestSettings& settings) { make_random_forest(settings); });
  RandomForestSettings settings;
  settings.min_offset_px_m = 66.0F;
  const std::string message = test::error_message<InvalidSettings>([&] { make_random_forest(settings); });
  REQUIRE(test::contains(message, "max_offset_px_m"));
  REQUIRE(test::contains(message, "66"));
}

TEST_CASE("ForestRelocaliserSettings: validate names fields that contradict each other") {
  ForestRelocaliserSettings settings;
  settings.clustering.min_cluster_size = 113;
  const std::string message = test::error_message<InvalidSettings>([&] { settings.validate(); });
  REQUIRE(test::contains(message, "clustering.min_cluster_size"));
  REQUIRE(test::contains(message, "113"));
  REQUIRE(test::contains(message, "reservoirs.capacity = 112"));
  settings.clustering.min_cluster_size = 112;
  REQUIRE_NOTHROW(settings.validate());
}

}  // namespace
}  // namespace foothold
