// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/tracking_loss.h"

#include <deque>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "protocol_run.h"

namespace foothold {

RunLog run_tracking_loss(Relocaliser& relocaliser, const EvaluationInput& input, int gap, const ProtocolOptions& options) {
  FOOTHOLD_EXPECTS(gap >= 0);
  FrameReader reader(input);
  ProtocolRun run(relocaliser, options);
  std::deque<RgbdFrame> waiting;  // read but not yet learnt: frames i .. i + gap
  int num_read = 0;
  RgbdFrame frame;
  while (reader.read(frame)) {
    waiting.push_back(std::move(frame));
    ++num_read;
    if (num_read > gap) {
      // The oldest waiting frame is i = num_read - 1 - gap and the newest i + gap: all before i is learnt, nothing else.
      const bool anything_learnt = num_read - 1 - gap > 0;
      if (anything_learnt) run.test(waiting.back(), 0);
      run.train(waiting.front());
      waiting.pop_front();
    }
    run.report(num_read, input.num_frames);
  }
  if (num_read < gap + 2) {
    throw FileError(input.name + ": has " + std::to_string(num_read) + " frames; expected at least " + std::to_string(gap + 2) +
                    " to learn one and test another with a gap of " + std::to_string(gap));
  }
  return run.finish();
}

}  // namespace foothold
