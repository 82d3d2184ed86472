// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "trust_evidence.h"

#include "common/app_main.h"
#include "foothold/base/angle.h"
#include "foothold/evaluation/pose_error.h"
#include "foothold/relocalisation/forest_relocaliser.h"
#include "outputs.h"
#include "run_methods.h"

namespace foothold::benchmark {
namespace {

std::string header(const Explanation& explanation) {
  std::string line = "map,kind,right,confidence,translation_error_m,rotation_error_deg";
  for (const ExplainedEvidence& evidence : explanation.evidence) line += std::string(",") + evidence.name;
  return line + "\n";
}

}  // namespace

void EvidenceTable::add(ForestRelocaliser& relocaliser, const TrustSubject& subject, const std::vector<QuestionSet>& sets,
                        int num_settling_updates) {
  relocaliser.reset();
  for (const auto& frame : subject.training) {
    relocaliser.train(frame->view(), *frame->world_from_camera);
    relocaliser.update();
  }
  for (int i = 0; i < num_settling_updates; ++i) relocaliser.update();
  for (const QuestionSet& set : sets) {
    for (const auto& frame : set.frames) {
      if (apps::interrupted()) throw Interrupted{};
      const Explanation explanation = relocaliser.explain(frame->view());
      if (explanation.candidates.empty() || explanation.evidence.empty()) continue;
      if (csv_.empty()) csv_ = header(explanation);
      const ExplainedCandidate& best = explanation.candidates.front();
      const PoseError error = pose_error(best.world_from_camera, *frame->world_from_camera);
      const bool right = !set.is_elsewhere && kWrongThreshold.contains(error);
      csv_ += csv_cell(subject.name) + "," + csv_cell(set.kind) + "," + (right ? "1" : "0") + "," +
              csv_number(static_cast<double>(best.confidence)) + "," + csv_number(error.translation_m) + "," +
              csv_number(kDegPerRad * error.rotation_rad);
      for (const ExplainedEvidence& evidence : explanation.evidence) csv_ += "," + csv_number(static_cast<double>(evidence.value));
      csv_ += "\n";
    }
  }
}

}  // namespace foothold::benchmark
