// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A non-owning view of contiguous elements, usable in host and device code.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "foothold/base/platform.h"

namespace foothold {

template <class T>
class Span;

namespace detail {
template <class T>
inline constexpr bool kIsSpan = false;
template <class T>
inline constexpr bool kIsSpan<Span<T>> = true;
}  // namespace detail

/// Points at `size` elements that somebody else owns; std::span's essentials for C++17 and CUDA. Never checks bounds.
template <class T>
class Span {
 public:
  Span() = default;
  /// Looks at `size` elements from `data` on.
  FOOTHOLD_HD Span(T* data, std::size_t size) : data_(data), size_(size) {}

  /// Views any contiguous container with data() and size(), such as std::vector or Array.
  template <class Container, class = std::enable_if_t<!detail::kIsSpan<std::decay_t<Container>> &&
                                                      std::is_convertible_v<decltype(std::declval<Container&>().data()), T*>>>
  Span(Container&& container) : data_(container.data()), size_(container.size()) {}  // NOLINT(google-explicit-constructor)

  /// Adds const.
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
  FOOTHOLD_HD Span(const Span<U>& other) : data_(other.data()), size_(other.size()) {}  // NOLINT(google-explicit-constructor)

  /// The first element.
  FOOTHOLD_HD T* data() const { return data_; }
  /// The number of elements.
  FOOTHOLD_HD std::size_t size() const { return size_; }
  /// Whether there are no elements.
  FOOTHOLD_HD bool empty() const { return size_ == 0; }
  /// Element i. Never checks bounds.
  FOOTHOLD_HD T& operator[](std::size_t i) const { return data_[i]; }
  /// The first element.
  FOOTHOLD_HD T* begin() const { return data_; }
  /// Behind the last element.
  FOOTHOLD_HD T* end() const { return data_ + size_; }
  FOOTHOLD_HD Span subspan(std::size_t offset, std::size_t count) const {
    return {data_ + offset, count};
  }  ///< `count` elements from element `offset` on. Never checks bounds.

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace foothold
