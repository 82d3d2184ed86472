// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Really Quick Shift on one leaf, by a team of lanes, for both devices. Reference: [Fulkerson2010]; [Cavallari2017] Sec. 2.2.2, step 3.
#pragma once

#include <cmath>
#include <cstdint>

#include "clustering/leaf_modes.h"
#include "reservoirs/leaf_reservoirs_kernels.h"

namespace foothold {

inline constexpr int kMaxReservoir = 1024;  ///< of ReservoirSettings::capacity
inline constexpr int kMaxModes = 64;        ///< of ClusteringSettings::max_modes
static_assert(kMaxReservoir % 16 == 0, "points are processed in vectors");

inline constexpr float kDensitySigmaM = 0.1F;  ///< (R) standard deviation of the density kernel
inline constexpr float kLongestLinkM = 0.05F;  ///< (R) from a point to its parent of higher density

/// Shared by the lanes of a team: the points of one leaf and what becomes of them.
struct QuickShiftScratch {
  float key_mm[kMaxReservoir];  ///< coordinate along the longest axis; rising, once sorted
  float x_mm[kMaxReservoir];
  float y_mm[kMaxReservoir];
  float z_mm[kMaxReservoir];
  float density[kMaxReservoir];
  std::uint16_t source[kMaxReservoir];  ///< position in the reservoir
  std::int32_t parent[kMaxReservoir];   ///< later the root of the cluster
  std::int32_t size[kMaxReservoir];     ///< of the cluster whose root this is; 0 once the cluster has a rank
  std::int32_t root[kMaxModes];         ///< of the cluster of each rank
};

/// exp(-t) for t in [0, 4.5], to 0.7 %: the eighth power of a short series, in operations that every device rounds alike.
FOOTHOLD_HD FOOTHOLD_INLINE float exp_minus(float t) {
  const float s = -0.125F * t;
  const float e = 1.0F + s * (1.0F + s * (0.5F + s * (1.0F / 6.0F + s * (1.0F / 24.0F))));
  const float e2 = e * e;
  const float e4 = e2 * e2;
  return e4 * e4;
}

/// Sums over a cluster's members relative to its root: integers, so that their order does not matter.
enum ClusterSum { kCount, kX, kY, kZ, kXx, kXy, kXz, kYy, kYz, kZz, kRed, kGreen, kBlue, kNumClusterSums };

/// Finds the modes of one leaf.
template <class Team, int kWidth>
struct QuickShift {
  const Team& team;
  QuickShiftScratch& s;
  const LeafReservoirsView& reservoirs;
  const ClusteringSettings& settings;
  std::uint32_t leaf;
  int num_points;

  /// @return The number of modes, written to `modes` with the largest first; the same on every lane.
  FOOTHOLD_HD int run(Mode* modes) const {
    load_keys();
    team.sync();
    load_points_in_order();
    team.sync();
    estimate_densities();
    team.sync();
    link_to_parents();
    team.sync();
    find_roots();
    team.sync();
    const int num_modes = rank_clusters();
    for (int rank = 0; rank < num_modes; ++rank) summarise(rank, modes[rank]);
    return num_modes;
  }

 private:
  FOOTHOLD_HD int padded() const { return (num_points + kWidth - 1) / kWidth * kWidth; }

  /// The coordinate that spreads the points most, as the key to sort them by: neighbours then stand close together.
  FOOTHOLD_HD void load_keys() const {
    int low[3] = {32767, 32767, 32767};
    int high[3] = {-32768, -32768, -32768};
    for (int i = team.lane(); i < num_points; i += team.size()) {
      const ReservoirPoint point = reservoirs.point(leaf, i);
      const int coordinates[3] = {point.x_mm, point.y_mm, point.z_mm};
      for (int k = 0; k < 3; ++k) {
        low[k] = coordinates[k] < low[k] ? coordinates[k] : low[k];
        high[k] = coordinates[k] > high[k] ? coordinates[k] : high[k];
      }
    }
    for (int k = 0; k < 3; ++k) {
      low[k] = team.lowest(low[k]);
      high[k] = team.highest(high[k]);
    }
    int axis = high[1] - low[1] > high[0] - low[0] ? 1 : 0;
    if (high[2] - low[2] > high[axis] - low[axis]) axis = 2;
    for (int i = team.lane(); i < padded(); i += team.size()) {
      const ReservoirPoint point = reservoirs.point(leaf, i < num_points ? i : num_points - 1);
      s.density[i] = axis == 0 ? point.x_mm : (axis == 1 ? point.y_mm : point.z_mm);  // unsorted keys, until densities need the space
    }
  }

  /// Puts each point at its rank: the number of points with a smaller key, or an equal one and a lower position.
  FOOTHOLD_HD void load_points_in_order() const {
    for (int first = team.lane() * kWidth; first < num_points; first += team.size() * kWidth) {
      std::int32_t rank[kWidth] = {};
      for (int j = 0; j < num_points; ++j) {
        for (int w = 0; w < kWidth; ++w) {
          const float key = s.density[first + w];
          rank[w] += (s.density[j] < key) | ((s.density[j] == key) & (j < first + w)) ? 1 : 0;
        }
      }
      for (int w = 0; w < kWidth && first + w < num_points; ++w) {
        const ReservoirPoint point = reservoirs.point(leaf, first + w);
        s.key_mm[rank[w]] = s.density[first + w];
        s.x_mm[rank[w]] = point.x_mm;
        s.y_mm[rank[w]] = point.y_mm;
        s.z_mm[rank[w]] = point.z_mm;
        s.source[rank[w]] = static_cast<std::uint16_t>(first + w);
      }
    }
    for (int i = num_points + team.lane(); i < padded(); i += team.size()) s.key_mm[i] = s.x_mm[i] = s.y_mm[i] = s.z_mm[i] = 32767.0F;
  }

  /// The sorted positions [begin, end) that hold every point within `reach` of the points first ... first + kWidth - 1.
  FOOTHOLD_HD void window(int first, float reach_mm, int& begin, int& end) const {
    const int last = first + kWidth < num_points ? first + kWidth - 1 : num_points - 1;
    begin = first;
    while (begin > 0 && s.key_mm[begin - 1] > s.key_mm[first] - reach_mm) --begin;
    end = last + 1;
    while (end < num_points && s.key_mm[end] < s.key_mm[last] + reach_mm) ++end;
  }

  /// Parzen density with a Gaussian kernel cut off at three sigma.
  FOOTHOLD_HD void estimate_densities() const {
    constexpr float sigma_mm = kDensitySigmaM * 1000.0F;
    const float cutoff_mm2 = 9.0F * sigma_mm * sigma_mm;
    const float scale = 0.5F / (sigma_mm * sigma_mm);
    for (int first = team.lane() * kWidth; first < num_points; first += team.size() * kWidth) {
      int begin = 0;
      int end = 0;
      window(first, 3.0F * sigma_mm, begin, end);
      float sum[kWidth] = {};
      for (int j = begin; j < end; ++j) {
        for (int w = 0; w < kWidth; ++w) {
          const float dx = s.x_mm[first + w] - s.x_mm[j];
          const float dy = s.y_mm[first + w] - s.y_mm[j];
          const float dz = s.z_mm[first + w] - s.z_mm[j];
          const float d2 = dx * dx + dy * dy + dz * dz;
          const float weight = exp_minus(d2 * scale);
          sum[w] += d2 < cutoff_mm2 ? weight : 0.0F;
        }
      }
      for (int w = 0; w < kWidth; ++w) s.density[first + w] = sum[w];
    }
  }

  /// The nearest point of higher density within tau; equal densities are ordered by position.
  FOOTHOLD_HD void link_to_parents() const {
    constexpr float tau_mm = kLongestLinkM * 1000.0F;
    for (int first = team.lane() * kWidth; first < num_points; first += team.size() * kWidth) {
      int begin = 0;
      int end = 0;
      window(first, tau_mm, begin, end);
      float nearest[kWidth];
      std::int32_t parent[kWidth];
      for (int w = 0; w < kWidth; ++w) {
        nearest[w] = tau_mm * tau_mm;
        parent[w] = first + w;
      }
      for (int j = begin; j < end; ++j) {
        for (int w = 0; w < kWidth; ++w) {
          const float dx = s.x_mm[first + w] - s.x_mm[j];
          const float dy = s.y_mm[first + w] - s.y_mm[j];
          const float dz = s.z_mm[first + w] - s.z_mm[j];
          const float d2 = dx * dx + dy * dy + dz * dz;
          const float density = s.density[first + w];
          const bool denser = (s.density[j] > density) | ((s.density[j] == density) & (j < first + w));
          const bool better = denser & (d2 < nearest[w]);
          nearest[w] = better ? d2 : nearest[w];
          parent[w] = better ? j : parent[w];
        }
      }
      for (int w = 0; w < kWidth; ++w) s.parent[first + w] = parent[w];
    }
  }

  FOOTHOLD_HD void find_roots() const {
    for (int i = team.lane(); i < num_points; i += team.size()) {
      std::int32_t root = i;
      while (s.parent[root] != root) root = s.parent[root];
      s.size[i] = root;  // parents are still being read by other lanes
    }
    team.sync();
    for (int i = team.lane(); i < num_points; i += team.size()) s.parent[i] = s.size[i];
    team.sync();
    for (int i = team.lane(); i < num_points; i += team.size()) s.size[i] = 0;
    team.sync();
    for (int i = team.lane(); i < num_points; i += team.size()) team.fetch_add(s.size[s.parent[i]], 1);
  }

  /// Gives the largest clusters their ranks. Ties go to the lower root.
  FOOTHOLD_HD int rank_clusters() const {
    int num_modes = 0;
    for (; num_modes < settings.max_modes; ++num_modes) {
      std::int32_t best = 0;  // size above, root below, so that the highest is the largest cluster with the lowest root
      for (int i = team.lane(); i < num_points; i += team.size()) {
        const std::int32_t candidate = s.size[i] * kMaxReservoir + (kMaxReservoir - 1 - i);
        best = candidate > best ? candidate : best;
      }
      best = team.highest(best);
      if (best / kMaxReservoir < settings.min_cluster_size) break;
      if (team.lane() == 0) {
        s.root[num_modes] = kMaxReservoir - 1 - best % kMaxReservoir;
        s.size[s.root[num_modes]] = 0;
      }
      team.sync();
    }
    return num_modes;
  }

  FOOTHOLD_HD void summarise(int rank, Mode& mode) const {
    std::int64_t sums[kNumClusterSums] = {};
    const std::int32_t root = s.root[rank];
    const auto root_x = static_cast<std::int64_t>(s.x_mm[root]);
    const auto root_y = static_cast<std::int64_t>(s.y_mm[root]);
    const auto root_z = static_cast<std::int64_t>(s.z_mm[root]);
    for (int i = team.lane(); i < num_points; i += team.size()) {
      if (s.parent[i] != root) continue;
      const auto x = static_cast<std::int64_t>(s.x_mm[i]) - root_x;
      const auto y = static_cast<std::int64_t>(s.y_mm[i]) - root_y;
      const auto z = static_cast<std::int64_t>(s.z_mm[i]) - root_z;
      const std::uint16_t colour = reservoirs.point(leaf, s.source[i]).rgb565;
      sums[kCount] += 1;
      sums[kX] += x;
      sums[kY] += y;
      sums[kZ] += z;
      sums[kXx] += x * x;
      sums[kXy] += x * y;
      sums[kXz] += x * z;
      sums[kYy] += y * y;
      sums[kYz] += y * z;
      sums[kZz] += z * z;
      sums[kRed] += red_of(colour);
      sums[kGreen] += green_of(colour);
      sums[kBlue] += blue_of(colour);
    }
    team.sum_all(sums);
    if (team.lane() == 0) mode = make_mode(sums, root_x, root_y, root_z);
  }

  /// Mean, regularised unbiased covariance (inverted) and mean colour.
  FOOTHOLD_HD Mode make_mode(const std::int64_t (&sums)[kNumClusterSums], std::int64_t root_x, std::int64_t root_y,
                             std::int64_t root_z) const {
    const auto n = static_cast<double>(sums[kCount]);
    const double x = static_cast<double>(sums[kX]) / n;
    const double y = static_cast<double>(sums[kY]) / n;
    const double z = static_cast<double>(sums[kZ]) / n;
    const double floor_mm2 = 1e6 * static_cast<double>(settings.covariance_floor_m) * static_cast<double>(settings.covariance_floor_m);
    const double unbiased = 1.0 / (n > 1.0 ? n - 1.0 : 1.0);
    const double xx = (static_cast<double>(sums[kXx]) - n * x * x) * unbiased + floor_mm2;
    const double xy = (static_cast<double>(sums[kXy]) - n * x * y) * unbiased;
    const double xz = (static_cast<double>(sums[kXz]) - n * x * z) * unbiased;
    const double yy = (static_cast<double>(sums[kYy]) - n * y * y) * unbiased + floor_mm2;
    const double yz = (static_cast<double>(sums[kYz]) - n * y * z) * unbiased;
    const double zz = (static_cast<double>(sums[kZz]) - n * z * z) * unbiased + floor_mm2;
    const double c_xx = yy * zz - yz * yz;
    const double c_xy = xz * yz - xy * zz;
    const double c_xz = xy * yz - xz * yy;
    const double scale = 1e6 / (xx * c_xx + xy * c_xy + xz * c_xz);  // 1/mm^2 to 1/m^2
    Mode mode;
    mode.mean_m[0] = static_cast<float>((static_cast<double>(root_x) + x) * 1e-3);
    mode.mean_m[1] = static_cast<float>((static_cast<double>(root_y) + y) * 1e-3);
    mode.mean_m[2] = static_cast<float>((static_cast<double>(root_z) + z) * 1e-3);
    mode.precision[0] = static_cast<float>(scale * c_xx);
    mode.precision[1] = static_cast<float>(scale * c_xy);
    mode.precision[2] = static_cast<float>(scale * c_xz);
    mode.precision[3] = static_cast<float>(scale * (xx * zz - xz * xz));
    mode.precision[4] = static_cast<float>(scale * (xy * xz - xx * yz));
    mode.precision[5] = static_cast<float>(scale * (xx * yy - xy * xy));
    const auto count = static_cast<std::int32_t>(sums[kCount]);
    mode.rgb[0] = static_cast<std::uint8_t>(static_cast<std::int32_t>(sums[kRed]) / count);
    mode.rgb[1] = static_cast<std::uint8_t>(static_cast<std::int32_t>(sums[kGreen]) / count);
    mode.rgb[2] = static_cast<std::uint8_t>(static_cast<std::int32_t>(sums[kBlue]) / count);
    mode.reserved = 0;
    mode.num_points = static_cast<std::uint32_t>(sums[kCount]);
    return mode;
  }
};

}  // namespace foothold
