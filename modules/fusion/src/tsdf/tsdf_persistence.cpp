// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <string>

#include "foothold/base/checked_stream.h"
#include "foothold/fusion/tsdf_volume.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

namespace {
constexpr BinaryFormat kMapFormat{"map", "FHTSDF\r\n", 3};

/// What the map was made with, and how much of it there is.
struct Header {
  std::uint32_t num_blocks;
  float voxel_size_m;
  float truncation_m;
  std::int32_t max_weight;
  float min_depth_m;
  float max_depth_m;
  std::int32_t max_blocks;
};
static_assert(sizeof(Header) == 28, "the header is written as bytes");

TsdfSettings settings_of(const CheckedReader& reader, const Header& header) {
  TsdfSettings settings;
  settings.voxel_size_m = header.voxel_size_m;
  settings.truncation_m = header.truncation_m;
  settings.max_weight = header.max_weight;
  settings.min_depth_m = header.min_depth_m;
  settings.max_depth_m = header.max_depth_m;
  settings.max_blocks = header.max_blocks;
  try {
    settings.validate();
  } catch (const InvalidSettings& error) {
    reader.refuse(error.what());
  }
  return settings;
}

/// Distances beyond +-1 would break nothing but accuracy; coordinates beyond the key's range cannot occur, as 63 bits hold them all.
void check_keys(const CheckedReader& reader, std::vector<std::uint64_t> keys) {
  std::sort(keys.begin(), keys.end());
  if (!keys.empty() && (keys.back() >> (3 * kKeyBits)) != 0)
    reader.refuse("has a block of key " + std::to_string(keys.back()) + ", expected 63 bits");
  const auto twin = std::adjacent_find(keys.begin(), keys.end());
  if (twin != keys.end()) reader.refuse("has two blocks of key " + std::to_string(*twin));
}
}  // namespace

void TsdfVolume::save(std::ostream& stream) const {
  Header header{};
  header.num_blocks = static_cast<std::uint32_t>(num_blocks_);
  header.voxel_size_m = settings_.voxel_size_m;
  header.truncation_m = settings_.truncation_m;
  header.max_weight = settings_.max_weight;
  header.min_depth_m = settings_.min_depth_m;
  header.max_depth_m = settings_.max_depth_m;
  header.max_blocks = settings_.max_blocks;
  CheckedWriter writer(stream, kMapFormat);
  writer.write(header);
  const auto count = static_cast<std::size_t>(num_blocks_);
  const std::vector<std::uint64_t> keys = block_keys_.to_host();
  const std::vector<std::uint8_t> flags = surface_octants_.to_host();
  writer.write_bytes(keys.data(), count * sizeof(std::uint64_t));
  writer.write_bytes(flags.data(), count);
  for (std::size_t first = 0, page = 0; first < count; first += kPageBlocks, ++page) {
    const std::size_t num_blocks = std::min<std::size_t>(kPageBlocks, count - first);
    const std::vector<unsigned char> bytes = pages_[page].to_host();
    writer.write_bytes(bytes.data(), num_blocks * sizeof(VoxelBlock));
  }
  writer.finish();
}

void TsdfVolume::load(std::istream& stream) {
  CheckedReader reader(stream, kMapFormat);
  const auto header = reader.read<Header>("settings");
  const TsdfSettings settings = settings_of(reader, header);
  reader.check_range("blocks", header.num_blocks, 0, static_cast<std::uint64_t>(settings.max_blocks));
  TsdfVolume loaded(context_, settings);
  loaded.read_blocks(reader, static_cast<int>(header.num_blocks));
  reader.finish();
  swap(loaded);
}

void TsdfVolume::read_blocks(CheckedReader& reader, int num_blocks) {
  const auto count = static_cast<std::size_t>(num_blocks);
  const auto keys = reader.read_items<std::uint64_t>("block keys", count);
  const auto flags = reader.read_items<std::uint8_t>("block flags", count);
  check_keys(reader, keys);
  std::vector<unsigned char> bytes;
  pages_.clear();
  for (std::size_t first = 0; first < count; first += kPageBlocks) {
    bytes.resize(std::min<std::size_t>(kPageBlocks, count - first) * sizeof(VoxelBlock));
    reader.read_bytes(bytes.data(), bytes.size(), "blocks");
    bytes.resize(kPageBlocks * sizeof(VoxelBlock));
    pages_.emplace_back(context_.memory(), Span<const unsigned char>(bytes.data(), bytes.size()));
  }
  fill_page_table();
  num_blocks_ = 0;
  reserve_blocks(std::max(1, num_blocks));
  block_keys_.assign(Span<const std::uint64_t>(keys.data(), count));
  surface_octants_.assign(Span<const std::uint8_t>(flags.data(), count));
  num_blocks_ = num_blocks;
  rebuild_table();
}

}  // namespace foothold
