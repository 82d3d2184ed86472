// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/tsdf_volume.h"

#include <algorithm>

#include "foothold/base/error.h"
#include "foothold/base/exec/dispatch.h"
#include "tsdf/tsdf_volume_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct TsdfAlgorithms<CudaExecutor>;
#endif

namespace {

/// Slots of the hash table of an empty map.
constexpr int kMinLog2Slots = 12;
/// Pages that a map on a CUDA device begins with: 25 MB.
constexpr std::size_t kFirstCudaPages = 16;

}  // namespace

float TsdfSettings::reach_m() const { return static_cast<float>(kReachBlocks * kBlockSide) * voxel_size_m; }

void TsdfSettings::validate() const {
  validate_settings(*this);
  if (truncation_m < 2.0F * voxel_size_m) {
    throw InvalidSettings("setting truncation_m: got " + detail::to_text(truncation_m) + ", expected at least two voxels, " +
                          detail::to_text(2.0F * voxel_size_m));
  }
  if (min_depth_m >= max_depth_m) {
    throw InvalidSettings("setting min_depth_m: got " + detail::to_text(min_depth_m) + ", expected less than max_depth_m, " +
                          detail::to_text(max_depth_m));
  }
}

TsdfVolume::TsdfVolume(const Context& context, const TsdfSettings& settings)
    : context_(context),
      settings_(settings),
      page_table_(context.memory()),
      block_keys_(context.memory()),
      slot_keys_(context.memory()),
      slot_blocks_(context.memory()),
      surface_octants_(context.memory()),
      scratch_(std::make_unique<Scratch>(context.memory())) {
  settings.validate();
  reset();
}

TsdfVolume::~TsdfVolume() = default;

TsdfVolume::TsdfVolume(const TsdfVolume& other) : TsdfVolume(other, other.context_) {}

TsdfVolume::TsdfVolume(const TsdfVolume& other, const Context& context) : TsdfVolume(context, other.settings_) {
  reserve_blocks(std::max(1, other.num_blocks_));
  for (std::size_t page = 0; page < std::min(pages_.size(), other.pages_.size()); ++page) {
    detail::copy_memory(context_.memory(), pages_[page].data(), other.context_.memory(), other.pages_[page].data(), pages_[page].size());
  }
  const auto count = static_cast<std::size_t>(other.num_blocks_);
  detail::copy_memory(context_.memory(), block_keys_.data(), other.context_.memory(), other.block_keys_.data(),
                      count * sizeof(std::uint64_t));
  detail::copy_memory(context_.memory(), surface_octants_.data(), other.context_.memory(), other.surface_octants_.data(), count);
  num_blocks_ = other.num_blocks_;
  rebuild_table();
}

TsdfVolume::TsdfVolume(TsdfVolume&& other) noexcept = default;

TsdfVolume& TsdfVolume::operator=(const TsdfVolume& other) {
  TsdfVolume copy(other);
  swap(copy);
  return *this;
}

TsdfVolume& TsdfVolume::operator=(TsdfVolume&& other) noexcept {
  swap(other);
  return *this;
}

void TsdfVolume::swap(TsdfVolume& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(settings_, other.settings_);
  std::swap(num_blocks_, other.num_blocks_);
  std::swap(log2_slots_, other.log2_slots_);
  pages_.swap(other.pages_);
  page_table_.swap(other.page_table_);
  block_keys_.swap(other.block_keys_);
  slot_keys_.swap(other.slot_keys_);
  slot_blocks_.swap(other.slot_blocks_);
  surface_octants_.swap(other.surface_octants_);
  scratch_.swap(other.scratch_);
}

void TsdfVolume::reset() {
  num_blocks_ = 0;
  pages_.clear();
  page_table_.resize(0);
  block_keys_.resize(0);
  surface_octants_.resize(0);
  log2_slots_ = 0;
  reserve_blocks(1);
}

std::size_t TsdfVolume::state_bytes() const {
  return pages_.size() * kPageBlocks * sizeof(VoxelBlock) + page_table_.num_bytes() + block_keys_.num_bytes() + slot_keys_.num_bytes() +
         slot_blocks_.num_bytes() + surface_octants_.num_bytes();
}

TsdfView TsdfVolume::view() const {
  return {page_table_.data(), block_keys_.data(), slot_keys_.data(),      slot_blocks_.data(),   surface_octants_.data(),
          num_blocks_,        log2_slots_,        settings_.voxel_size_m, settings_.truncation_m};
}

void TsdfVolume::fill_page_table() {
  std::vector<VoxelBlock*> table;
  table.reserve(pages_.size());
  for (Array<unsigned char>& page : pages_) table.push_back(reinterpret_cast<VoxelBlock*>(page.data()));
  page_table_.assign(Span<VoxelBlock* const>(table.data(), table.size()));
}

void TsdfVolume::reserve_blocks(int num_blocks) {
  const auto count = static_cast<std::size_t>(num_blocks);
  const bool on_device = context_.memory() == MemoryKind::kCuda;
  std::size_t num_pages = (count + kPageBlocks - 1) / kPageBlocks;
  if (num_pages > pages_.size()) {
    // Allocating on a device stops it: a few frames bear that, not many. All grows at once there. The host's pages are cheap.
    if (on_device) num_pages = std::max(num_pages, pages_.size() + pages_.size() / 2 + kFirstCudaPages);
    while (pages_.size() < num_pages) pages_.emplace_back(context_.memory(), kPageBlocks * sizeof(VoxelBlock));
    fill_page_table();
  }
  const std::size_t capacity = on_device ? pages_.size() * kPageBlocks : count;
  if (on_device) {
    block_keys_.reserve(capacity);
    surface_octants_.reserve(capacity);
  }
  block_keys_.resize(count);
  surface_octants_.resize(count);
  // Linear probing stays short while at most half of the slots are taken.
  int log2_slots = std::max(log2_slots_, kMinLog2Slots);
  while ((std::size_t{1} << static_cast<unsigned>(log2_slots)) < 2 * capacity) ++log2_slots;
  if (log2_slots == log2_slots_) return;
  log2_slots_ = log2_slots;
  const std::size_t num_slots = std::size_t{1} << static_cast<unsigned>(log2_slots);
  slot_keys_ = Array<std::uint64_t>(context_.memory(), num_slots);
  slot_blocks_ = Array<std::int32_t>(context_.memory(), num_slots);
  rebuild_table();
}

void TsdfVolume::rebuild_table() {
  const TsdfTables tables{block_keys_.data(), slot_keys_.data(), slot_blocks_.data(), surface_octants_.data()};
  dispatch(context_, [&](auto on) { TsdfAlgorithms<typename decltype(on)::Executor>::rebuild_table(context_, view(), tables); });
}

IntegrationStats TsdfVolume::integrate(const Frame& frame, const SE3& world_from_camera) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
  FOOTHOLD_EXPECTS(frame.depth.memory == context_.memory());
  FOOTHOLD_EXPECTS_NO_ERROR(describe_pose_error(world_from_camera));
  const PosedDepth camera{frame.depth, frame.calibration.depth, world_from_camera, settings_.depth_range()};
  IntegrationStats stats;
  {
    const ScopedStage stage(context_, "fusion/allocate");
    const int wanted = dispatch(context_, [&](auto on) {
      return TsdfAlgorithms<typename decltype(on)::Executor>::find_new_blocks(context_, view(), camera, *scratch_);
    });
    stats.num_new_blocks = std::min(wanted, settings_.max_blocks - num_blocks_);
    stats.num_blocks_refused = wanted - stats.num_new_blocks;
    if (stats.num_new_blocks > 0) add_blocks(stats.num_new_blocks);
  }
  const ScopedStage stage(context_, "fusion/integrate");
  const SE3 colour_from_world = frame.calibration.depth_from_colour.inverse() * world_from_camera.inverse();
  const PosedColour colour{frame.colour, frame.calibration.colour, colour_from_world};
  const TsdfTables tables{block_keys_.data(), slot_keys_.data(), slot_blocks_.data(), surface_octants_.data()};
  dispatch(context_, [&](auto on) {
    TsdfAlgorithms<typename decltype(on)::Executor>::integrate(context_, view(), tables, camera, colour, settings_.max_weight, *scratch_);
  });
  return stats;
}

void TsdfVolume::add_blocks(int num_new) {
  const int first = num_blocks_;
  reserve_blocks(first + num_new);
  num_blocks_ = first + num_new;
  const TsdfTables tables{block_keys_.data(), slot_keys_.data(), slot_blocks_.data(), surface_octants_.data()};
  dispatch(context_,
           [&](auto on) { TsdfAlgorithms<typename decltype(on)::Executor>::add_blocks(context_, view(), tables, first, *scratch_); });
}

}  // namespace foothold
