// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Raw recordings: the frames of what is accepted are frames, and are written again.
#include <algorithm>
#include <sstream>

#include "checked_file.h"
#include "foothold/frames/raw_sequence.h"
#include "fuzz.h"
#include "memory_file.h"

FOOTHOLD_FUZZ_TARGET(raw) {
  using namespace foothold;
  const fuzz::MemoryFile file(fuzz::mended(fuzz::text_of(data, size), fuzz::Chain::kOfFirst));
  if (!is_raw_sequence(file.path())) return 0;
  fuzz::attempt([&] {
    constexpr int kMostFrames = 4;
    const auto sequence = open_raw_sequence(file.path());
    std::ostringstream written;
    RawSequenceWriter writer(written);
    for (int i = 0; i < std::min(kMostFrames, sequence->num_frames()); ++i) {
      const RgbdFrame frame = sequence->load(i);
      fuzz::require(describe_frame_error(frame.view()).empty());
      if (frame.world_from_camera.has_value()) fuzz::require(is_rigid(*frame.world_from_camera));
      writer.write(frame);
    }
    writer.finish();
  });
  return 0;
}
