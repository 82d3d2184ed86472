// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a map is asked to find out how far its answers can be trusted.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trust_subjects.h"

namespace foothold::benchmark {

/// Views of one kind for one map.
struct QuestionSet {
  std::string kind;
  bool is_elsewhere = false;  ///< the views show another place than the map: every answer is wrong
  FrameList frames;
};

/// The kinds of question, in the order of tables.
const std::vector<std::string>& question_kinds();

/// Everything that the map of one subject is asked. Sets without views are left out.
std::vector<QuestionSet> questions_for(const std::vector<TrustSubject>& subjects, std::size_t map, const TrustAmounts& amounts,
                                       std::uint64_t seed);

}  // namespace foothold::benchmark
