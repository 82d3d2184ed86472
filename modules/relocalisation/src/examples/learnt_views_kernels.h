// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The bodies of learnt_views.h, for both devices.
#pragma once

#include <cmath>

#include "examples/learnt_views.h"
#include "examples/surface_pieces.h"
#include "foothold/base/exec/atomics.h"
#include "foothold/base/random.h"

namespace foothold {

inline constexpr int kDirectionBins = 8;  ///< of a viewpoint, along an edge of a cube around the piece of surface (T)
inline constexpr int kCountBits = 8;      ///< of a table's slot; the view's key is above
inline constexpr std::uint64_t kEmptySlot = ~std::uint64_t{0};

/// A hash table from views to counts: linear probing, slots hold the view above the count.
struct ViewTable {
  std::uint64_t* slots;
  std::uint64_t mask;

  FOOTHOLD_HD std::uint64_t first_slot(std::uint64_t view) const { return mix_bits(view) & mask; }
  FOOTHOLD_HD std::uint32_t count(std::uint64_t view) const {
    for (std::uint64_t slot = first_slot(view);; slot = (slot + 1) & mask) {
      if (slots[slot] == kEmptySlot) return 0;
      if (slots[slot] >> kCountBits == view) return static_cast<std::uint32_t>(slots[slot] & ((1U << kCountBits) - 1));
    }
  }
  /// Sets a count. One caller at a time per view, any number of views.
  FOOTHOLD_HD void set(std::uint64_t view, std::uint32_t count) const {
    const std::uint64_t desired = (view << kCountBits) | count;
    for (std::uint64_t slot = first_slot(view);; slot = (slot + 1) & mask) {
      std::uint64_t found = atomic_compare_exchange(slots + slot, kEmptySlot, desired);
      if (found == kEmptySlot) return;
      if (found >> kCountBits != view) continue;
      atomic_compare_exchange(slots + slot, found, desired);
      return;
    }
  }
};

/// Where a camera sees a piece of surface from: the direction in bins on a cube, the distance in half octaves.
struct ViewpointOf {
  float camera_mm[3];

  FOOTHOLD_HD std::uint64_t operator()(std::uint64_t surface) const {
    const auto number = static_cast<std::uint32_t>(surface);
    const std::uint32_t cells[3] = {number / (kCellsPerAxis * kCellsPerAxis), number / kCellsPerAxis % kCellsPerAxis,
                                    number % kCellsPerAxis};
    std::uint64_t view = 0;
    float d[3];
    for (int k = 0; k < 3; ++k) {
      view = (view << 11U) | cells[k];
      d[k] = camera_mm[k] - cell_centre_mm(cells[k]);
    }
    int axis = std::fabs(d[1]) > std::fabs(d[0]) ? 1 : 0;
    if (std::fabs(d[2]) > std::fabs(d[axis])) axis = 2;
    const float longest = std::fabs(d[axis]) > 1.0F ? std::fabs(d[axis]) : 1.0F;
    const std::uint64_t face = static_cast<std::uint64_t>(2 * axis + (d[axis] < 0.0F ? 1 : 0));
    const std::uint64_t a = bin(d[axis == 0 ? 1 : 0] / longest);
    const std::uint64_t b = bin(d[axis == 2 ? 1 : 2] / longest);
    std::uint64_t distance = 0;
    const float distance2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    for (float limit = 250.0F * 250.0F; distance < 15 && distance2 > limit; limit *= 2.0F) ++distance;
    return (((view * 6 + face) * 16 + a) * 16 + b) * 16 + distance;
  }

 private:
  FOOTHOLD_HD std::uint64_t bin(float ratio) const {
    const auto i = static_cast<int>((ratio + 1.0F) * 0.5F * static_cast<float>(kDirectionBins));
    return static_cast<std::uint64_t>(i < kDirectionBins ? i : kDirectionBins - 1);
  }
};

/// One worker per piece of surface keeps as many of its examples as are missing, evenly spread over them.
struct KeepNewExamples {
  Span<const std::uint64_t> keys;
  ViewTable table;
  ViewpointOf view_of;
  std::uint32_t examples_per_view;  ///< 0 for no limit
  std::uint32_t* kept;              ///< per example: 1 if it is
  std::uint32_t* counts;            ///< per sort key: what the table is to hold, 0 where nothing changes
  std::uint32_t* num_entries;       ///< of the table; grows by the views that it does not hold yet
  std::uint32_t* num_beyond_reach;  ///< of the examples

  FOOTHOLD_HD void operator()(std::size_t i) const {
    counts[i] = 0;
    const std::uint64_t surface = surface_of(keys[i]);
    if (i + 1 == keys.size()) *num_beyond_reach = count_beyond_reach();
    if (surface >= kNoSurface) kept[example_of(keys[i])] = 0;
    if (surface >= kNoSurface || (i > 0 && surface_of(keys[i - 1]) == surface)) return;
    std::size_t end = i + 1;
    while (end < keys.size() && surface_of(keys[end]) == surface) ++end;
    const auto offered = static_cast<std::uint32_t>(end - i);  // times a count still fits
    if (examples_per_view == 0) {
      for (std::size_t k = i; k < end; ++k) kept[example_of(keys[k])] = 1;
      return;
    }
    const std::uint32_t known = table.count(view_of(surface));
    const std::uint32_t missing = known < examples_per_view ? examples_per_view - known : 0;
    const std::uint32_t wanted = offered < missing ? offered : missing;
    for (std::uint32_t k = 0; k < offered; ++k) kept[example_of(keys[i + k])] = (k + 1) * wanted / offered > k * wanted / offered ? 1 : 0;
    if (wanted == 0) return;
    counts[i] = known + wanted;
    if (known == 0) atomic_add(num_entries, 1);
  }

 private:
  /// They are sorted behind all others.
  FOOTHOLD_HD std::uint32_t count_beyond_reach() const {
    std::size_t first = keys.size();
    while (first > 0 && surface_of(keys[first - 1]) == kBeyondReach) --first;
    return static_cast<std::uint32_t>(keys.size() - first);
  }
};

static_assert(kExampleBits + kCountBits <= 32, "a number of examples times a count fits into 32 bits");

/// Moves the kept examples to the front and counts them.
struct PackExamples {
  Span<const std::uint32_t> kept;
  const std::uint32_t* offsets;
  const SampledPixel* pixels_from;
  const ReservoirPoint* points_from;
  SampledPixel* pixels;
  ReservoirPoint* points;
  std::uint32_t* num_kept;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    if (i + 1 == kept.size()) *num_kept = offsets[i + 1];
    if (kept[i] == 0) return;
    pixels[offsets[i]] = pixels_from[i];
    points[offsets[i]] = points_from[i];
  }
};

/// Enters what is kept: examples in front, and their counts in the table, which nobody reads any more.
struct EnterExamples {
  PackExamples pack;
  Span<const std::uint64_t> keys;
  ViewTable table;
  ViewpointOf view_of;
  const std::uint32_t* counts;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    pack(i);
    if (counts[i] != 0) table.set(view_of(surface_of(keys[i])), counts[i]);
  }
};

/// Enters the slots of a smaller table into a larger one.
struct Rehash {
  const std::uint64_t* from;
  ViewTable to;

  FOOTHOLD_HD void operator()(std::size_t i) const {
    if (from[i] != kEmptySlot) to.set(from[i] >> kCountBits, static_cast<std::uint32_t>(from[i] & ((1U << kCountBits) - 1)));
  }
};

struct ClearViews {
  std::uint64_t* slots;
  FOOTHOLD_HD void operator()(std::size_t i) const { slots[i] = kEmptySlot; }
};

}  // namespace foothold
