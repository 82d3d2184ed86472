// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <cstring>
#include <istream>
#include <ostream>
#include <string>

#include "foothold/base/checksum.h"
#include "foothold/base/error.h"
#include "foothold/fusion/tsdf_volume.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

namespace {
constexpr char kMagic[8] = {'F', 'H', 'T', 'S', 'D', 'F', '\r', '\n'};
constexpr std::uint32_t kVersion = 1;

/// The fixed part of a saved map. Little-endian, like every machine that Foothold runs on.
struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t num_blocks;
  float voxel_size_m;
  float truncation_m;
  std::int32_t max_weight;
  float min_depth_m;
  float max_depth_m;
  std::int32_t allocation_stride_px;
  std::int32_t max_blocks;
  std::uint32_t reserved;
};
static_assert(sizeof(Header) == 48, "the header is written as bytes");

/// Writes bytes and sums them up.
class Writer {
 public:
  explicit Writer(std::ostream& stream) : stream_(stream) {}
  void write(const void* data, std::size_t num_bytes) {
    checksum_ = fnv1a(checksum_, data, num_bytes);
    stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(num_bytes));
  }
  void finish() {
    const std::uint64_t sum = checksum_;
    stream_.write(reinterpret_cast<const char*>(&sum), sizeof(sum));
    stream_.flush();
    if (!stream_) throw FileError("map: writing failed; expected room for the whole map on the disk");
  }

 private:
  std::ostream& stream_;
  std::uint64_t checksum_ = kFnvBasis;
};

class Reader {
 public:
  explicit Reader(std::istream& stream) : stream_(stream) {}
  void read(void* data, std::size_t num_bytes) {
    stream_.read(static_cast<char*>(data), static_cast<std::streamsize>(num_bytes));
    if (static_cast<std::size_t>(stream_.gcount()) != num_bytes) {
      throw FileError("map: ends early: got " + std::to_string(stream_.gcount()) + " bytes of a part of " + std::to_string(num_bytes));
    }
    checksum_ = fnv1a(checksum_, data, num_bytes);
  }
  void finish() {
    const std::uint64_t expected = checksum_;
    std::uint64_t found = 0;
    read(&found, sizeof(found));
    if (found != expected) throw FileError("map: damaged: checksum " + std::to_string(found) + ", expected " + std::to_string(expected));
  }

 private:
  std::istream& stream_;
  std::uint64_t checksum_ = kFnvBasis;
};

TsdfSettings settings_of(const Header& header) {
  TsdfSettings settings;
  settings.voxel_size_m = header.voxel_size_m;
  settings.truncation_m = header.truncation_m;
  settings.max_weight = header.max_weight;
  settings.min_depth_m = header.min_depth_m;
  settings.max_depth_m = header.max_depth_m;
  settings.allocation_stride_px = header.allocation_stride_px;
  settings.max_blocks = header.max_blocks;
  try {
    settings.validate();
  } catch (const InvalidSettings& error) {
    throw FileError(std::string("map: damaged: ") + error.what());
  }
  return settings;
}

/// Distances beyond +-1 would break nothing but accuracy; coordinates beyond the key's range cannot occur, as 63 bits hold them all.
void check_keys(const std::vector<std::uint64_t>& keys) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if ((keys[i] >> (3 * kKeyBits)) != 0) {
      throw FileError("map: damaged: block " + std::to_string(i) + " has key " + std::to_string(keys[i]) + ", expected 63 bits");
    }
  }
}
}  // namespace

void TsdfVolume::save(std::ostream& stream) const {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kVersion;
  header.num_blocks = static_cast<std::uint32_t>(num_blocks_);
  header.voxel_size_m = settings_.voxel_size_m;
  header.truncation_m = settings_.truncation_m;
  header.max_weight = settings_.max_weight;
  header.min_depth_m = settings_.min_depth_m;
  header.max_depth_m = settings_.max_depth_m;
  header.allocation_stride_px = settings_.allocation_stride_px;
  header.max_blocks = settings_.max_blocks;
  Writer writer(stream);
  writer.write(&header, sizeof(header));
  const auto count = static_cast<std::size_t>(num_blocks_);
  const std::vector<std::uint64_t> keys = block_keys_.to_host();
  const std::vector<std::uint8_t> flags = surface_octants_.to_host();
  writer.write(keys.data(), count * sizeof(std::uint64_t));
  writer.write(flags.data(), count);
  for (std::size_t first = 0, page = 0; first < count; first += kPageBlocks, ++page) {
    const std::size_t num_blocks = std::min<std::size_t>(kPageBlocks, count - first);
    const std::vector<unsigned char> bytes = pages_[page].to_host();
    writer.write(bytes.data(), num_blocks * sizeof(VoxelBlock));
  }
  writer.finish();
}

void TsdfVolume::load(std::istream& stream) {
  Reader reader(stream);
  Header header{};
  reader.read(&header, sizeof(header));
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) throw FileError("map: not a map of Foothold: unknown first bytes");
  if (header.version != kVersion) {
    throw FileError("map: got version " + std::to_string(header.version) + ", expected " + std::to_string(kVersion));
  }
  const TsdfSettings settings = settings_of(header);
  if (header.num_blocks > static_cast<std::uint32_t>(settings.max_blocks)) {
    throw FileError("map: damaged: got " + std::to_string(header.num_blocks) + " blocks, expected at most " +
                    std::to_string(settings.max_blocks));
  }
  TsdfVolume loaded(context_, settings);
  loaded.read_blocks([&](void* data, std::size_t num_bytes) { reader.read(data, num_bytes); }, static_cast<int>(header.num_blocks));
  reader.finish();
  swap(loaded);
}

void TsdfVolume::read_blocks(const std::function<void(void*, std::size_t)>& read, int num_blocks) {
  // Read in pieces, so that a damaged count fails at the end of the stream rather than by taking all memory.
  constexpr std::size_t kPiece = 1 << 16;
  const auto count = static_cast<std::size_t>(num_blocks);
  std::vector<std::uint64_t> keys;
  for (std::size_t first = 0; first < count; first += kPiece) {
    const std::size_t piece = std::min(kPiece, count - first);
    keys.resize(first + piece);
    read(keys.data() + first, piece * sizeof(std::uint64_t));
  }
  check_keys(keys);
  std::vector<std::uint8_t> flags(count);
  read(flags.data(), count);
  std::vector<unsigned char> bytes;
  pages_.clear();
  for (std::size_t first = 0; first < count; first += kPageBlocks) {
    bytes.resize(std::min<std::size_t>(kPageBlocks, count - first) * sizeof(VoxelBlock));
    read(bytes.data(), bytes.size());
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
