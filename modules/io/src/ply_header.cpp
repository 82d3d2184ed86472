// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "ply_header.h"

#include <array>
#include <charconv>

#include "text_file.h"

namespace foothold::io {
namespace {

struct TypeName {
  const char* name;
  PlyType type;
};
constexpr std::array<TypeName, 16> kTypeNames{{{"char", PlyType::kInt8},
                                               {"int8", PlyType::kInt8},
                                               {"uchar", PlyType::kUint8},
                                               {"uint8", PlyType::kUint8},
                                               {"short", PlyType::kInt16},
                                               {"int16", PlyType::kInt16},
                                               {"ushort", PlyType::kUint16},
                                               {"uint16", PlyType::kUint16},
                                               {"int", PlyType::kInt32},
                                               {"int32", PlyType::kInt32},
                                               {"uint", PlyType::kUint32},
                                               {"uint32", PlyType::kUint32},
                                               {"float", PlyType::kFloat32},
                                               {"float32", PlyType::kFloat32},
                                               {"double", PlyType::kFloat64},
                                               {"float64", PlyType::kFloat64}}};

PlyType parse_type(std::string_view word, const std::filesystem::path& file) {
  for (const TypeName& known : kTypeNames) {
    if (word == known.name) return known.type;
  }
  throw_file_error(file, "property type " + in_quotes(word), "char, uchar, short, ushort, int, uint, float or double");
}

PlyProperty parse_property(const std::vector<std::string_view>& words, const std::filesystem::path& file) {
  const bool is_list = words.size() == 5 && words[1] == "list";
  if (!is_list && words.size() != 3) {
    throw_file_error(file, "a property of " + std::to_string(words.size()) + " words", "property TYPE NAME");
  }
  PlyProperty property{std::string(words.back()), parse_type(words[words.size() - 2], file), is_list, PlyType::kUint8};
  if (is_list) property.count_type = parse_type(words[2], file);
  if (is_list && (property.count_type == PlyType::kFloat32 || property.count_type == PlyType::kFloat64)) {
    throw_file_error(file, "a list counted in " + in_quotes(words[2]), "an integer type");
  }
  return property;
}

PlyElement parse_element(const std::vector<std::string_view>& words, const std::filesystem::path& file) {
  PlyElement element;
  const std::string_view digits = words.size() == 3 ? words[2] : std::string_view();
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), element.count);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) {
    throw_file_error(file, "element count " + in_quotes(digits), "element NAME COUNT");
  }
  element.name = words[1];
  return element;
}

void check_format(const std::vector<std::string_view>& words, const std::filesystem::path& file) {
  if (words.size() == 3 && words[1] == "binary_little_endian" && words[2] == "1.0") return;
  throw_file_error(file, "PLY format " + in_quotes(words.size() > 1 ? words[1] : ""), "binary_little_endian 1.0");
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kFloat64:
      return 8;
    default:
      return 4;
  }
}

PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file) {
  constexpr std::size_t kMaxHeaderBytes = 1U << 16U;
  if (bytes.substr(0, 3) != "ply") throw_file_error(file, "a file that begins with " + in_quotes(bytes.substr(0, 8)), "a PLY file");
  PlyHeader header;
  bool has_format = false;
  const std::string_view text = bytes.substr(0, kMaxHeaderBytes);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) break;
    const std::vector<std::string_view> words = split_words(text.substr(begin, end - begin));
    begin = end + 1;
    const std::string_view keyword = words.empty() ? std::string_view() : words.front();
    if (keyword == "format") {
      check_format(words, file);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(words, file));
    } else if (keyword == "property") {
      if (header.elements.empty()) throw_file_error(file, "a property before the first element", "element NAME COUNT");
      header.elements.back().properties.push_back(parse_property(words, file));
    } else if (keyword == "end_header") {
      if (!has_format) throw_file_error(file, "a header without format", "format binary_little_endian 1.0");
      header.num_bytes = begin;
      return header;
    } else if (keyword != "ply" && keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      throw_file_error(file, in_quotes(keyword) + " in the header", "format, element, property, comment or end_header");
    }
  }
  throw_file_error(file, "a header without end", "end_header within its first " + std::to_string(kMaxHeaderBytes) + " bytes");
}

}  // namespace foothold::io
