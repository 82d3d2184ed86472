// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings and relocalisers that protocols are tested with.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/api/relocaliser.h"
#include "foothold/base/context.h"
#include "foothold/evaluation/protocol.h"

namespace foothold::test {

/// The pose of frame `index`: 2 cm along x per frame.
SE3 pose_of_frame(std::int64_t index);

/// A tiny frame whose only content is its number.
RgbdFrame make_frame(std::int64_t index);

/// Plays given frames.
class FakeSource : public FrameSource {
 public:
  explicit FakeSource(std::vector<RgbdFrame> frames) : frames_(std::move(frames)) {}
  ReadStatus read(RgbdFrame& frame) override;

 private:
  std::vector<RgbdFrame> frames_;
  std::size_t next_ = 0;
};

/// An input that plays frames [begin, end).
EvaluationInput make_input(std::int64_t begin, std::int64_t end, const std::string& name = "fake");
EvaluationInput make_input(std::vector<RgbdFrame> frames, const std::string& name = "fake");

/// Notes the order in which a protocol calls it. Answers a frame that it has been taught with its pose, any other with a far one:
/// a protocol that leaks the tested frame gives itself away by full recall.
class LeakDetector : public Relocaliser {
 public:
  void train(const Frame& frame, const SE3& world_from_camera) override;
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override { calls.push_back("update"); }
  void reset() override { seen_.clear(); }
  std::size_t state_bytes() const override { return seen_.size() * 1000000; }
  float acceptance_threshold() const override { return 0.5F; }

  std::vector<std::string> calls;  ///< "train 3", "relocalise 4", "update"

 private:
  std::set<std::int64_t> seen_;
};

/// Knows the truth, and errs as told.
class Oracle : public Relocaliser {
 public:
  /// @param context  Its trace receives the stages "train/a" (twice a call) and "relocalise/b".
  explicit Oracle(const Context& context = Context()) : context_(context) {}
  void train(const Frame& frame, const SE3& world_from_camera) override;
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override {}
  void reset() override {}
  std::size_t state_bytes() const override { return 1500000; }
  float acceptance_threshold() const override { return 0.6F; }

  /// The answer to frame i, by i modulo their number: an offset of the position [m] and a confidence; negative confidence for no answer.
  struct Answer {
    float offset_m = 0.0F;
    float confidence = 1.0F;
  };
  std::vector<Answer> answers = {{}};

 private:
  Context context_;
};

}  // namespace foothold::test
