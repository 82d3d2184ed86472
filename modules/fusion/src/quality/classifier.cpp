// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/classifier.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>
#include <sstream>
#include <system_error>

#include "foothold/base/contract.h"
#include "foothold/base/embedded_file.h"
#include "foothold/base/error.h"

namespace foothold {

extern const EmbeddedFile kTrackingQualityFile;  // data/tracking_quality.txt
extern const EmbeddedFile kPoseAcceptanceFile;   // data/pose_acceptance.txt

namespace {
/// Sampling period of the kernel's spectrum. [Vedaldi2012] Sec. 4.2 gives its optimum as a function of the order; about 0.65 for two.
constexpr double kPeriod = 0.65;
constexpr const char* kFirstLine = "foothold-classifier 1";
constexpr std::size_t kMaxFeatures = 64;
constexpr std::size_t kMaxProvenance = 1000;

/// The spectrum of the chi-square kernel's signature: sech(pi lambda).
double spectrum(double lambda) { return 1.0 / std::cosh(3.14159265358979323846 * lambda); }

/// A number as text that reads back exactly, whatever the host's locale.
std::string text_of(float value) {
  constexpr int kExactDigits = std::numeric_limits<float>::max_digits10;
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value, std::chars_format::general, kExactDigits);
  return error == std::errc() ? std::string(text, end) : std::string();
}

/// Reads the lines of a classifier file.
class Parser {
 public:
  Parser(std::istream& stream, const std::string& file_name) : stream_(stream), file_name_(file_name) {}

  ClassifierModel parse() {
    if (!next_line() || line_ != kFirstLine) fail(std::string("expected '") + kFirstLine + "'");
    while (next_line()) parse_line();
    if (model_.features.empty()) fail("expected at least one feature");
    if (!has_bias_) fail("expected a bias");
    if (!has_thresholds_) fail("expected thresholds");
    return model_;
  }

 private:
  bool next_line() {
    if (!std::getline(stream_, line_)) {
      line_ = "the end of the file";
      return false;
    }
    ++number_;
    return true;
  }

  [[noreturn]] void fail(const std::string& expectation) const {
    throw FileError(file_name_ + ":" + std::to_string(number_) + ": got '" + line_.substr(0, 80) + "', " + expectation);
  }

  float number(std::istringstream& words) const {
    std::string word;
    words >> word;
    float value = 0.0F;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);  // heeds no locale
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail("expected a finite number instead of '" + word.substr(0, 40) + "'");
    return value;
  }

  void end(std::istringstream& words) const {
    std::string word;
    if (words >> word) fail("expected nothing after the numbers");
  }

  void parse_line() {
    if (line_.empty() || line_[0] == '#') return;
    std::istringstream words(line_);
    std::string key;
    words >> key;
    if (key == "provenance") {
      if (model_.provenance.size() == kMaxProvenance) fail("expected fewer lines of provenance");
      model_.provenance.push_back(line_.size() > key.size() + 1 ? line_.substr(key.size() + 1) : "");
    } else if (key == "name") {
      words >> model_.name;
    } else if (key == "feature") {
      parse_feature(words);
    } else if (key == "bias") {
      model_.bias = number(words);
      end(words);
      has_bias_ = true;
    } else if (key == "probability") {
      model_.probability_scale = number(words);
      model_.probability_offset = number(words);
      end(words);
      if (!(model_.probability_scale > 0.0F)) fail("expected a positive scale");
    } else if (key == "thresholds") {
      model_.good_threshold = number(words);
      model_.poor_threshold = number(words);
      end(words);
      has_thresholds_ = true;
      if (model_.poor_threshold > model_.good_threshold) fail("expected the threshold of poor not above that of good");
    } else {
      fail("expected name, provenance, feature, bias, probability or thresholds");
    }
  }

  void parse_feature(std::istringstream& words) {
    if (model_.features.size() == kMaxFeatures) fail("expected fewer features");
    ClassifierModel::Feature feature;
    words >> feature.name;
    feature.mean = number(words);
    feature.deviation = number(words);
    if (!(feature.deviation > 0.0F)) fail("expected a positive deviation");
    for (float& weight : feature.weights) weight = number(words);
    end(words);
    model_.features.push_back(feature);
  }

  std::istream& stream_;
  std::string file_name_;
  std::string line_;
  int number_ = 0;
  bool has_bias_ = false;
  bool has_thresholds_ = false;
  ClassifierModel model_;
};
}  // namespace

void map_chi_square(float x, Span<float> mapped) {
  FOOTHOLD_EXPECTS(mapped.size() == kKernelMapSize);
  const double magnitude = std::abs(double{x});
  if (magnitude < 1e-12) {
    for (float& value : mapped) value = 0.0F;
    return;
  }
  const double sign = x < 0.0F ? -1.0 : 1.0;
  const double phase = kPeriod * std::log(magnitude);
  mapped[0] = static_cast<float>(sign * std::sqrt(magnitude * kPeriod * spectrum(0.0)));
  for (int j = 1; j <= kKernelMapSize / 2; ++j) {
    const double amplitude = sign * std::sqrt(2.0 * magnitude * kPeriod * spectrum(j * kPeriod));
    mapped[static_cast<std::size_t>(2 * j - 1)] = static_cast<float>(amplitude * std::cos(j * phase));
    mapped[static_cast<std::size_t>(2 * j)] = static_cast<float>(amplitude * std::sin(j * phase));
  }
}

void ClassifierModel::map(Span<const float> values, Span<float> mapped) const {
  FOOTHOLD_EXPECTS(values.size() == features.size());
  FOOTHOLD_EXPECTS(mapped.size() == features.size() * kKernelMapSize);
  for (std::size_t i = 0; i < features.size(); ++i) {
    const float deviations = (values[i] - features[i].mean) / features[i].deviation;
    map_chi_square(std::min(kMostDeviations, std::max(-kMostDeviations, deviations)),
                   Span<float>(mapped.data() + i * kKernelMapSize, kKernelMapSize));
  }
}

float ClassifierModel::score(Span<const float> values) const {
  if (std::any_of(values.begin(), values.end(), [](float value) { return std::isnan(value); })) {
    return -std::numeric_limits<float>::infinity();
  }
  std::vector<float> mapped(features.size() * kKernelMapSize);
  map(values, Span<float>(mapped.data(), mapped.size()));
  double sum = bias;
  for (std::size_t i = 0; i < mapped.size(); ++i)
    sum += double{mapped[i]} * double{features[i / kKernelMapSize].weights[i % kKernelMapSize]};
  return static_cast<float>(sum);
}

float ClassifierModel::probability(float score) const {
  return static_cast<float>(1.0 / (1.0 + std::exp(-(double{probability_scale} * double{score} + double{probability_offset}))));
}

ClassifierModel read_classifier(std::istream& stream, const std::string& file_name) { return Parser(stream, file_name).parse(); }

void write_classifier(std::ostream& stream, const ClassifierModel& model) {
  stream << kFirstLine << "\nname " << model.name << '\n';
  for (const std::string& line : model.provenance) stream << "provenance " << line << '\n';
  stream << "# feature NAME MEAN DEVIATION and the weights of its five mapped values\n";
  for (const ClassifierModel::Feature& feature : model.features) {
    stream << "feature " << feature.name << ' ' << text_of(feature.mean) << ' ' << text_of(feature.deviation);
    for (const float weight : feature.weights) stream << ' ' << text_of(weight);
    stream << '\n';
  }
  stream << "bias " << text_of(model.bias) << "\n# P(positive) = 1 / (1 + exp(-(a score + b))): a b\n";
  stream << "probability " << text_of(model.probability_scale) << ' ' << text_of(model.probability_offset)
         << "\n# scores above: good, poor\n";
  stream << "thresholds " << text_of(model.good_threshold) << ' ' << text_of(model.poor_threshold) << '\n';
  stream.flush();
  if (!stream) throw FileError("classifier '" + model.name + "': writing failed");
}

namespace {
ClassifierModel parse_embedded(const EmbeddedFile& file, const char* name) {
  std::istringstream stream(file.bytes());
  return read_classifier(stream, name);
}
}  // namespace

const ClassifierModel& default_tracking_classifier() {
  static const ClassifierModel model = parse_embedded(kTrackingQualityFile, "data/tracking_quality.txt");
  return model;
}

const ClassifierModel& default_acceptance_classifier() {
  static const ClassifierModel model = parse_embedded(kPoseAcceptanceFile, "data/pose_acceptance.txt");
  return model;
}

}  // namespace foothold
