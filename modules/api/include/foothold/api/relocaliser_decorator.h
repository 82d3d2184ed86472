// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A relocaliser that wraps another.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/contract.h"

namespace foothold {

/// Hands every call on to another relocaliser: derive from it, and override what differs.
class RelocaliserDecorator : public Relocaliser {
 public:
  /// @pre `inner` outlives this object.
  explicit RelocaliserDecorator(Relocaliser& inner) : inner_(&inner) {}
  /// Owns the wrapped relocaliser. @throws ContractViolation for a null pointer.
  explicit RelocaliserDecorator(std::unique_ptr<Relocaliser> inner) : owned_(std::move(inner)), inner_(owned_.get()) {
    FOOTHOLD_EXPECTS(inner_ != nullptr);
  }

  void train(const Frame& frame, const SE3& world_from_camera) override { inner_->train(frame, world_from_camera); }
  std::vector<PoseEstimate> relocalise(const Frame& frame) override { return inner_->relocalise(frame); }
  void update() override { inner_->update(); }
  void reset() override { inner_->reset(); }
  std::size_t state_bytes() const override { return inner_->state_bytes(); }
  float acceptance_threshold() const override { return inner_->acceptance_threshold(); }

 protected:
  /// The relocaliser that is decorated.
  Relocaliser& inner() { return *inner_; }
  /// The relocaliser that is decorated.
  const Relocaliser& inner() const { return *inner_; }

 private:
  std::unique_ptr<Relocaliser> owned_;
  Relocaliser* inner_;
};

}  // namespace foothold
