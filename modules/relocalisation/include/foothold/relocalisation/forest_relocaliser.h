// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The relocaliser of the paper: a forest whose leaves are refilled online. Reference: [Cavallari2017].
#pragma once

#include <memory>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/context.h"
#include "foothold/base/persistent.h"
#include "foothold/relocalisation/explanation.h"
#include "foothold/relocalisation/forest.h"
#include "foothold/relocalisation/settings.h"

namespace foothold {

/// Adapts a forest to a scene frame by frame (Sec. 2.2.2) and estimates lost cameras from its leaves (Sec. 2.2.3).
///
/// Beyond the paper, a camera that is not surely found is looked for again as one that is rolled about its optical axis, with the offsets
/// of features turned as far (num_rolls, sure_confidence): the rolls with which most hypotheses can be drawn first, those with which none
/// can not at all. So what is found upright is found at any roll, and a frame from nowhere costs up to num_rolls times as much.
///
/// Colour is looked up at the pixel of the depth. Where a camera's colour is not registered to its depth, register_colour() warps it there;
/// it is still found without, with poorer confidence (docs/experiments/registered-colour.md).
///
/// Determinism: the scene is a function of forest, settings and training frames; an answer is a function of the scene and the frame.
/// Neither depends on threads or device, but for rounding in the pose.
class ForestRelocaliser final : public Relocaliser, public Persistent {
 public:
  /// @throws InvalidSettings; DeviceError if the context's device fails.
  explicit ForestRelocaliser(const Context& context, Forest forest = default_forest(), const ForestRelocaliserSettings& settings = {});
  ~ForestRelocaliser() override;
  /// What was moved from may only be assigned to or destroyed; all else is a ContractViolation.
  ForestRelocaliser(ForestRelocaliser&&) noexcept;
  /// What was moved from may only be assigned to or destroyed.
  ForestRelocaliser& operator=(ForestRelocaliser&&) noexcept;
  /// Copies the scene too, for experiments that branch off.
  ForestRelocaliser(const ForestRelocaliser&);
  /// Copies the scene too.
  ForestRelocaliser& operator=(const ForestRelocaliser&);

  void train(const Frame& frame, const SE3& world_from_camera) override;
  /// As Relocaliser says; the answer is that of the first roll which is sure, else of the surest one.
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override;
  void reset() override;
  std::size_t state_bytes() const override;
  float acceptance_threshold() const override;

  /// Relocalises a frame as relocalise() does, and tells what there was to choose from; empty if there was nothing. For looking into
  /// failures: copies tens of thousands of modes. @pre As for relocalise().
  Explanation explain(const Frame& frame);

  void save(std::ostream& stream) const override;
  void load(std::istream& stream) override;

  /// The forest that it was made with.
  const Forest& forest() const;
  /// As given to the constructor.
  const ForestRelocaliserSettings& settings() const;

 private:
  struct State;
  State& state() const;  ///< @throws ContractViolation if it was moved from
  std::unique_ptr<State> state_;
};

}  // namespace foothold
