// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Private to the module: the steps that protocols are made of.
#pragma once

#include <memory>

#include "foothold/evaluation/protocol.h"

namespace foothold {

/// Plays an input, handing out only frames that a protocol can use.
class FrameReader {
 public:
  explicit FrameReader(const EvaluationInput& input) : name_(input.name), source_(input.open()) {}

  /// Reads the next frame with a true pose. @return False at the end.  @throws FileError naming a frame that is malformed.
  bool read(RgbdFrame& frame);
  /// Frames passed over so far, for they have no true pose.
  int num_without_pose() const { return num_without_pose_; }
  /// Frames read so far that have no valid depth.
  int num_without_depth() const { return num_without_depth_; }

 private:
  std::string name_;
  std::unique_ptr<FrameSource> source_;
  int num_without_pose_ = 0;
  int num_without_depth_ = 0;
};

/// Learns, tests and notes down.
class ProtocolRun {
 public:
  ProtocolRun(Relocaliser& relocaliser, const ProtocolOptions& options) : relocaliser_(relocaliser), options_(options) {}

  /// Learns a frame with its true pose; one without depth teaches nothing. @pre the frame came from a FrameReader.
  void train(const RgbdFrame& frame);
  /// Tests a frame; one without depth is not found.
  void test(const RgbdFrame& frame, int input_index);
  void update();
  /// Tells that `num_done` of `num_total` frames are done.
  void report(int num_done, int num_total) const;
  /// Frames learnt so far.
  std::size_t num_trained() const { return log_.trained_world_from_camera.size(); }
  /// Notes down what a reader passed over.
  void count(const FrameReader& reader);
  /// Closes the log.
  RunLog finish();

 private:
  Relocaliser& relocaliser_;
  const ProtocolOptions& options_;
  RunLog log_;
  int num_found_ = 0;
};

}  // namespace foothold
