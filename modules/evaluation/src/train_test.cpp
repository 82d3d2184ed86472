// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/train_test.h"

#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "protocol_run.h"

namespace foothold {
namespace {

/// Counts the frames of a run and tells of them.
class FrameCounter {
 public:
  FrameCounter(const std::vector<EvaluationInput>& training, const std::vector<EvaluationInput>& tests) {
    for (const EvaluationInput& input : training) num_total_ += input.num_frames;
    for (const EvaluationInput& input : tests) num_total_ += input.num_frames;
  }
  void count(const ProtocolRun& run) { run.report(++num_done_, num_total_); }

 private:
  int num_done_ = 0;
  int num_total_ = 0;
};

/// Plays an input to its end, handing each frame to `use`.
template <class Use>
void for_each_frame(const EvaluationInput& input, ProtocolRun& run, Use&& use) {
  FrameReader reader(input);
  RgbdFrame frame;
  bool any = false;
  while (reader.read(frame)) {
    use(frame);
    any = true;
  }
  if (!any) throw FileError(input.name + ": has no frames with a true pose; expected at least one");
  run.count(reader);
}

}  // namespace

RunLog run_train_test(Relocaliser& relocaliser, const std::vector<EvaluationInput>& training, const std::vector<EvaluationInput>& tests,
                      int num_settling_updates, const ProtocolOptions& options) {
  FOOTHOLD_EXPECTS(num_settling_updates >= 0);
  ProtocolRun run(relocaliser, options);
  FrameCounter counter(training, tests);
  for (const EvaluationInput& input : training) {
    for_each_frame(input, run, [&](const RgbdFrame& frame) {
      run.train(frame);
      counter.count(run);
    });
  }
  for (int i = 0; i < num_settling_updates; ++i) run.update();
  for (std::size_t i = 0; i < tests.size(); ++i) {
    for_each_frame(tests[i], run, [&](const RgbdFrame& frame) {
      run.test(frame, static_cast<int>(i));
      counter.count(run);
    });
  }
  return run.finish();
}

}  // namespace foothold
