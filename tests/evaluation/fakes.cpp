// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "fakes.h"

namespace foothold::test {

SE3 pose_of_frame(std::int64_t index) {
  SE3 pose;
  pose.translation.x() = 0.02F * static_cast<float>(index);
  return pose;
}

RgbdFrame make_frame(std::int64_t index) {
  RgbdFrame frame;
  frame.depth = Image<float>(4, 3, 1.0F);
  frame.colour = Image<Rgb8>(4, 3);
  frame.calibration.depth = {4.0F, 4.0F, 1.5F, 1.0F};
  frame.calibration.colour = frame.calibration.depth;
  frame.index = index;
  frame.world_from_camera = pose_of_frame(index);
  return frame;
}

ReadStatus FakeSource::read(RgbdFrame& frame) {
  if (next_ == frames_.size()) return ReadStatus::kEnd;
  frame = frames_[next_++];
  return ReadStatus::kFrame;
}

EvaluationInput make_input(std::vector<RgbdFrame> frames, const std::string& name) {
  const int num_frames = static_cast<int>(frames.size());
  return {name, num_frames, [frames] { return std::make_unique<FakeSource>(frames); }};
}

EvaluationInput make_input(std::int64_t begin, std::int64_t end, const std::string& name) {
  std::vector<RgbdFrame> frames;
  for (std::int64_t index = begin; index < end; ++index) frames.push_back(make_frame(index));
  return make_input(std::move(frames), name);
}

void LeakDetector::train(const Frame& frame, const SE3&) {
  calls.push_back("train " + std::to_string(frame.index));
  seen_.insert(frame.index);
}

std::vector<PoseEstimate> LeakDetector::relocalise(const Frame& frame) {
  calls.push_back("relocalise " + std::to_string(frame.index));
  PoseEstimate estimate{pose_of_frame(frame.index), 1.0F};
  if (seen_.count(frame.index) == 0) estimate.world_from_camera.translation.y() += 1.0F;
  return {estimate};
}

void Oracle::train(const Frame&, const SE3&) {
  if (context_.trace() == nullptr) return;
  context_.trace()->add("train/a", 1.0);
  context_.trace()->add("train/a", 2.0);
}

std::vector<PoseEstimate> Oracle::relocalise(const Frame& frame) {
  if (context_.trace() != nullptr) context_.trace()->add("relocalise/b", static_cast<double>(frame.index));
  const Answer& answer = answers[static_cast<std::size_t>(frame.index) % answers.size()];
  if (answer.confidence < 0.0F) return {};
  PoseEstimate estimate{pose_of_frame(frame.index), answer.confidence};
  estimate.world_from_camera.translation.y() += answer.offset_m;
  return {estimate, PoseEstimate{}};
}

}  // namespace foothold::test
