// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/tracking_loss.h"

#include <deque>

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "protocol_run.h"

namespace foothold {

namespace {

/// @throws FileError if there are too few frames to learn one and test another.
void check_num_frames(const std::string& name, int num_frames, int gap) {
  if (num_frames >= gap + 2) return;
  throw FileError(name + ": got " + std::to_string(num_frames) + (num_frames == 1 ? " frame" : " frames") +
                  " with a pose, expected at least " + std::to_string(gap + 2) + " to learn one and test another with a gap of " +
                  std::to_string(gap));
}

}  // namespace

RunLog run_tracking_loss(Relocaliser& relocaliser, const EvaluationInput& input, int gap, const ProtocolOptions& options) {
  FOOTHOLD_EXPECTS(gap >= 0);
  if (input.num_frames > 0) check_num_frames(input.name, input.num_frames, gap);
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
      if (run.num_trained() > 0) run.test(waiting.back(), 0);
      run.train(waiting.front());
      waiting.pop_front();
    }
    run.report(num_read, input.num_frames);
  }
  check_num_frames(input.name, num_read, gap);
  run.count(reader);
  return run.finish();
}

}  // namespace foothold
