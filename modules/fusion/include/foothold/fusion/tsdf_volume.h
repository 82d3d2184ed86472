// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The map: a truncated signed distance function with colour, in hashed blocks of voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "foothold/api/frame.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/base/persistent.h"
#include "foothold/base/platform.h"
#include "foothold/base/settings.h"

namespace foothold {

class CheckedReader;

struct TsdfView;    // what kernels see of a volume; private
struct VoxelBlock;  // 8 x 8 x 8 voxels; private

/// The depth readings that count [m]; nearer and farther ones are ignored.
struct DepthRange {
  float min_m = 0.0F;  ///< the least [m]
  float max_m = 0.0F;  ///< the greatest [m]

  /// Whether a reading counts; NaN does not.
  FOOTHOLD_HD bool holds(float depth_m) const { return depth_m >= min_m && depth_m <= max_m; }
};

/// Size and accuracy of the map.
struct TsdfSettings {
  /// Distance between voxels [m]; memory grows with its inverse square.
  float voxel_size_m = 0.01F;
  /// Distance from the surface at which the signed distance saturates [m].
  float truncation_m = 0.06F;
  /// Observations averaged at most; fewer adapt faster to change, more average noise away.
  int max_weight = 255;
  /// Nearer depth readings are ignored [m], by everything that uses the map.
  float min_depth_m = 0.2F;
  /// Farther depth readings likewise [m]: a structured-light camera's error grows with the square of depth.
  float max_depth_m = 5.0F;
  /// Blocks held at most; frames that need more are still fused into those that exist.
  int max_blocks = 1 << 20;

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&TsdfSettings::voxel_size_m, "voxel_size_m", "Distance between voxels [m] (R).", Range{0.001, 0.1});
    v(&TsdfSettings::truncation_m, "truncation_m", "Distance at which the signed distance saturates [m]; at least two voxels (R).",
      Range{0.002, 1.0});
    v(&TsdfSettings::max_weight, "max_weight", "Observations averaged at most (T: fusion_benchmark, kitchen; R: 100).", Range{1, 255});
    v(&TsdfSettings::min_depth_m, "min_depth_m", "Nearer depth is ignored [m] (R).", Range{0.01, 10.0});
    v(&TsdfSettings::max_depth_m, "max_depth_m", "Farther depth is ignored [m] (T: fusion_benchmark, kitchen).", Range{0.1, 100.0});
    v(&TsdfSettings::max_blocks, "max_blocks", "Blocks of 8 x 8 x 8 voxels held at most, 3 KB each.", Range{1, 1 << 24});
  }
  /// The readings that are fused.
  DepthRange depth_range() const { return {min_depth_m, max_depth_m}; }
  /// Largest coordinate that a map holds, along each axis [m]: blocks are numbered with 21 bits.
  float reach_m() const;
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const;
};

/// What one frame did to the map.
struct IntegrationStats {
  int num_new_blocks = 0;      ///< added to the map
  int num_blocks_refused = 0;  ///< wanted, but max_blocks was reached
};

/// A truncated signed distance function with colour that grows where the camera looks.
///
/// Voxel (i, j, k) is a sample of the function at (i, j, k) * voxel_size_m in the world frame; 8 x 8 x 8 of them form a block, found
/// through a hash table of block coordinates. A voxel takes 6 bytes: distance, weight, colour. Copies are independent.
///
/// Determinism: contents and order of the blocks are a function of the frames and poses, whatever the number of threads.
/// Reference: [Curless1996] for the running average, [Niessner2013] for the hashed blocks.
class TsdfVolume : public Persistent {
 public:
  struct Scratch;  ///< buffers of the implementation

  /// @throws InvalidSettings
  TsdfVolume(const Context& context, const TsdfSettings& settings);
  ~TsdfVolume() override;
  /// Copies the map, on the same device.
  TsdfVolume(const TsdfVolume& other);
  /// Copies a map to another context's device.
  TsdfVolume(const TsdfVolume& other, const Context& context);
  /// What was moved from may only be assigned to or destroyed.
  TsdfVolume(TsdfVolume&& other) noexcept;
  /// Copies the map, on its device.
  TsdfVolume& operator=(const TsdfVolume& other);
  /// What was moved from may only be assigned to or destroyed.
  TsdfVolume& operator=(TsdfVolume&& other) noexcept;

  /// Averages a frame into the map, growing it along the observed surface.
  ///
  /// @pre describe_frame_error(frame) is empty, its images live in context.memory(), and the pose is rigid.
  /// Cost: O(blocks) to find those in view, then O(voxels in view).
  IntegrationStats integrate(const Frame& frame, const SE3& world_from_camera);

  /// Forgets everything.
  void reset();

  /// Writes the map: header, settings, blocks, checksum. @throws FileError if writing fails.
  void save(std::ostream& stream) const override;
  /// Reads a map, its settings included. On failure the former map stays. @throws FileError
  void load(std::istream& stream) override;

  /// The device, threads and memory that the map works with.
  const Context& context() const { return context_; }
  /// As given to the constructor, or as load() read them.
  const TsdfSettings& settings() const { return settings_; }
  /// Blocks of 8 x 8 x 8 voxels in the map.
  int num_blocks() const { return num_blocks_; }
  /// Memory held for the map [bytes].
  std::size_t state_bytes() const;
  /// What kernels see; valid until the next change of the map.
  TsdfView view() const;

 private:
  void fill_page_table();
  void reserve_blocks(int num_blocks);
  void add_blocks(int num_new);
  void rebuild_table();
  void read_blocks(CheckedReader& reader, int num_blocks);
  void swap(TsdfVolume& other) noexcept;

  Context context_;
  TsdfSettings settings_;
  int num_blocks_ = 0;
  int log2_slots_ = 0;
  std::vector<Array<unsigned char>> pages_;  // blocks, so that growing never copies them
  Array<VoxelBlock*> page_table_;            // where each page lies
  Array<std::uint64_t> block_keys_;          // coordinates of each block, by its index
  Array<std::uint64_t> slot_keys_;           // open addressing: key, or kNoKey
  Array<std::int32_t> slot_blocks_;          // index of the block in each slot
  Array<std::uint8_t> surface_octants_;      // one bit for each eighth of a block in which a ray may hit something
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foothold
