// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <fstream>

#include "foothold/base/atomic_file.h"
#include "foothold/base/checked_stream.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {
namespace {

constexpr BinaryFormat kForestFormat{"forest", "FHFOREST", 2};
constexpr std::uint64_t kMaxNodes = 2 * std::uint64_t{kMaxForestLeaves};

Forest read_contents(CheckedReader& reader) {
  auto features = reader.read_array<ForestFeature>("features", 0, kMaxForestFeatures);
  auto nodes = reader.read_array<ForestNode>("nodes", 1, kMaxNodes);
  auto roots = reader.read_array<std::int32_t>("trees", 1, kMaxForestTrees);
  std::string provenance = reader.read_text("bytes of provenance", kMaxForestProvenanceBytes);
  reader.finish();
  try {
    return Forest(std::move(features), std::move(nodes), std::move(roots), std::move(provenance));
  } catch (const InvalidSettings& error) {
    reader.refuse(error.what());
  }
}

}  // namespace

void write_forest(std::ostream& stream, const Forest& forest) {
  CheckedWriter writer(stream, kForestFormat);
  writer.write_array(forest.features());
  writer.write_array(forest.nodes());
  writer.write_array(forest.roots());
  writer.write_text(forest.provenance());
  writer.finish();
}

Forest read_forest(std::istream& stream, const std::string& name) {
  CheckedReader reader(stream, kForestFormat, name);
  return read_contents(reader);
}

void save_forest(const std::string& path, const Forest& forest) {
  write_file_atomically(path, [&](std::ostream& stream) { write_forest(stream, forest); });
}

Forest load_forest(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path + ": cannot be opened; expected a forest file");
  CheckedReader reader(stream, kForestFormat, path);
  Forest forest = read_contents(reader);
  reader.expect_end_of_file();
  return forest;
}

}  // namespace foothold
