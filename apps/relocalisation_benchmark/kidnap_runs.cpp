// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "kidnap_runs.h"

#include <utility>

#include "common/played_frame.h"
#include "foothold/base/contract.h"
#include "foothold/evaluation/novelty.h"
#include "foothold/reconstruction/reconstruction.h"

namespace foothold::benchmark {
namespace {

Reconstruction make_reconstruction(const Context& context, const Method& method, const MethodInputs& inputs) {
  const FusionSettings fusion;
  if (method.name == "ferns") return {context, fusion, KeyframeRelocaliser(context, inputs.settings.ferns)};
  const ForestRelocaliserSettings& settings = method.name == "paper" ? inputs.settings.paper : inputs.settings.forest;
  return {context, fusion, ForestRelocaliser(context, *inputs.forest, settings)};
}

/// A kidnap that was played, to be judged once the undisturbed run has come as far.
struct Branch {
  std::size_t kidnap = 0;
  std::vector<int> frames;
  std::vector<PlayedFrame> played;
};

class KidnapPlayer {
 public:
  KidnapPlayer(const KidnapInput& input, const std::function<void()>& advance) : input_(input), advance_(advance) {}

  RgbdFrame load(int frame) const {
    advance_();
    return input_.sequence->load(input_.indices[static_cast<std::size_t>(frame)]);
  }

  /// Shows a kidnap to a copy.
  Branch branch_off(const Reconstruction& reconstruction, std::size_t kidnap, Span<const SE3> seen, bool& was_seen) const {
    Reconstruction copy(reconstruction);
    Branch branch;
    branch.kidnap = kidnap;
    for (const PlayStep& step : independent_steps(input_.kidnaps[kidnap], static_cast<int>(input_.indices.size()), input_.options)) {
      const RgbdFrame frame = load(step.frame);
      if (branch.frames.empty() && frame.world_from_camera.has_value())
        was_seen = novelty_bin_of(*frame.world_from_camera, seen) < novelty_limits().size();
      branch.frames.push_back(step.frame);
      branch.played.push_back(apps::played(copy.process(frame.view())));
    }
    return branch;
  }

 private:
  const KidnapInput& input_;
  const std::function<void()>& advance_;
};

}  // namespace

bool can_be_kidnapped(const Method& method) { return method.name == "forest" || method.name == "paper" || method.name == "ferns"; }

int count_frames(const KidnapInput& input) {
  std::size_t count = input.indices.size();
  for (const Kidnap& kidnap : input.kidnaps)
    count += independent_steps(kidnap, static_cast<int>(input.indices.size()), input.options).size();
  return static_cast<int>(count);
}

KidnapRun run_kidnaps(const Context& context, const Method& method, const MethodInputs& inputs, const KidnapInput& input,
                      const std::function<void()>& advance) {
  FOOTHOLD_EXPECTS(can_be_kidnapped(method) && input.options.num_blackouts == 0);
  const KidnapPlayer player(input, advance);
  Reconstruction reconstruction = make_reconstruction(context, method, inputs);
  KidnapRun run;
  run.method = method.name;
  for (const Kidnap& kidnap : input.kidnaps) run.kidnaps.push_back({kidnap, false, {}});
  std::vector<Branch> branches;
  std::vector<std::optional<SE3>> poses;  // undisturbed
  std::vector<SE3> seen;
  for (int frame_number = 0; frame_number < static_cast<int>(input.indices.size()); ++frame_number) {
    for (std::size_t i = 0; i < input.kidnaps.size(); ++i) {
      if (input.kidnaps[i].from == frame_number) branches.push_back(player.branch_off(reconstruction, i, seen, run.kidnaps[i].was_seen));
    }
    const RgbdFrame frame = player.load(frame_number);
    if (frame_number == 0 && frame.world_from_camera.has_value()) reconstruction.start_at(*frame.world_from_camera);
    poses.push_back(reconstruction.process(frame.view()).world_from_camera);
    if (frame.world_from_camera.has_value()) seen.push_back(*frame.world_from_camera);
    run.num_tracked_frames += poses.back().has_value() ? 1 : 0;
  }
  run.num_frames = static_cast<int>(input.indices.size());
  for (const Branch& branch : branches) {
    std::vector<std::optional<SE3>> reference;
    for (const int frame : branch.frames) reference.push_back(poses[static_cast<std::size_t>(frame)]);
    run.kidnaps[branch.kidnap].outcome = judge_kidnap(branch.played, reference);
  }
  return run;
}

}  // namespace foothold::benchmark
