// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/learning/classifier_training.h"

#include <cmath>

#include "foothold/base/error.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Sum of four uniform numbers: close enough to a Gaussian of deviation `scale`.
float bell(Random& random, float scale) {
  float sum = 0.0F;
  for (int i = 0; i < 4; ++i) sum += random.uniform(-0.866F, 0.866F);
  return scale * sum;
}

/// Positives where the root of the first value outweighs the second: a curve, which the map follows and a straight line does not. The third
/// value says nothing.
std::vector<ClassifierExample> curved_examples(Random& random, int count, float noise = 0.0F) {
  std::vector<ClassifierExample> examples;
  for (int i = 0; i < count; ++i) {
    const float x = random.uniform(-3.0F, 3.0F);
    const float y = random.uniform(-3.0F, 3.0F);
    ClassifierExample example;
    example.positive = std::copysign(std::sqrt(std::abs(x)), x) > y;
    for (const float value : {x + bell(random, noise), y, random.uniform()}) example.values.push_back(value);
    example.group = i % 3;
    examples.push_back(example);
  }
  return examples;
}

const std::vector<std::string> kNames = {"x", "y", "nothing"};

TEST_CASE("train_classifier: learns a curved boundary, the same each time") {
  Random random = test::test_random();
  const std::vector<ClassifierExample> examples = curved_examples(random, 1500);
  ClassifierReport report;
  const ClassifierModel model = train_classifier("curve", kNames, examples, {}, report);
  REQUIRE(report.auc > 0.995);
  REQUIRE(report.num_positive + report.num_negative == 1500);
  const auto score = [&](float x, float y) {
    const float values[] = {x, y, 0.5F};
    return model.score(Span<const float>(values, 3));
  };
  // On either side of the curve; the straight line of least error, y = 0.6 x, has them the other way round.
  REQUIRE(score(0.25F, 0.3F) > score(2.9F, 1.85F));
  REQUIRE(model.probability(score(2.0F, -1.0F)) > 0.8F);
  REQUIRE(model.probability(score(-2.0F, 1.0F)) < 0.2F);
  ClassifierReport again;
  const ClassifierModel same = train_classifier("curve", kNames, examples, {}, again);
  REQUIRE(same.features[0].weights[2] == model.features[0].weights[2]);
  REQUIRE(same.good_threshold == model.good_threshold);
}

TEST_CASE("train_classifier: thresholds keep the rates they promise, cross-validated") {
  Random random = test::test_random();
  ClassifierTrainingSettings settings;
  settings.max_false_positives = 0.01F;
  settings.max_false_negatives = 0.02F;
  ClassifierReport report;
  const ClassifierModel model = train_classifier("curve", kNames, curved_examples(random, 3000, 0.1F), settings, report);
  REQUIRE(report.false_positive_rate_good <= 0.01);
  REQUIRE(report.false_negative_rate_poor <= 0.02);
  REQUIRE(model.good_threshold >= model.poor_threshold);
  REQUIRE(report.true_positive_rate_good > 0.3);
  REQUIRE(report.roc.front().true_positive_rate == 0.0);
  REQUIRE(report.roc.back().true_positive_rate == 1.0);
  REQUIRE(report.roc.back().false_positive_rate == 1.0);
}

TEST_CASE("receiver_operating_characteristic: areas of orders with a known answer") {
  const auto area = [](const std::vector<float>& scores, const std::vector<std::uint8_t>& positive) {
    double auc = -1.0;
    receiver_operating_characteristic(scores, positive, &auc);
    return auc;
  };
  REQUIRE(area({4.0F, 3.0F, 2.0F, 1.0F}, {1, 1, 0, 0}) == Approx(1.0));
  REQUIRE(area({4.0F, 3.0F, 2.0F, 1.0F}, {0, 0, 1, 1}) == Approx(0.0));
  REQUIRE(area({4.0F, 3.0F, 2.0F, 1.0F}, {1, 0, 1, 0}) == Approx(0.75));
  REQUIRE(area({1.0F, 1.0F, 1.0F, 1.0F}, {1, 0, 1, 0}) == Approx(0.5));  // ties say nothing
}

TEST_CASE("train_classifier: says what is wrong with the examples") {
  Random random = test::test_random();
  ClassifierReport report;
  const auto message = [&](std::vector<ClassifierExample> examples) {
    return test::error_message<InvalidSettings>([&] { train_classifier("x", kNames, examples, {}, report); });
  };
  std::vector<ClassifierExample> one_group = curved_examples(random, 60);
  for (ClassifierExample& example : one_group) example.group = 7;
  REQUIRE(test::contains(message(one_group), "two or more"));
  std::vector<ClassifierExample> one_kind = curved_examples(random, 60);
  for (ClassifierExample& example : one_kind) example.positive = true;
  REQUIRE(test::contains(message(one_kind), "both kinds"));
  REQUIRE(test::contains(message({}), "both kinds"));
}

}  // namespace
}  // namespace foothold
