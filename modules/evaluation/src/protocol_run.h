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

  /// @return False at the end.  @throws FileError naming a frame that has no true pose, no valid depth or is malformed.
  bool read(RgbdFrame& frame);

 private:
  std::string name_;
  std::unique_ptr<FrameSource> source_;
};

/// Learns, tests and notes down.
class ProtocolRun {
 public:
  ProtocolRun(Relocaliser& relocaliser, const ProtocolOptions& options) : relocaliser_(relocaliser), options_(options) {}

  /// Learns a frame with its true pose. @pre the frame came from a FrameReader.
  void train(const RgbdFrame& frame);
  void test(const RgbdFrame& frame, int input_index);
  void update();
  /// Tells that `num_done` of `num_total` frames are done.
  void report(int num_done, int num_total) const;
  /// Closes the log.
  RunLog finish();

 private:
  Relocaliser& relocaliser_;
  const ProtocolOptions& options_;
  RunLog log_;
  int num_found_ = 0;
};

}  // namespace foothold
