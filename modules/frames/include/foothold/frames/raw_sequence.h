// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Recordings in one file without compression, for machines without an image library: benchmarks on a GPU server.
#pragma once

#include <cstdint>
#include <memory>
#include <ostream>
#include <string>

#include "foothold/api/frame_source.h"

namespace foothold {

/// Writes frames of one size and calibration one behind another: 16-bit depth in steps of 0.2 mm up to 13.1 m (0 beyond, and where there is
/// no measurement), 8-bit colour, pose and time. The file is complete once finish() has written the number of frames.
class RawSequenceWriter {
 public:
  /// @param stream  Opened in binary mode; the recording is all that it holds.
  explicit RawSequenceWriter(std::ostream& stream) : stream_(stream) {}

  /// @pre describe_frame_error(frame.view()) is empty; size and calibration are those of the first frame. @throws FileError
  void write(const RgbdFrame& frame);
  /// @pre At least one frame was written. @throws FileError
  void finish();
  /// Frames written so far.
  int num_frames() const { return num_frames_; }

 private:
  std::ostream& stream_;
  std::uint64_t head_checksum_ = 0;
  int num_frames_ = 0;
  int width_ = 0;
  int height_ = 0;
  RgbdCalibration calibration_;
};

/// Opens what RawSequenceWriter wrote. Frames are read from the file when they are loaded.
/// @throws FileError naming the file if it is missing, unfinished, damaged or something else.
std::unique_ptr<Sequence> open_raw_sequence(const std::string& path);

/// True if a file begins as a recording in this form does.
bool is_raw_sequence(const std::string& path);

}  // namespace foothold
