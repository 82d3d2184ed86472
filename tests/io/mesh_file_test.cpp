// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "mesh_file.h"

#include <cstring>

#include "foothold/base/error.h"
#include "io_fixtures.h"
#include "support/catch.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

using namespace test;
using Catch::Matchers::Contains;

Mesh random_mesh(bool with_normals, bool with_colours) {
  Random random = test_random();
  Mesh mesh;
  const auto vector = [&] { return Eigen::Vector3f(random.uniform(-9.0F, 9.0F), random.uniform(), random.uniform()); };
  const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  const auto corner = [&] { return static_cast<int>(random.below(7000)); };
  for (int i = 0; i < 7000; ++i) {
    mesh.vertices.push_back(vector());
    if (with_normals) mesh.normals.push_back(vector().normalized());
    if (with_colours) mesh.colours.push_back({byte(), byte(), byte()});
  }
  for (int i = 0; i < 9000; ++i) mesh.triangles.push_back({corner(), corner(), corner()});
  return mesh;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void append_floats(std::string& bytes, const std::vector<float>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

}  // namespace

TEST_CASE("write_ply: a mesh reads back exactly, with or without normals and colours") {
  const TempFolder temp;
  const Mesh mesh = random_mesh(GENERATE(true, false), GENERATE(true, false));
  write_ply(temp / "m.ply", mesh);
  const Mesh read = read_ply(temp / "m.ply");
  CHECK(same_bytes(read.vertices, mesh.vertices));
  CHECK(same_bytes(read.normals, mesh.normals));
  CHECK(same_bytes(read.colours, mesh.colours));
  CHECK(read.triangles == mesh.triangles);
}

TEST_CASE("write_ply: an empty mesh is a valid file") {
  const TempFolder temp;
  write_ply(temp / "m.ply", Mesh());
  CHECK(read_ply(temp / "m.ply").vertices.empty());
}

TEST_CASE("write_ply: a triangle of a missing vertex is a bug, and leaves no file") {
  const TempFolder temp;
  Mesh mesh = random_mesh(false, false);
  mesh.triangles.push_back({0, 1, 7000});
  CHECK_THROWS_AS(write_ply(temp / "m.ply", mesh), ContractViolation);
  mesh.triangles.back() = {-1, 0, 1};
  CHECK_THROWS_AS(write_ply(temp / "m.ply", mesh), ContractViolation);
  CHECK(temp.num_files() == 0);
}

TEST_CASE("parse_ply: skips what it does not know, in any order") {
  std::string bytes =
      "ply\r\nformat binary_little_endian 1.0\r\nobj_info x\r\nelement camera 1\r\nproperty list ushort double k\r\nelement vertex 1\r\n"
      "property float z\r\nproperty short quality\r\nproperty float x\r\nproperty float y\r\nend_header\r\n";
  bytes += std::string("\x02\x00", 2) + std::string(16, 'x');
  append_floats(bytes, {3.0F});
  bytes += "qq";
  append_floats(bytes, {1.0F, 2.0F});
  const Mesh mesh = io::parse_ply(bytes, "m.ply");
  REQUIRE(mesh.vertices.size() == 1);
  CHECK(mesh.vertices[0] == Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  CHECK(mesh.normals.empty());
}

TEST_CASE("parse_ply: a bad file is named, with the reason") {
  const auto error = [](const std::string& bytes) { return error_of([&] { io::parse_ply(bytes, "m.ply"); }); };
  const std::string format = "ply\nformat binary_little_endian 1.0\n";
  const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
  CHECK_THAT(error(""), Contains("m.ply") && Contains("a PLY file"));
  CHECK_THAT(error("solid cube\n"), Contains("'solid cu'"));
  CHECK_THAT(error("ply\nformat ascii 1.0\nend_header\n"), Contains("'ascii'"));
  CHECK_THAT(error("ply\nend_header\n"), Contains("without format"));
  CHECK_THAT(error(format + "element vertex 3\n"), Contains("without end"));
  CHECK_THAT(error(format + "element vertex -3\nend_header\n"), Contains("'-3'"));
  CHECK_THAT(error(format + "property float x\nend_header\n"), Contains("before the first element"));
  CHECK_THAT(error(format + "element vertex 1\nproperty half x\nend_header\n"), Contains("'half'"));
  CHECK_THAT(error(format + "element vertex 1\n" + vertex + "end_header\n1234"), Contains("cut short"));
  CHECK_THAT(error(format + "element vertex 99999999999999\n" + vertex + "end_header\n"), Contains("99999999999999"));
  CHECK_THAT(error(format + "element vertex 5\nend_header\n"), Contains("5 records of at least 0 bytes"));
  CHECK_THAT(error(format + "element vertex 1\nproperty float x\nend_header\n1234"), Contains("without x, y or z"));

  std::string bytes = format + "element vertex 1\n" + vertex + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  append_floats(bytes, {1.0F, 2.0F, 3.0F});
  CHECK_THAT(error(bytes + std::string("\x04\0\0\0\0", 5)), Contains("face 0 of 4 corners"));
  CHECK_THAT(error(bytes + std::string("\x03\0\0\0\0\0\0\0\0\x01\0\0\0", 13)), Contains("face 0 with vertex 1"));
  CHECK_THAT(error(bytes + std::string("\x03\0\0\0\0\0\0", 7)), Contains("cut short"));
  append_floats(bytes, {});
}

}  // namespace foothold
