// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "foothold/base/atomic_file.h"
#include "foothold/base/contract.h"
#include "ply_header.h"
#include "text_file.h"

namespace foothold {
namespace io {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "PLY files are read and written as they lie in memory");

/// Takes numbers off the front of the file's body.
class Reader {
 public:
  Reader(std::string_view bytes, const std::filesystem::path& file) : bytes_(bytes), file_(file) {}

  double number(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return take<std::int8_t>();
      case PlyType::kUint8:
        return take<std::uint8_t>();
      case PlyType::kInt16:
        return take<std::int16_t>();
      case PlyType::kUint16:
        return take<std::uint16_t>();
      case PlyType::kInt32:
        return take<std::int32_t>();
      case PlyType::kUint32:
        return take<std::uint32_t>();
      case PlyType::kFloat32:
        return static_cast<double>(take<float>());
      case PlyType::kFloat64:
        break;
    }
    return take<double>();
  }
  void skip(std::size_t num_bytes) {
    need(num_bytes);
    bytes_.remove_prefix(num_bytes);
  }
  std::size_t bytes_left() const { return bytes_.size(); }
  const std::filesystem::path& file() const { return file_; }

 private:
  void need(std::size_t num_bytes) const {
    if (bytes_.size() < num_bytes) throw_file_error(file_, "a file cut short", "all elements that the header announces");
  }
  template <class T>
  T take() {
    need(sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return value;
  }

  std::string_view bytes_;
  const std::filesystem::path& file_;
};

/// Reads a list's count. A negative one does not survive.
std::size_t read_count(Reader& reader, PlyType type) {
  const double count = reader.number(type);
  if (count < 0.0) throw_file_error(reader.file(), "a list of " + std::to_string(static_cast<long long>(count)) + " entries", "0 or more");
  return static_cast<std::size_t>(count);
}

void skip_property(Reader& reader, const PlyProperty& property) {
  const std::size_t count = property.is_list ? read_count(reader, property.count_type) : 1;
  reader.skip(count * size_of(property.type));
}

/// Every record takes at least this many bytes: a bound on how many there can be, before memory is set aside for them.
std::size_t min_record_bytes(const PlyElement& element) {
  std::size_t num_bytes = 0;
  for (const PlyProperty& property : element.properties) num_bytes += size_of(property.is_list ? property.count_type : property.type);
  return num_bytes;
}

/// Where a vertex property belongs: x y z, nx ny nz, red green blue, or nowhere (-1).
int vertex_slot(const PlyProperty& property) {
  constexpr std::array<const char*, 9> kSlots{"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"};
  const auto found = std::find(kSlots.begin(), kSlots.end(), property.name);
  if (found == kSlots.end() || property.is_list) return -1;
  const int slot = static_cast<int>(found - kSlots.begin());
  return slot >= 6 && property.type != PlyType::kUint8 ? -1 : slot;
}

void read_vertices(Reader& reader, const PlyElement& element, Mesh& mesh) {
  std::array<bool, 9> present{};
  std::vector<int> slots;
  for (const PlyProperty& property : element.properties) {
    slots.push_back(vertex_slot(property));
    if (slots.back() >= 0) present[static_cast<std::size_t>(slots.back())] = true;
  }
  if (!present[0] || !present[1] || !present[2]) throw_file_error(reader.file(), "vertices without x, y or z", "all three");
  const bool has_normals = present[3] && present[4] && present[5];
  const bool has_colours = present[6] && present[7] && present[8];
  std::array<double, 9> values{};
  for (std::size_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < slots.size(); ++p) {
      if (slots[p] < 0) {
        skip_property(reader, element.properties[p]);
      } else {
        values[static_cast<std::size_t>(slots[p])] = reader.number(element.properties[p].type);
      }
    }
    const auto vector = [&](std::size_t k) { return Eigen::Vector3d(values[k], values[k + 1], values[k + 2]).cast<float>().eval(); };
    mesh.vertices.push_back(vector(0));
    if (!mesh.vertices.back().allFinite()) throw_file_error(reader.file(), "vertex " + std::to_string(i) + " that is not finite", "metres");
    if (has_normals) mesh.normals.push_back(vector(3));
    const auto channel = [&](std::size_t k) { return static_cast<std::uint8_t>(values[k]); };
    if (has_colours) mesh.colours.push_back({channel(6), channel(7), channel(8)});
  }
}

bool holds_indices(const PlyProperty& property) { return property.name == "vertex_indices" || property.name == "vertex_index"; }

std::array<int, 3> read_triangle(Reader& reader, const PlyProperty& property, std::size_t face, std::size_t num_vertices) {
  const std::string name = "face " + std::to_string(face);
  const std::size_t count = property.is_list ? read_count(reader, property.count_type) : 1;
  if (count != 3) throw_file_error(reader.file(), name + " of " + std::to_string(count) + " corners", "triangles");
  std::array<int, 3> triangle{};
  for (int& corner : triangle) {
    const auto index = static_cast<long long>(reader.number(property.type));
    if (index < 0 || index >= static_cast<long long>(num_vertices)) {
      throw_file_error(reader.file(), name + " with vertex " + std::to_string(index),
                       "an index below the number of vertices before it, " + std::to_string(num_vertices));
    }
    corner = static_cast<int>(index);
  }
  return triangle;
}

void read_triangles(Reader& reader, const PlyElement& element, Mesh& mesh) {
  const auto indices = std::find_if(element.properties.begin(), element.properties.end(), holds_indices);
  if (indices == element.properties.end() || indices->type == PlyType::kFloat32 || indices->type == PlyType::kFloat64) {
    throw_file_error(reader.file(), "faces without integer indices", "property list uchar int vertex_indices");
  }
  for (std::size_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      if (&property == &*indices) {
        mesh.triangles.push_back(read_triangle(reader, property, i, mesh.vertices.size()));
      } else {
        skip_property(reader, property);
      }
    }
  }
}

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void append(std::string& bytes, const Eigen::Vector3f& value) {
  bytes.append(reinterpret_cast<const char*>(value.data()), 3 * sizeof(float));
}

std::string ply_header(const Mesh& mesh) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment Foothold; metres\nelement vertex " +
                       std::to_string(mesh.vertices.size()) + "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.normals.empty()) header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.colours.empty()) header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  return header + "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

Mesh parse_ply(std::string_view bytes, const std::filesystem::path& file) {
  const PlyHeader header = parse_ply_header(bytes, file);
  Reader reader(bytes.substr(header.num_bytes), file);
  Mesh mesh;
  for (const PlyElement& element : header.elements) {
    const std::size_t record_bytes = min_record_bytes(element);
    if (record_bytes == 0 ? element.count > 0 : element.count > reader.bytes_left() / record_bytes) {
      throw_file_error(
          file, std::to_string(reader.bytes_left()) + " bytes for the element " + in_quotes(element.name),
          std::to_string(element.count) + " records of at least " + std::to_string(record_bytes) + " bytes: the file was cut short");
    }
    if (element.name == "vertex" && mesh.vertices.empty()) {
      read_vertices(reader, element, mesh);
    } else if (element.name == "face" && mesh.triangles.empty()) {
      read_triangles(reader, element, mesh);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) skip_property(reader, property);
      }
    }
  }
  return mesh;
}

}  // namespace io

void write_ply(const std::string& path, const Mesh& mesh) {
  const std::size_t num_vertices = mesh.vertices.size();
  FOOTHOLD_EXPECTS(mesh.normals.empty() || mesh.normals.size() == num_vertices);
  FOOTHOLD_EXPECTS(mesh.colours.empty() || mesh.colours.size() == num_vertices);
  AtomicFile file(path);
  std::string bytes = io::ply_header(mesh);
  constexpr std::size_t kBlockBytes = 1U << 16U;
  const auto flush_above = [&](std::size_t limit) {
    if (bytes.size() <= limit) return;
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  };
  for (std::size_t i = 0; i < num_vertices; ++i) {
    io::append(bytes, mesh.vertices[i]);
    if (!mesh.normals.empty()) io::append(bytes, mesh.normals[i]);
    if (!mesh.colours.empty()) io::append(bytes, mesh.colours[i]);
    flush_above(kBlockBytes);
  }
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    for (const int corner : triangle) FOOTHOLD_EXPECTS(corner >= 0 && static_cast<std::size_t>(corner) < num_vertices);
    io::append(bytes, std::uint8_t{3});
    io::append(bytes, triangle);
    flush_above(kBlockBytes);
  }
  flush_above(0);
  file.commit();
}

Mesh read_ply(const std::string& path) {
  constexpr std::size_t kMaxMeshBytes = std::size_t{4} << 30U;
  return io::parse_ply(read_file(path, kMaxMeshBytes), path);
}

}  // namespace foothold
