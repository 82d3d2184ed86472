// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/learning/classifier_training.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>
#include <set>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"

namespace foothold {

namespace {

using Examples = std::vector<const ClassifierExample*>;

/// Mean and deviation of every feature, over positives and negatives with equal weight.
void normalise(const Examples& examples, ClassifierModel& model) {
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    double sum[2] = {};
    double sum2[2] = {};
    double count[2] = {};
    for (const ClassifierExample* example : examples) {
      const double x = example->values[f];
      const int side = example->positive ? 1 : 0;
      sum[side] += x;
      sum2[side] += x * x;
      count[side] += 1.0;
    }
    const double mean = 0.5 * (sum[0] / count[0] + sum[1] / count[1]);
    const double square = 0.5 * (sum2[0] / count[0] + sum2[1] / count[1]);
    model.features[f].mean = static_cast<float>(mean);
    model.features[f].deviation = static_cast<float>(std::sqrt(std::max(square - mean * mean, 1e-12)));
  }
}

cv::Mat map_examples(const Examples& examples, const ClassifierModel& model) {
  const int width = static_cast<int>(model.features.size()) * kKernelMapSize;
  cv::Mat mapped(static_cast<int>(examples.size()), width, CV_32F);
  for (std::size_t i = 0; i < examples.size(); ++i)
    model.map(examples[i]->values, Span<float>(mapped.ptr<float>(static_cast<int>(i)), static_cast<std::size_t>(width)));
  return mapped;
}

/// Fits normalisation and weights.
ClassifierModel fit(const std::string& name, const std::vector<std::string>& names, const Examples& examples, float penalty) {
  ClassifierModel model;
  model.name = name;
  for (const std::string& feature : names) {
    model.features.emplace_back();
    model.features.back().name = feature;
  }
  normalise(examples, model);
  cv::Mat labels(static_cast<int>(examples.size()), 1, CV_32S);
  double num_positive = 0.0;
  for (std::size_t i = 0; i < examples.size(); ++i) {
    labels.at<int>(static_cast<int>(i)) = examples[i]->positive ? 1 : -1;
    num_positive += examples[i]->positive ? 1.0 : 0.0;
  }
  const double total = static_cast<double>(examples.size());
  const cv::Ptr<cv::ml::SVM> svm = cv::ml::SVM::create();
  svm->setType(cv::ml::SVM::C_SVC);
  svm->setKernel(cv::ml::SVM::LINEAR);
  svm->setC(penalty);
  // Both kinds count alike, however many there are. Classes are in the order of their labels.
  svm->setClassWeights((cv::Mat_<double>(1, 2) << 0.5 * total / (total - num_positive), 0.5 * total / num_positive));
  svm->setTermCriteria(cv::TermCriteria(cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, 200000, 1e-4));
  svm->train(map_examples(examples, model), cv::ml::ROW_SAMPLE, labels);
  // The decision function is sum_i alpha_i sv_i . x - rho, positive for the first label, which is -1.
  cv::Mat alpha;
  cv::Mat indices;
  const double rho = svm->getDecisionFunction(0, alpha, indices);
  const cv::Mat vectors = svm->getSupportVectors();
  std::vector<double> weights(names.size() * kKernelMapSize, 0.0);
  for (int i = 0; i < static_cast<int>(alpha.total()); ++i) {
    const float* vector = vectors.ptr<float>(indices.at<int>(i));
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k] -= alpha.at<double>(i) * double{vector[k]};
  }
  for (std::size_t k = 0; k < weights.size(); ++k)
    model.features[k / kKernelMapSize].weights[k % kKernelMapSize] = static_cast<float>(weights[k]);
  model.bias = static_cast<float>(rho);
  // Whichever label the library calls the first: positives must score higher.
  double difference = 0.0;
  double counts[2] = {};
  double sums[2] = {};
  for (const ClassifierExample* example : examples) {
    counts[example->positive ? 1 : 0] += 1.0;
    sums[example->positive ? 1 : 0] += double{model.score(example->values)};
  }
  difference = sums[1] / counts[1] - sums[0] / counts[0];
  if (difference < 0.0) {
    model.bias = -model.bias;
    for (ClassifierModel::Feature& feature : model.features) {
      for (float& weight : feature.weights) weight = -weight;
    }
  }
  return model;
}

/// Fits P(positive | score) by Newton's method, with Platt's targets that keep it away from 0 and 1.
void calibrate(const std::vector<float>& scores, const std::vector<std::uint8_t>& positive, ClassifierModel& model) {
  const double num_positive = std::accumulate(positive.begin(), positive.end(), 0.0);
  const double num_negative = static_cast<double>(positive.size()) - num_positive;
  const double high = (num_positive + 1.0) / (num_positive + 2.0);
  const double low = 1.0 / (num_negative + 2.0);
  double a = 1.0;
  double b = 0.0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    double gradient[2] = {};
    double hessian[3] = {1e-9, 0.0, 1e-9};
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const double s = std::max(-50.0F, std::min(50.0F, scores[i]));
      const double p = 1.0 / (1.0 + std::exp(-(a * s + b)));
      // Both kinds count alike, so that the probability does not depend on how many failures training happened to make.
      const double weight = positive[i] != 0 ? 0.5 / num_positive : 0.5 / num_negative;
      const double error = weight * (p - (positive[i] != 0 ? high : low));
      gradient[0] += error * s;
      gradient[1] += error;
      const double curvature = weight * p * (1.0 - p);
      hessian[0] += curvature * s * s;
      hessian[1] += curvature * s;
      hessian[2] += curvature;
    }
    const double determinant = hessian[0] * hessian[2] - hessian[1] * hessian[1];
    const double step_a = (hessian[2] * gradient[0] - hessian[1] * gradient[1]) / determinant;
    const double step_b = (hessian[0] * gradient[1] - hessian[1] * gradient[0]) / determinant;
    const double shorten = std::min(1.0, 1.0 / std::max(std::abs(step_a), std::abs(step_b)));
    a -= shorten * step_a;
    b -= shorten * step_b;
    if (std::abs(step_a) + std::abs(step_b) < 1e-9) break;
  }
  model.probability_scale = static_cast<float>(a);
  model.probability_offset = static_cast<float>(b);
}

/// The smallest of the values that at most `fraction` of them exceed.
float exceeded_by_at_most(std::vector<float> values, double fraction) {
  std::sort(values.begin(), values.end(), std::greater<>());
  const auto allowed = static_cast<std::size_t>(fraction * static_cast<double>(values.size()));
  return values[std::min(allowed, values.size() - 1)];
}

/// A threshold just below the values, but for at most `fraction` of them.
float not_reached_by_at_most(std::vector<float> values, double fraction) {
  std::sort(values.begin(), values.end());
  const auto allowed = static_cast<std::size_t>(fraction * static_cast<double>(values.size()));
  return std::nextafter(values[std::min(allowed, values.size() - 1)], -std::numeric_limits<float>::infinity());
}

double part_above(const std::vector<float>& values, float threshold) {
  const auto count = std::count_if(values.begin(), values.end(), [&](float value) { return value > threshold; });
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

void require_both_kinds(const Examples& examples) {
  const auto num_positive = std::count_if(examples.begin(), examples.end(), [](const ClassifierExample* e) { return e->positive; });
  if (num_positive == 0 || num_positive == static_cast<std::ptrdiff_t>(examples.size())) {
    throw InvalidSettings("training a classifier: got " + std::to_string(num_positive) + " positive of " + std::to_string(examples.size()) +
                          " examples, expected both kinds in more than one recording");
  }
}

}  // namespace

std::vector<RocPoint> receiver_operating_characteristic(Span<const float> scores, Span<const std::uint8_t> positive, double* auc) {
  FOOTHOLD_EXPECTS(scores.size() == positive.size());
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return scores[a] > scores[b]; });
  const double num_positive = std::accumulate(positive.begin(), positive.end(), 0.0);
  const double num_negative = static_cast<double>(scores.size()) - num_positive;
  std::vector<RocPoint> roc = {{std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  double hits = 0.0;
  double false_alarms = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    (positive[order[i]] != 0 ? hits : false_alarms) += 1.0;
    if (i + 1 < order.size() && scores[order[i + 1]] == scores[order[i]]) continue;  // ties in one step
    const RocPoint point{scores[order[i]], false_alarms / std::max(1.0, num_negative), hits / std::max(1.0, num_positive)};
    area += (point.false_positive_rate - roc.back().false_positive_rate) * 0.5 * (point.true_positive_rate + roc.back().true_positive_rate);
    roc.push_back(point);
  }
  if (auc != nullptr) *auc = area;
  return roc;
}

ClassifierModel train_classifier(const std::string& name, const std::vector<std::string>& names,
                                 const std::vector<ClassifierExample>& examples, const ClassifierTrainingSettings& settings,
                                 ClassifierReport& report) {
  settings.validate();
  Examples used;
  const std::size_t stride = std::max<std::size_t>(
      1, (examples.size() + static_cast<std::size_t>(settings.max_examples) - 1) / static_cast<std::size_t>(settings.max_examples));
  for (std::size_t i = 0; i < examples.size(); i += stride) {
    FOOTHOLD_EXPECTS(examples[i].values.size() == names.size());
    used.push_back(&examples[i]);
  }
  require_both_kinds(used);
  std::set<int> groups;
  for (const ClassifierExample* example : used) groups.insert(example->group);
  if (groups.size() < 2)
    throw InvalidSettings("training a classifier: got examples of one recording, expected two or more for cross-validation");

  std::vector<float> scores;
  std::vector<std::uint8_t> positive;
  std::vector<float> scores_of[2];
  for (const int group : groups) {
    Examples others;
    for (const ClassifierExample* example : used) {
      if (example->group != group) others.push_back(example);
    }
    require_both_kinds(others);
    const ClassifierModel model = fit(name, names, others, settings.penalty);
    for (const ClassifierExample* example : used) {
      if (example->group != group) continue;
      scores.push_back(model.score(example->values));
      positive.push_back(example->positive ? 1 : 0);
      scores_of[example->positive ? 1 : 0].push_back(scores.back());
    }
  }

  ClassifierModel model = fit(name, names, used, settings.penalty);
  calibrate(scores, positive, model);
  model.good_threshold = exceeded_by_at_most(scores_of[0], double{settings.max_false_positives});
  model.poor_threshold = std::min(model.good_threshold, not_reached_by_at_most(scores_of[1], double{settings.max_false_negatives}));
  report.num_positive = static_cast<int>(scores_of[1].size());
  report.num_negative = static_cast<int>(scores_of[0].size());
  report.roc = receiver_operating_characteristic(scores, positive, &report.auc);
  report.true_positive_rate_good = part_above(scores_of[1], model.good_threshold);
  report.false_positive_rate_good = part_above(scores_of[0], model.good_threshold);
  report.false_negative_rate_poor = 1.0 - part_above(scores_of[1], model.poor_threshold);
  report.true_negative_rate_poor = 1.0 - part_above(scores_of[0], model.poor_threshold);
  return model;
}

}  // namespace foothold
