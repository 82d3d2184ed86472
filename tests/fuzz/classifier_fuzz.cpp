// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Classifiers: what is accepted judges any features, and reads the same once written again.
#include "foothold/fusion/classifier.h"

#include <limits>
#include <sstream>

#include "fuzz.h"

FOOTHOLD_FUZZ_TARGET(classifier) {
  using namespace foothold;
  fuzz::attempt([&] {
    std::istringstream stream(fuzz::text_of(data, size));
    const ClassifierModel model = read_classifier(stream, "a.txt");
    for (const float value : {0.0F, -3.5F, 1e30F, std::numeric_limits<float>::quiet_NaN()}) {
      const std::vector<float> values(model.features.size(), value);
      const float probability = model.probability(model.score(values));
      fuzz::require(probability >= 0.0F && probability <= 1.0F);
    }
    std::stringstream written;
    write_classifier(written, model);
    const std::string text = written.str();
    std::ostringstream again;
    write_classifier(again, read_classifier(written, "a.txt"));
    fuzz::require(again.str() == text);
  });
  return 0;
}
