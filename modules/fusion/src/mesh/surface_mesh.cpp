// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/surface_mesh.h"

#include <Eigen/Geometry>

#include "mesh/marching_cubes.h"
#include "tsdf/tsdf_view.h"

namespace foothold {

namespace {

constexpr int kEdgesPerBlock = 3 * kBlockVoxels;
constexpr int kWords = kEdgesPerBlock / 64;

int popcount(std::uint64_t bits) { return __builtin_popcountll(bits); }

/// Which edges of a block carry a vertex, and the number of the first. An edge belongs to the voxel at its lower end.
struct BlockVertices {
  std::uint64_t crossed[kWords] = {};
  int first = 0;

  static int bit_of(int voxel, int axis) { return voxel * 3 + axis; }
  bool is_crossed(int bit) const { return (crossed[bit / 64] >> static_cast<unsigned>(bit % 64) & 1U) != 0; }
  /// The vertex on an edge. @pre is_crossed(bit)
  int vertex(int bit) const {
    FOOTHOLD_EXPECTS(is_crossed(bit));
    int before = 0;
    for (int word = 0; word < bit / 64; ++word) before += popcount(crossed[word]);
    return first + before + popcount(crossed[bit / 64] & ((std::uint64_t{1} << static_cast<unsigned>(bit % 64)) - 1));
  }
};

class MeshExtractor {
 public:
  MeshExtractor(const TsdfView& volume, int min_weight) : volume_(volume), reader_(volume), min_weight_(min_weight) {}

  Mesh extract() {
    const auto num_blocks = static_cast<std::size_t>(volume_.num_blocks);
    blocks_.resize(num_blocks);
    for (std::size_t b = 0; b < num_blocks; ++b) place_vertices(static_cast<int>(b));
    for (std::size_t b = 0; b < num_blocks; ++b) add_triangles(static_cast<int>(b));
    drop_unused_vertices();
    estimate_normals();
    return std::move(mesh_);
  }

 private:
  struct Voxel {
    float distance = 0.0F;
    Rgb8 colour;
  };

  bool read(int x, int y, int z, Voxel& voxel) {
    const VoxelBlock* block = reader_.block_of(x, y, z);
    if (block == nullptr) return false;
    const int i = VoxelReader<>::voxel_index(x, y, z);
    if (block->distance[i] == kUnobserved || block->weight[i] < min_weight_) return false;
    voxel = {static_cast<float>(block->distance[i]), {block->red[i], block->green[i], block->blue[i]}};
    return true;
  }

  /// Whether cells with surface may have corners in a block: its own cells, and those of the blocks below it, which reach into it.
  bool is_reached_by_surface(const BlockCoordinates& block) const {
    for (int i = 0; i < 8; ++i) {
      const int index = volume_.find(pack_key({block.x - (i & 1), block.y - (i >> 1 & 1), block.z - (i >> 2)}));
      if (index >= 0 && volume_.surface_octants[index] != 0) return true;
    }
    return false;
  }

  void place_vertices(int index) {
    BlockVertices& vertices = blocks_[static_cast<std::size_t>(index)];
    vertices.first = static_cast<int>(mesh_.vertices.size());
    const BlockCoordinates block = unpack_key(volume_.block_keys[index]);
    if (!is_reached_by_surface(block)) return;
    for (int i = 0; i < kBlockVoxels; ++i) {
      const int x = block.x * kBlockSide + (i & 7);
      const int y = block.y * kBlockSide + (i >> 3 & 7);
      const int z = block.z * kBlockSide + (i >> 6);
      Voxel low;
      if (!read(x, y, z, low)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        Voxel high;
        if (!read(x + (axis == 0), y + (axis == 1), z + (axis == 2), high) || (low.distance < 0.0F) == (high.distance < 0.0F)) continue;
        const int bit = BlockVertices::bit_of(i, axis);
        vertices.crossed[bit / 64] |= std::uint64_t{1} << static_cast<unsigned>(bit % 64);
        add_vertex({x, y, z}, axis, low, high);
      }
    }
  }

  void add_vertex(const BlockCoordinates& voxel, int axis, const Voxel& low, const Voxel& high) {
    const float t = low.distance / (low.distance - high.distance);
    Eigen::Vector3f position(static_cast<float>(voxel.x), static_cast<float>(voxel.y), static_cast<float>(voxel.z));
    position[axis] += t;
    mesh_.vertices.push_back(position * volume_.voxel_size_m);
    const auto is_black = [](const Rgb8& c) { return (c.r | c.g | c.b) == 0; };  // never coloured
    const auto mix = [&](std::uint8_t a, std::uint8_t b) {
      const float weight = is_black(low.colour) ? 1.0F : is_black(high.colour) ? 0.0F : t;
      return static_cast<std::uint8_t>(static_cast<float>(a) + (static_cast<float>(b) - static_cast<float>(a)) * weight + 0.5F);
    };
    mesh_.colours.push_back({mix(low.colour.r, high.colour.r), mix(low.colour.g, high.colour.g), mix(low.colour.b, high.colour.b)});
  }

  void add_triangles(int index) {
    if (volume_.surface_octants[index] == 0) return;
    const std::array<CubeTriangles, 256>& cases = marching_cubes_cases();
    const BlockCoordinates block = unpack_key(volume_.block_keys[index]);
    for (int i = 0; i < kBlockVoxels; ++i) {
      const BlockCoordinates cell{block.x * kBlockSide + (i & 7), block.y * kBlockSide + (i >> 3 & 7), block.z * kBlockSide + (i >> 6)};
      int inside = 0;
      bool observed = true;
      for (int corner = 0; corner < 8 && observed; ++corner) {
        Voxel voxel;
        observed = read(cell.x + (corner & 1), cell.y + (corner >> 1 & 1), cell.z + (corner >> 2), voxel);
        inside |= voxel.distance < 0.0F ? 1 << corner : 0;
      }
      if (!observed || inside == 0 || inside == 255) continue;
      for (const std::array<std::int8_t, 3>& triangle : cases[static_cast<std::size_t>(inside)]) {
        const std::array<int, 3> vertices = {vertex_of(cell, triangle[0]), vertex_of(cell, triangle[1]), vertex_of(cell, triangle[2])};
        mesh_.triangles.push_back(vertices);
      }
    }
  }

  int vertex_of(const BlockCoordinates& cell, int edge) {
    const CubeEdge place = cube_edge(edge);
    const int x = cell.x + (place.corner & 1);
    const int y = cell.y + (place.corner >> 1 & 1);
    const int z = cell.z + (place.corner >> 2);
    const int block = volume_.find(pack_key({x >> 3, y >> 3, z >> 3}));
    return blocks_[static_cast<std::size_t>(block)].vertex(BlockVertices::bit_of(VoxelReader<>::voxel_index(x, y, z), place.axis));
  }

  void drop_unused_vertices() {
    std::vector<int> number(mesh_.vertices.size(), -1);
    for (const std::array<int, 3>& triangle : mesh_.triangles) {
      for (const int vertex : triangle) number[static_cast<std::size_t>(vertex)] = 0;
    }
    std::size_t kept = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<int>(kept);
      mesh_.vertices[kept] = mesh_.vertices[v];
      mesh_.colours[kept] = mesh_.colours[v];
      ++kept;
    }
    mesh_.vertices.resize(kept);
    mesh_.colours.resize(kept);
    for (std::array<int, 3>& triangle : mesh_.triangles) {
      for (int& vertex : triangle) vertex = number[static_cast<std::size_t>(vertex)];
    }
  }

  void estimate_normals() {
    mesh_.normals.assign(mesh_.vertices.size(), Eigen::Vector3f::Zero());
    for (const std::array<int, 3>& triangle : mesh_.triangles) {
      const Eigen::Vector3f& a = mesh_.vertices[static_cast<std::size_t>(triangle[0])];
      const Eigen::Vector3f& b = mesh_.vertices[static_cast<std::size_t>(triangle[1])];
      const Eigen::Vector3f& c = mesh_.vertices[static_cast<std::size_t>(triangle[2])];
      const Eigen::Vector3f normal = (b - a).cross(c - a);
      for (const int vertex : triangle) mesh_.normals[static_cast<std::size_t>(vertex)] += normal;
    }
    for (Eigen::Vector3f& normal : mesh_.normals) {
      const float length = normal.norm();
      normal = length > 0.0F ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
    }
  }

  TsdfView volume_;
  VoxelReader<> reader_;
  int min_weight_;
  std::vector<BlockVertices> blocks_;
  Mesh mesh_;
};

}  // namespace

Mesh extract_mesh(const TsdfVolume& volume, int min_weight) {
  FOOTHOLD_EXPECTS(min_weight >= 1 && min_weight <= 255);
  if (volume.context().device() != Device::kCpu) return extract_mesh(TsdfVolume(volume, Context()), min_weight);
  return MeshExtractor(volume.view(), min_weight).extract();
}

}  // namespace foothold
