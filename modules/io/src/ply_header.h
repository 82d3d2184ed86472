// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The text at the beginning of a PLY file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace foothold::io {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t size_of(PlyType type);

/// One property of an element; a list if it has a type for its count.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;
};

/// A table of equal records.
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::vector<PlyElement> elements;
  std::size_t num_bytes = 0;  ///< up to and including the end of the line end_header
};

/// Parses the header of a binary little-endian file. @throws FileError
PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace foothold::io
