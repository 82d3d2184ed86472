// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <sstream>

#include "foothold/base/embedded_file.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {

extern const EmbeddedFile kDefaultForestFile;  // data/default.forest

Forest default_forest() {
  std::istringstream stream(kDefaultForestFile.bytes());
  return read_forest(stream, "the default forest");
}

}  // namespace foothold
