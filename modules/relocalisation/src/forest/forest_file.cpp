// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <istream>
#include <ostream>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"
#include "foothold/relocalisation/forest.h"

namespace foothold {
namespace {

constexpr char kMagic[8] = {'F', 'H', 'F', 'O', 'R', 'E', 'S', 'T'};
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kMaxElements = 1U << 28U;  // a damaged count must not exhaust memory

/// The fixed part of the file. All numbers are little-endian, as on every platform that Foothold builds for.
struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t num_features;
  std::uint32_t num_nodes;
  std::uint32_t num_trees;
  std::uint32_t provenance_bytes;
  std::uint32_t reserved;
  std::uint64_t checksum;  // FNV-1a of everything after the header
};
static_assert(sizeof(Header) == 40, "the file format");

template <class T>
std::size_t bytes_of(const std::vector<T>& items) {
  return items.size() * sizeof(T);
}

std::uint64_t checksum_of(const std::vector<ForestFeature>& features, const std::vector<ForestNode>& nodes,
                          const std::vector<std::int32_t>& roots, const std::string& provenance) {
  std::uint64_t hash = fnv1a(kFnvBasis, features.data(), bytes_of(features));
  hash = fnv1a(hash, nodes.data(), bytes_of(nodes));
  hash = fnv1a(hash, roots.data(), bytes_of(roots));
  return fnv1a(hash, provenance.data(), provenance.size());
}

/// Reads `count` items in bounded steps, so that a lying header fails at the end of the stream and not in the allocator.
template <class T>
void read_items(std::istream& stream, const std::string& name, std::uint32_t count, std::vector<T>& items) {
  constexpr std::uint32_t kStep = 1U << 16U;
  while (items.size() < count) {
    const std::size_t old_size = items.size();
    const std::size_t step = std::min<std::size_t>(kStep, count - old_size);
    items.resize(old_size + step);
    stream.read(reinterpret_cast<char*>(items.data() + old_size), static_cast<std::streamsize>(step * sizeof(T)));
    if (!stream)
      throw FileError(name + ": the forest is truncated; expected " + std::to_string(count) + " items of " + std::to_string(sizeof(T)) +
                      " bytes");
  }
}

}  // namespace

void write_forest(std::ostream& stream, const Forest& forest) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.num_features = static_cast<std::uint32_t>(forest.features().size());
  header.num_nodes = static_cast<std::uint32_t>(forest.nodes().size());
  header.num_trees = static_cast<std::uint32_t>(forest.roots().size());
  header.provenance_bytes = static_cast<std::uint32_t>(forest.provenance().size());
  header.checksum = checksum_of(forest.features(), forest.nodes(), forest.roots(), forest.provenance());
  stream.write(reinterpret_cast<const char*>(&header), sizeof(header));
  stream.write(reinterpret_cast<const char*>(forest.features().data()), static_cast<std::streamsize>(bytes_of(forest.features())));
  stream.write(reinterpret_cast<const char*>(forest.nodes().data()), static_cast<std::streamsize>(bytes_of(forest.nodes())));
  stream.write(reinterpret_cast<const char*>(forest.roots().data()), static_cast<std::streamsize>(bytes_of(forest.roots())));
  stream.write(forest.provenance().data(), static_cast<std::streamsize>(forest.provenance().size()));
  if (!stream) throw FileError("the forest could not be written: the stream failed");
}

Forest read_forest(std::istream& stream, const std::string& name) {
  Header header{};
  stream.read(reinterpret_cast<char*>(&header), sizeof(header));
  if (!stream) throw FileError(name + ": too short for a forest; expected a header of " + std::to_string(sizeof(header)) + " bytes");
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
    throw FileError(name + ": not a Foothold forest; expected the magic FHFOREST");
  if (header.version != kVersion) {
    throw FileError(name + ": forest format version is " + std::to_string(header.version) + ", expected " + std::to_string(kVersion));
  }
  for (const std::uint32_t count : {header.num_features, header.num_nodes, header.num_trees, header.provenance_bytes}) {
    if (count > kMaxElements)
      throw FileError(name + ": a count in the header is " + std::to_string(count) + ", expected at most " + std::to_string(kMaxElements));
  }
  if (header.reserved != 0) throw FileError(name + ": the header's reserved field is " + std::to_string(header.reserved) + ", expected 0");
  std::vector<ForestFeature> features;
  std::vector<ForestNode> nodes;
  std::vector<std::int32_t> roots;
  std::vector<char> text;
  read_items(stream, name, header.num_features, features);
  read_items(stream, name, header.num_nodes, nodes);
  read_items(stream, name, header.num_trees, roots);
  read_items(stream, name, header.provenance_bytes, text);
  std::string provenance(text.begin(), text.end());
  const std::uint64_t checksum = checksum_of(features, nodes, roots, provenance);
  if (checksum != header.checksum) {
    throw FileError(name + ": the forest is damaged; its checksum is " + std::to_string(checksum) + ", expected " +
                    std::to_string(header.checksum));
  }
  try {
    return Forest(std::move(features), std::move(nodes), std::move(roots), std::move(provenance));
  } catch (const InvalidSettings& error) {
    throw FileError(name + ": " + error.what());
  }
}

void save_forest(const std::string& path, const Forest& forest) {
  const std::string temporary = path + ".tmp";
  {
    std::ofstream stream(temporary, std::ios::binary);
    if (!stream) throw FileError(path + ": cannot be written; is the folder there and writable?");
    try {
      write_forest(stream, forest);
      stream.close();
      if (!stream) throw FileError("closing failed");
    } catch (const FileError&) {
      std::remove(temporary.c_str());
      throw FileError(path + ": writing failed; is the disk full?");
    }
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0) {
    std::remove(temporary.c_str());
    throw FileError(path + ": cannot be replaced by the file just written");
  }
}

Forest load_forest(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path + ": cannot be opened; expected a forest file");
  return read_forest(stream, path);
}

}  // namespace foothold
