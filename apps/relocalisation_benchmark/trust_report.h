// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What trust in a method comes to, and the forms in which it is written.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "foothold/evaluation/belief_counts.h"
#include "json_parts.h"

namespace foothold::benchmark {

/// An answer that is wrong and was believed.
struct WrongBelief {
  std::string map;
  std::string kind;
  std::int64_t frame_index = 0;
  double confidence = 0.0;
  PoseError error;      ///< of little meaning for views of another place
  std::string picture;  ///< the file that shows it, if any
};

/// The answers of one map.
struct MapTrust {
  std::string name;
  BeliefCounts beliefs;
  ConfidenceReport confidence;
};

/// One method, on all maps.
struct MethodTrust {
  std::string method;
  double acceptance_threshold = 0.0;
  std::map<std::string, BeliefCounts> kinds;  ///< by kind of question
  BeliefCounts elsewhere;                     ///< of the kinds that show another place
  BeliefCounts all;
  ConfidenceReport confidence;  ///< over all questions
  std::vector<MapTrust> maps;
  std::vector<WrongBelief> wrong_beliefs;
};

/// Markdown tables for people: a row per kind, and a row per map.
std::string trust_tables(const std::vector<MethodTrust>& methods);
/// An object per method.
Json trust_json(const std::vector<MethodTrust>& methods);
/// A line per method, kind or map.
std::string trust_csv(const std::vector<MethodTrust>& methods);
/// Risk against coverage, a reliability diagram, and how questions of each kind ended, as a PNG file. @throws FileError
void write_trust_plot(const std::string& path, const std::vector<MethodTrust>& methods);

}  // namespace foothold::benchmark
