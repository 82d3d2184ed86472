// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What a forest relocaliser has learnt: what is accepted is saved again as the same, learns on and finds.
#include <sstream>

#include "checked_file.h"
#include "small_forest.h"

namespace {

std::string saved_scene(const foothold::ForestRelocaliser& relocaliser) {
  std::ostringstream stream;
  relocaliser.save(stream);
  return stream.str();
}

}  // namespace

FOOTHOLD_FUZZ_TARGET(forest_scene) {
  using namespace foothold;
  static const ForestRelocaliser untaught(fuzz::one_thread(), fuzz::small_forest(), fuzz::small_forest_settings());
  fuzz::attempt([&] {
    ForestRelocaliser relocaliser = untaught;
    std::istringstream stream(fuzz::mended(fuzz::text_of(data, size)));
    relocaliser.load(stream);
    const std::string saved = saved_scene(relocaliser);
    ForestRelocaliser again = untaught;
    std::istringstream saved_stream(saved);
    again.load(saved_stream);
    fuzz::require(saved_scene(again) == saved);
    fuzz::use(relocaliser);
  });
  return 0;
}
