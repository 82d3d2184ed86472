// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Forests: what is accepted reads the same once written again, and learns and finds.
#include <sstream>

#include "checked_file.h"
#include "small_forest.h"

FOOTHOLD_FUZZ_TARGET(forest) {
  using namespace foothold;
  fuzz::attempt([&] {
    std::istringstream stream(fuzz::mended(fuzz::text_of(data, size)));
    const Forest forest = read_forest(stream, "a.forest");
    std::stringstream written;
    write_forest(written, forest);
    fuzz::require(read_forest(written, "a.forest").fingerprint() == forest.fingerprint());
    ForestRelocaliser relocaliser(fuzz::one_thread(), forest, fuzz::small_forest_settings());
    const RgbdFrame frame = fuzz::small_frame(0);
    relocaliser.train(frame.view(), *frame.world_from_camera);
    fuzz::use(relocaliser);
  });
  return 0;
}
