// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Views of images: rows without padding, first row at the top, centre of the first pixel at (0, 0).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/platform.h"

namespace foothold {

/// One colour pixel, 8 bits per channel.
struct Rgb8 {
  std::uint8_t r = 0;  ///< red
  std::uint8_t g = 0;  ///< green
  std::uint8_t b = 0;  ///< blue
};
static_assert(sizeof(Rgb8) == 3, "images of Rgb8 are read as interleaved bytes");

/// A non-owning view of a dense image.
template <class T>
struct ImageView {
  T* data = nullptr;  ///< the first pixel of the first row
  int width = 0;      ///< columns
  int height = 0;     ///< rows
  Memory memory;      ///< where the pixels lie

  /// Whether there are no pixels.
  FOOTHOLD_HD bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  /// The number of pixels.
  FOOTHOLD_HD std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  /// Whether there is a pixel in column u and row v.
  FOOTHOLD_HD bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width && v < height; }
  /// The pixel in column u and row v. Never checks bounds.
  FOOTHOLD_HD T& operator()(int u, int v) const {
    return data[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  }
  /// Adds const.
  template <class U, class = std::enable_if_t<std::is_same_v<const T, U> && !std::is_same_v<T, U>>>
  FOOTHOLD_HD operator ImageView<U>() const {  // NOLINT(google-explicit-constructor)
    return {data, width, height, memory};
  }
};

/// A non-owning view of an interleaved colour image: R, G and B are the first three bytes of each pixel, whose size is 3 (RGB) or 4 (RGBA).
struct ColourView {
  const std::uint8_t* data = nullptr;  ///< the first byte of the first row
  int width = 0;                       ///< columns
  int height = 0;                      ///< rows
  int bytes_per_pixel = 3;             ///< 3 (RGB) or 4 (RGBA)
  Memory memory;                       ///< where the pixels lie

  /// Whether there are no pixels.
  FOOTHOLD_HD bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  /// The pixel in column u and row v. Never checks bounds.
  FOOTHOLD_HD Rgb8 operator()(int u, int v) const {
    const std::uint8_t* pixel = data + (static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)) *
                                           static_cast<std::size_t>(bytes_per_pixel);
    return {pixel[0], pixel[1], pixel[2]};
  }
};

/// An owning dense image in host memory.
template <class T>
class Image {
 public:
  Image() = default;
  /// @pre width and height are not negative.
  Image(int width, int height, const T& value = T{}) : width_(width), height_(height) {
    FOOTHOLD_EXPECTS(width >= 0 && height >= 0);
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value);
  }

  /// Columns.
  int width() const { return width_; }
  /// Rows.
  int height() const { return height_; }
  /// Whether there are no pixels.
  bool empty() const { return pixels_.empty(); }
  /// The number of pixels.
  std::size_t size() const { return pixels_.size(); }
  /// The first pixel of the first row.
  T* data() { return pixels_.data(); }
  /// The first pixel of the first row.
  const T* data() const { return pixels_.data(); }
  /// The pixel in column u and row v. Never checks bounds.
  T& operator()(int u, int v) { return pixels_[index(u, v)]; }
  /// The pixel in column u and row v. Never checks bounds.
  const T& operator()(int u, int v) const { return pixels_[index(u, v)]; }
  /// A view of these pixels, which must outlive it.
  ImageView<T> view() { return {data(), width_, height_, MemoryKind::kHost}; }
  /// A view of these pixels, which must outlive it.
  ImageView<const T> view() const { return {data(), width_, height_, MemoryKind::kHost}; }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

/// Views an owned RGB image as colour.
inline ColourView colour_view(const Image<Rgb8>& image) {
  return {reinterpret_cast<const std::uint8_t*>(image.data()), image.width(), image.height(), 3, MemoryKind::kHost};
}

}  // namespace foothold
