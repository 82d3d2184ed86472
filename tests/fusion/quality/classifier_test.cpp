// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/classifier.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "foothold/base/error.h"
#include "foothold/fusion/pose_refiner.h"
#include "foothold/fusion/tracking_quality.h"
#include "support/catch.h"
#include "support/comma_locale.h"
#include "support/error_message.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

std::array<float, kKernelMapSize> mapped(float x) {
  std::array<float, kKernelMapSize> result{};
  map_chi_square(x, Span<float>(result.data(), result.size()));
  return result;
}

double product(float x, float y) {
  const auto a = mapped(x);
  const auto b = mapped(y);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double{a[i]} * double{b[i]};
  return sum;
}

constexpr const char* kText =
    "foothold-classifier 1\n"
    "name example\n"
    "provenance made by hand\n"
    "provenance for a test\n"
    "\n"
    "# a comment\n"
    "feature size 1.5 0.25 1 2 3 4 5\n"
    "feature shape -2 3 -1 0 0.5 1e-3 0\n"
    "bias -0.75\n"
    "probability 2 0.5\n"
    "thresholds 1 -1\n";

ClassifierModel parse(const std::string& text) {
  std::istringstream stream(text);
  return read_classifier(stream, "test.txt");
}

/// kText with one piece replaced.
std::string altered(const std::string& from, const std::string& to) {
  std::string text = kText;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("map_chi_square: products approximate the chi-square kernel") {
  Random random = test::test_random();
  for (int i = 0; i < 1000; ++i) {
    // Normalised features: within a factor of ten of each other, where the map of order 2 is made to hold.
    const float x = std::exp(random.uniform(-1.5F, 1.0F));
    const float y = x * std::exp(random.uniform(-1.0F, 1.0F));
    const double kernel = 2.0 * double{x} * double{y} / (double{x} + double{y});
    REQUIRE(std::abs(product(x, y) - kernel) < 0.06 * kernel);
  }
}

TEST_CASE("map_chi_square: odd, zero at zero, and of five values") {
  for (const float x : {0.01F, 0.5F, 1.0F, 6.0F}) {
    for (int k = 0; k < kKernelMapSize; ++k) REQUIRE(mapped(-x)[static_cast<std::size_t>(k)] == -mapped(x)[static_cast<std::size_t>(k)]);
  }
  for (const float value : mapped(0.0F)) REQUIRE(value == 0.0F);
}

TEST_CASE("ClassifierModel: the score is the weighted sum of the mapped, normalised features") {
  const ClassifierModel model = parse(kText);
  const std::array<float, 2> values = {1.75F, 1.0F};  // both one deviation above their means
  const auto one = mapped(1.0F);
  const double expected =
      -0.75 + one[0] + 2.0F * one[1] + 3.0F * one[2] + 4.0F * one[3] + 5.0F * one[4] - one[0] + 0.5F * one[2] + 1e-3F * one[3];
  REQUIRE(model.score(Span<const float>(values.data(), 2)) == Approx(expected).margin(1e-5));
  REQUIRE(model.probability(0.0F) == Approx(1.0 / (1.0 + std::exp(-0.5))));
  REQUIRE(model.probability(100.0F) == Approx(1.0F));
}

TEST_CASE("ClassifierModel: NaN is hopeless, infinities and outliers count as far") {
  const ClassifierModel model = parse(kText);
  const auto score = [&](float a) {
    const std::array<float, 2> values = {a, 1.0F};
    return model.score(Span<const float>(values.data(), 2));
  };
  REQUIRE(score(std::numeric_limits<float>::quiet_NaN()) == -std::numeric_limits<float>::infinity());
  REQUIRE(std::isfinite(score(std::numeric_limits<float>::infinity())));
  REQUIRE(score(1e6F) == score(std::numeric_limits<float>::infinity()));
  REQUIRE(score(-1e6F) == score(-std::numeric_limits<float>::infinity()));
}

TEST_CASE("read_classifier: reads what write_classifier wrote, exactly") {
  const ClassifierModel model = parse(kText);
  REQUIRE(model.name == "example");
  REQUIRE(model.provenance == std::vector<std::string>{"made by hand", "for a test"});
  REQUIRE(model.features.size() == 2);
  REQUIRE(model.features[1].name == "shape");
  REQUIRE(model.good_threshold == 1.0F);
  REQUIRE(model.poor_threshold == -1.0F);
  std::ostringstream first;
  write_classifier(first, model);
  const ClassifierModel again = parse(first.str());
  std::ostringstream second;
  write_classifier(second, again);
  REQUIRE(first.str() == second.str());
  REQUIRE(again.features[1].weights[3] == 1e-3F);
  REQUIRE(again.provenance == model.provenance);
}

TEST_CASE("read_classifier, write_classifier: a host's decimal commas change nothing") {
  const ClassifierModel model = parse(kText);
  std::ostringstream expected;
  write_classifier(expected, model);
  const test::CommaLocale commas;
  if (!commas.reached_c()) WARN("C's functions heed no decimal comma here: package locales is missing");
  std::ostringstream written;  // heeds C++'s locale
  written << 1234.5;
  REQUIRE(written.str() == "1.234,5");
  written.str("");
  write_classifier(written, model);
  REQUIRE(written.str() == expected.str());
  REQUIRE(parse(expected.str()).features[0].mean == 1.5F);
  REQUIRE(test::contains(test::error_message<FileError>([] { parse(altered("bias -0.75", "bias -0,75")); }), "'-0,75'"));
}

TEST_CASE("read_classifier: names the line and what is wrong with it") {
  const auto message = [](const std::string& text) { return test::error_message<FileError>([&] { parse(text); }); };
  REQUIRE(message("") == "test.txt:0: got 'the end of the file', expected 'foothold-classifier 1'");
  REQUIRE(test::contains(message(altered("classifier 1", "classifier 2")), "test.txt:1: got 'foothold-classifier 2'"));
  REQUIRE(test::contains(message(altered("feature size", "featur size")), "test.txt:7"));
  REQUIRE(test::contains(message(altered("feature size", "featur size")), "expected name"));
  REQUIRE(test::contains(message(altered(" 4 5\n", " 4\n")), "test.txt:7"));
  REQUIRE(test::contains(message(altered(" 4 5\n", " 4 5 6\n")), "expected nothing after"));
  REQUIRE(test::contains(message(altered("2 3 4 5", "2 nan 4 5")), "'nan'"));
  REQUIRE(test::contains(message(altered("2 3 4 5", "2 1e99 4 5")), "'1e99'"));
  REQUIRE(test::contains(message(altered("2 3 4 5", "2 3x 4 5")), "'3x'"));
  REQUIRE(test::contains(message(altered("1.5 0.25", "1.5 0")), "positive deviation"));
  REQUIRE(test::contains(message(altered("1.5 0.25", "1.5 -1")), "positive deviation"));
  REQUIRE(test::contains(message(altered("bias -0.75\n", "")), "expected a bias"));
  REQUIRE(test::contains(message(altered("bias -0.75", "bias")), "finite number"));
  REQUIRE(test::contains(message(altered("thresholds 1 -1", "thresholds -1 1")), "threshold of poor"));
  REQUIRE(test::contains(message(altered("thresholds 1 -1\n", "")), "expected thresholds"));
  REQUIRE(test::contains(message(altered("probability 2 0.5", "probability 0 0.5")), "positive scale"));
  REQUIRE(test::contains(message("foothold-classifier 1\nbias 1\nthresholds 0 0\n"), "at least one feature"));
}

TEST_CASE("read_classifier: every prefix of a file is refused or read, and nothing else happens") {
  const std::string text = kText;
  for (std::size_t length = 0; length < text.size(); ++length) {
    try {
      parse(text.substr(0, length));
    } catch (const FileError&) {
      continue;
    }
  }
}

TEST_CASE("The classifiers that ship: features in the order of the code, sensible thresholds, provenance from rendered rooms alone") {
  const ClassifierModel& tracking = default_tracking_classifier();
  const auto quality_names = quality_feature_names();
  REQUIRE(tracking.features.size() == quality_names.size());
  for (std::size_t i = 0; i < quality_names.size(); ++i) REQUIRE(tracking.features[i].name == quality_names[i]);
  const ClassifierModel& acceptance = default_acceptance_classifier();
  const auto acceptance_names = acceptance_feature_names();
  REQUIRE(acceptance.features.size() == acceptance_names.size());
  for (std::size_t i = 0; i < acceptance_names.size(); ++i) REQUIRE(acceptance.features[i].name == acceptance_names[i]);
  for (const ClassifierModel* model : {&tracking, &acceptance}) {
    REQUIRE(model->good_threshold > model->poor_threshold);
    REQUIRE(model->probability(model->good_threshold) > model->probability(model->poor_threshold));
    REQUIRE(model->provenance.size() > 2);
    int num_rooms = 0;
    for (const std::string& line : model->provenance) {
      REQUIRE(line.find('/') == std::string::npos);  // no folder: no recording
      num_rooms += line.rfind("synthetic:training-", 0) == 0 ? 1 : 0;
    }
    REQUIRE(num_rooms > 1);
  }
}

}  // namespace
}  // namespace foothold
