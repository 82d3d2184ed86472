// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/evaluation/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "foothold/base/contract.h"
#include "foothold/base/trace.h"

namespace foothold {
namespace {

using Eigen::Vector3d;

/// 21 bits a coordinate.
std::uint64_t key_of(const Eigen::Vector3i& cell) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) key = key << 21U | (static_cast<std::uint64_t>(cell[axis]) & 0x1fffffU);
  return key;
}

/// The nearest point of a segment.
Vector3d nearest_on_segment(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((point - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
  return a + t * (b - a);
}

/// The squared distance to a triangle: to its plane where the foot lies inside, else to the nearest edge.
double squared_distance(const Vector3d& point, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d ap = point - a;
  const double bb = ab.squaredNorm();
  const double cc = ac.squaredNorm();
  const double bc = ab.dot(ac);
  const double determinant = bb * cc - bc * bc;
  if (determinant > 1e-12 * bb * cc) {  // not degenerate
    const double v = (cc * ap.dot(ab) - bc * ap.dot(ac)) / determinant;
    const double w = (bb * ap.dot(ac) - bc * ap.dot(ab)) / determinant;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) return (ap - v * ab - w * ac).squaredNorm();
  }
  return std::min({(point - nearest_on_segment(point, a, b)).squaredNorm(), (point - nearest_on_segment(point, b, c)).squaredNorm(),
                   (point - nearest_on_segment(point, c, a)).squaredNorm()});
}

/// The triangles of a mesh by the cubes that their bounding boxes touch.
class TriangleGrid {
 public:
  TriangleGrid(const Mesh& mesh, double cell_m) : mesh_(mesh), cell_m_(cell_m) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Vector3d low = corner(i, 0);
      Vector3d high = low;
      for (int k = 1; k < 3; ++k) {
        low = low.cwiseMin(corner(i, k));
        high = high.cwiseMax(corner(i, k));
      }
      for_each_cell(cell_of(low), cell_of(high), [&](const Eigen::Vector3i& cell) { cells_[key_of(cell)].push_back(static_cast<int>(i)); });
    }
  }

  /// The distance to the surface, or infinity if none lies within `limit_m`: cubes are searched from the point's own outwards.
  double distance_m(const Vector3d& point, double limit_m) const {
    double nearest2 = std::numeric_limits<double>::infinity();
    const Eigen::Vector3i centre = cell_of(point);
    const int num_rings = static_cast<int>(std::ceil(limit_m / cell_m_));
    for (int ring = 0; ring <= num_rings; ++ring) {
      for_each_cell(centre.array() - ring, centre.array() + ring, [&](const Eigen::Vector3i& cell) {
        if ((cell - centre).cwiseAbs().maxCoeff() == ring) nearest2 = std::min(nearest2, nearest_in_cell(point, cell));
      });
      if (std::sqrt(nearest2) <= ring * cell_m_) break;  // nothing outside these cubes is nearer
    }
    const double distance_m = std::sqrt(nearest2);
    return distance_m <= limit_m ? distance_m : std::numeric_limits<double>::infinity();
  }

 private:
  Vector3d corner(std::size_t triangle, int k) const {
    const int vertex = mesh_.triangles[triangle][static_cast<std::size_t>(k)];
    return mesh_.vertices[static_cast<std::size_t>(vertex)].cast<double>();
  }
  double nearest_in_cell(const Vector3d& point, const Eigen::Vector3i& cell) const {
    double nearest2 = std::numeric_limits<double>::infinity();
    const auto found = cells_.find(key_of(cell));
    if (found == cells_.end()) return nearest2;
    for (const int triangle : found->second) {
      const auto i = static_cast<std::size_t>(triangle);
      nearest2 = std::min(nearest2, squared_distance(point, corner(i, 0), corner(i, 1), corner(i, 2)));
    }
    return nearest2;
  }
  Eigen::Vector3i cell_of(const Vector3d& point) const { return (point / cell_m_).array().floor().cast<int>(); }
  template <class Visit>
  static void for_each_cell(const Eigen::Vector3i& low, const Eigen::Vector3i& high, Visit&& visit) {
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) visit(Eigen::Vector3i(x, y, z));
      }
    }
  }

  const Mesh& mesh_;
  double cell_m_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

}  // namespace

MeshDistance mesh_distance(const Mesh& measured, const Mesh& reference, double tolerance_m, double limit_m) {
  FOOTHOLD_EXPECTS(limit_m > 0.0 && tolerance_m <= limit_m);
  constexpr double kCellsPerLimit = 4.0;  // small cubes hold few triangles, but there are more of them to search
  const TriangleGrid grid(reference, limit_m / kCellsPerLimit);
  MeshDistance result;
  std::vector<double> distances_m;
  double sum_m = 0.0;
  double sum_m2 = 0.0;
  for (const Eigen::Vector3f& vertex : measured.vertices) {
    ++result.num_vertices;
    const double distance_m = grid.distance_m(vertex.cast<double>(), limit_m);
    if (!std::isfinite(distance_m)) continue;
    ++result.num_near;
    if (distance_m <= tolerance_m) ++result.num_within;
    distances_m.push_back(distance_m);
    sum_m += distance_m;
    sum_m2 += distance_m * distance_m;
  }
  result.mean_m = sum_m / result.num_near;  // NaN without near vertices
  result.rmse_m = std::sqrt(sum_m2 / result.num_near);
  result.median_m = quantile(distances_m, 0.5);
  result.p95_m = quantile(std::move(distances_m), 0.95);
  return result;
}

}  // namespace foothold
