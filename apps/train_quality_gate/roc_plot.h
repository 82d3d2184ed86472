// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Draws receiver operating characteristics.
#pragma once

#include <string>
#include <vector>

#include "foothold/base/image.h"
#include "foothold/learning/classifier_training.h"

namespace foothold::apps {

/// A curve and what stands above it.
struct NamedReport {
  std::string title;
  ClassifierReport report;
};

/// One panel for each report, side by side: true positives over false positives, the latter on a logarithmic axis.
Image<Rgb8> draw_roc(const std::vector<NamedReport>& reports);

}  // namespace foothold::apps
