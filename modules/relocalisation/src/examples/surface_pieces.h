// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Pieces of surface, and the keys that sort a frame's examples by them; for both devices.
#pragma once

#include "examples/training_examples.h"

namespace foothold {

inline constexpr int kSurfaceCellMm = 100;                                      ///< edge of a piece of surface (T)
inline constexpr int kCoordinateOffsetMm = 32768;                               ///< makes a place's coordinates positive
inline constexpr std::uint32_t kCellsPerAxis = 2 * 32768 / kSurfaceCellMm + 1;  ///< of a place
inline constexpr std::uint64_t kNoSurface = std::uint64_t{kCellsPerAxis} * kCellsPerAxis * kCellsPerAxis;
inline constexpr std::uint64_t kBeyondReach = kNoSurface + 1;  ///< of what has depth, but lies where a place has no coordinates
inline constexpr int kSurfaceBits = 29;                        ///< of a piece's number
inline constexpr int kExampleBits = 24;                        ///< of an example's number, below its piece of surface in a sort key
static_assert(kBeyondReach < std::uint64_t{1} << kSurfaceBits);

/// The cell of a coordinate, along its axis.
FOOTHOLD_HD inline std::uint32_t cell_of(std::int16_t mm) {
  return static_cast<std::uint32_t>((static_cast<int>(mm) + kCoordinateOffsetMm) / kSurfaceCellMm);
}

/// The centre of a cell, along its axis [mm].
FOOTHOLD_HD inline float cell_centre_mm(std::uint32_t cell) {
  return static_cast<float>(static_cast<int>(cell) * kSurfaceCellMm + kSurfaceCellMm / 2) - static_cast<float>(kCoordinateOffsetMm);
}

/// Sort key of an example: the number of its piece of surface above, kNoSurface without depth, and its own number below.
FOOTHOLD_HD inline std::uint64_t surface_key(const SampledPixel& pixel, const ReservoirPoint& point, std::size_t example) {
  const std::uint64_t piece =
      pixel.depth_m > 0.0F ? (cell_of(point.x_mm) * kCellsPerAxis + cell_of(point.y_mm)) * kCellsPerAxis + cell_of(point.z_mm) : kNoSurface;
  return (piece << kExampleBits) | example;
}

FOOTHOLD_HD inline std::uint64_t surface_of(std::uint64_t surface_key) { return surface_key >> kExampleBits; }
FOOTHOLD_HD inline std::size_t example_of(std::uint64_t surface_key) { return surface_key & ((std::uint64_t{1} << kExampleBits) - 1); }

}  // namespace foothold
