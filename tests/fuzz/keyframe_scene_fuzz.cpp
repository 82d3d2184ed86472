// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Keyframes of random ferns: what is accepted learns on and finds.
#include <sstream>

#include "checked_file.h"
#include "small_keyframes.h"

FOOTHOLD_FUZZ_TARGET(keyframe_scene) {
  using namespace foothold;
  fuzz::attempt([&] {
    KeyframeRelocaliser relocaliser(fuzz::one_thread(), fuzz::small_keyframe_settings());
    std::istringstream stream(fuzz::mended(fuzz::text_of(data, size)));
    relocaliser.load(stream);
    fuzz::use(relocaliser);
    std::stringstream saved;
    relocaliser.save(saved);
    const std::size_t num_keyframes = relocaliser.num_keyframes();
    relocaliser.load(saved);
    fuzz::require(relocaliser.num_keyframes() == num_keyframes);
  });
  return 0;
}
