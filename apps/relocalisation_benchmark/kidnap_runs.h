// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A whole reconstruction, out of whose undisturbed run the camera is kidnapped again and again.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/evaluation/kidnap.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "methods.h"

namespace foothold::benchmark {

/// One kidnap and how it ended.
struct KidnapRecord {
  Kidnap kidnap;
  bool was_seen = false;  ///< before it, some frame was within 50 cm and 50 deg of where the camera came to be
  KidnapOutcome outcome;
};

/// The kidnaps of one method.
struct KidnapRun {
  std::string method;
  std::vector<KidnapRecord> kidnaps;
  int num_frames = 0;          ///< of the undisturbed run
  int num_tracked_frames = 0;  ///< of these, with a pose
};

/// What every method's run shares.
struct KidnapInput {
  std::shared_ptr<const Sequence> sequence;
  std::vector<int> indices;  ///< frames used, in order
  std::vector<Kidnap> kidnaps;
  KidnapOptions options;
};

/// Reconstructs the recording with its own tracker from the first frame. Before each frame from which a kidnap starts, a copy of everything
/// is shown the kidnap's frames instead, and forgotten; judged against the undisturbed poses, so that drift against the true ones does not
/// count.
///
/// @param method    Its proposals are refined by the pipeline itself: "forest", "paper" or "ferns".
/// @param advance   Called after every frame; what it throws ends the run.
KidnapRun run_kidnaps(const Context& context, const Method& method, const MethodInputs& inputs, const KidnapInput& input,
                      const std::function<void()>& advance);

/// Frames that run_kidnaps() shows at most, for progress.
int count_frames(const KidnapInput& input);

/// Whether run_kidnaps() knows a method.
bool can_be_kidnapped(const Method& method);

}  // namespace foothold::benchmark
