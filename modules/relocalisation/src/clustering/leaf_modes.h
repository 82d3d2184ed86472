// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What leaves predict: the modes of their reservoirs, by Really Quick Shift. Reference: [Cavallari2017] Sec. 2.2.2, step 3;
/// [Fulkerson2010].
#pragma once

#include <cstdint>

#include "clustering/leaf_colours.h"
#include "foothold/base/array.h"
#include "foothold/base/context.h"
#include "foothold/relocalisation/settings.h"
#include "reservoirs/leaf_reservoirs.h"

namespace foothold {

class CheckedReader;
class CheckedWriter;

/// A cluster of world points: a 3D Gaussian with a mean colour.
struct Mode {
  float mean_m[3];     ///< from the scene's origin
  float precision[6];  ///< inverse covariance [1/m^2]: xx, xy, xz, yy, yz, zz
  std::uint8_t rgb[3];
  std::uint8_t reserved;
  std::uint32_t num_points;
};
static_assert(sizeof(Mode) == 44, "read from files and by kernels");

inline constexpr int kModeBlockSize = 4;

/// What kernels see of the modes.
struct LeafModesView {
  BlockListsView<Mode, kModeBlockSize> modes;
  std::uint32_t* num_modes = nullptr;         ///< per leaf
  std::uint32_t* num_owned_blocks = nullptr;  ///< per leaf
  LeafColours* colours = nullptr;             ///< per leaf, of its modes
};

/// The modes of all leaves, and the choice of leaves to renew.
class LeafModes {
 public:
  LeafModes(const Context& context, int num_leaves, const ClusteringSettings& settings);

  /// Renews the modes of the leaves whose turn it is: round robin as in the paper, or those whose reservoirs changed most.
  void update(const Context& context, LeafReservoirs& reservoirs);
  /// True if the last update() found no leaf that had changed. Waits for the device.
  bool was_idle(const Context& context) const { return chosen_.read(context, 0) >= static_cast<std::uint32_t>(num_leaves_); }

  LeafModesView view() { return {modes_.view(), num_modes_.data(), num_owned_blocks_.data(), colours_.data()}; }
  std::size_t state_bytes(const Context& context) const;
  void clear();

  void save(CheckedWriter& writer) const;
  void load(CheckedReader& reader);

 private:
  ClusteringSettings settings_;
  int num_leaves_;
  std::uint32_t cursor_ = 0;  ///< next leaf of the round robin
  BlockLists<Mode, kModeBlockSize> modes_;
  Array<std::uint32_t> num_modes_;
  Array<std::uint32_t> num_owned_blocks_;
  Array<LeafColours> colours_;  ///< not saved: the modes tell
  // Scratch of update().
  Array<std::uint64_t> keys_;
  Array<std::uint64_t> sort_buffer_;
  Array<std::uint32_t> costs_;
  Array<std::uint32_t> cost_before_;
  Array<std::uint32_t> chosen_;
  Array<Mode> new_modes_;  ///< leaves_per_frame x max_modes
  Array<std::uint32_t> num_new_modes_;
  Array<std::uint32_t> new_blocks_;
  Array<std::uint32_t> first_new_block_;
};

}  // namespace foothold
