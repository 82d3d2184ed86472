// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What users type: frame ranges and synthetic rooms.
#include "foothold/io/sequence.h"
#include "foothold/synthetic/synthetic_sequence.h"
#include "fuzz.h"

FOOTHOLD_FUZZ_TARGET(spec) {
  using namespace foothold;
  const std::string text = fuzz::text_of(data, size);
  fuzz::attempt([&] {
    const FrameRange range = parse_frame_range(text);
    fuzz::require(range.begin >= 0 && range.begin < range.end);
  });
  fuzz::attempt([&] {
    const SyntheticSequenceSettings settings = parse_synthetic_spec(text);
    fuzz::require(synthetic_spec(parse_synthetic_spec(synthetic_spec(settings))) == synthetic_spec(settings));
  });
  return 0;
}
