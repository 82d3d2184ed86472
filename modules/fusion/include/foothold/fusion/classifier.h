// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A linear classifier behind a kernel map, read from a text file: what grades tracking and rates relocalised poses.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "foothold/base/span.h"

namespace foothold {

/// Values that the kernel map makes of one feature.
inline constexpr int kKernelMapSize = 5;

/// The explicit feature map of the homogeneous chi-square kernel 2xy / (x + y), of order 2, for negative x continued as an odd function:
/// a linear classifier over it is, approximately, a kernel classifier. Reference: [Vedaldi2012] Eq. 14.
///
/// @param mapped  Receives kKernelMapSize values.
void map_chi_square(float x, Span<float> mapped);

/// Further from the mean than this the map would extrapolate beyond what training saw: it is as bad, or as good, as it gets.
inline constexpr float kMostDeviations = 6.0F;

/// A classifier as its file holds it.
struct ClassifierModel {
  /// A feature: its name, what it is normalised by, and the weights of its kernel map.
  struct Feature {
    std::string name;                    ///< as the caller names its values
    float mean = 0.0F;                   ///< of the training values
    float deviation = 1.0F;              ///< positive
    float weights[kKernelMapSize] = {};  ///< one for each value of the kernel map
  };

  std::string name;                     ///< what it decides
  std::vector<std::string> provenance;  ///< what it was trained on, by what, when: free text, line by line
  std::vector<Feature> features;        ///< in the order of the values
  float bias = 0.0F;                    ///< added to the weighted sum: the score of an event
  /// P(positive) = 1 / (1 + exp(-(probability_scale * score + probability_offset))). Reference: [Platt1999].
  float probability_scale = 1.0F;
  float probability_offset = 0.0F;  ///< as above
  /// Scores above it are good.
  float good_threshold = 0.0F;
  /// Scores above it, but not good, are poor; below, failed.
  float poor_threshold = 0.0F;

  /// Normalises each value by its feature's mean and deviation, keeps it within kMostDeviations, and maps it.
  /// @param mapped  Receives kKernelMapSize values for each feature. @pre As many values as features.
  void map(Span<const float> values, Span<float> mapped) const;
  /// The weighted sum of the mapped, normalised features, plus the bias. NaN among the features gives -infinity.
  /// @pre As many values as features.
  float score(Span<const float> values) const;
  /// The calibrated probability of a score.
  float probability(float score) const;
};

/// Reads a classifier. @throws FileError naming the line, what it says and what was expected.
ClassifierModel read_classifier(std::istream& stream, const std::string& file_name);
/// Writes a classifier that read_classifier() reads back exactly. @throws FileError
void write_classifier(std::ostream& stream, const ClassifierModel& model);

/// The gate that grades tracking, as shipped in data/tracking_quality.txt. Features as of quality_features().
const ClassifierModel& default_tracking_classifier();
/// The classifier that accepts relocalised poses, as shipped in data/pose_acceptance.txt. Features as of acceptance_features().
const ClassifierModel& default_acceptance_classifier();

}  // namespace foothold
