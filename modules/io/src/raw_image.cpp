// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "raw_image.h"

#include <zlib.h>

#include <cstring>
#include <fstream>

#include "image_decoding.h"
#include "text_file.h"

namespace foothold::io {
namespace {

/// The bytes of an image's pixels, inflated if need be.
std::string pixel_bytes(const std::string& bytes, const StoredImage& stored, const ImageSize& size, std::size_t bytes_per_pixel) {
  const std::size_t expected = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * bytes_per_pixel;
  std::string pixels = stored.coding == ImageCoding::kZlibRaw ? inflate(bytes, expected) : bytes;
  if (pixels.size() == expected) return pixels;
  throw_file_error(stored.file, "a damaged image at byte " + std::to_string(stored.offset),
                   std::to_string(expected) + " bytes for " + to_string(size) + " pixels");
}

}  // namespace

std::string inflate(std::string_view bytes, std::size_t num_bytes) {
  std::string result(num_bytes, '\0');
  auto length = static_cast<uLongf>(num_bytes);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(result.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
                                  static_cast<uLong>(bytes.size()));
  return status == Z_OK && length == num_bytes ? result : std::string();
}

Image<std::uint16_t> decode_raw_depth(const std::string& bytes, const StoredImage& stored, const ImageSize& size) {
  const std::string pixels = pixel_bytes(bytes, stored, size, sizeof(std::uint16_t));
  Image<std::uint16_t> image(size.width, size.height);
  std::memcpy(image.data(), pixels.data(), pixels.size());
  return image;
}

Image<Rgb8> decode_raw_colour(const std::string& bytes, const StoredImage& stored, const ImageSize& size) {
  const std::string pixels = pixel_bytes(bytes, stored, size, sizeof(Rgb8));
  Image<Rgb8> image(size.width, size.height);
  std::memcpy(static_cast<void*>(image.data()), pixels.data(), pixels.size());
  return image;
}

std::string read_stored_image(const StoredImage& image) {
  if (image.num_bytes == 0) return read_file(image.file, kMaxImageBytes);
  std::ifstream stream(image.file, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(image.num_bytes), '\0');
  stream.seekg(static_cast<std::streamoff>(image.offset));
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw FileError(image.file.string() + ": cannot be read at byte " + std::to_string(image.offset));
  }
  return bytes;
}

}  // namespace foothold::io
