// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// An owning, growing buffer in host or CUDA memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "foothold/base/contract.h"
#include "foothold/base/platform.h"
#include "foothold/base/span.h"

namespace foothold {

class Context;

namespace detail {
void read_memory(const Context& context, void* host, const void* device, std::size_t num_bytes);
struct MemoryRead;
void read_memory(const Context& context, Span<const MemoryRead> reads);
void write_memory(const Context& context, void* device, const void* host, std::size_t num_bytes);
/// Returns 64-byte aligned memory. @throws CudaError, std::bad_alloc, or DeviceError in a build without CUDA.
void* allocate_memory(const Memory& memory, std::size_t num_bytes);
/// Frees what allocate_memory() returned; never throws.
void free_memory(const Memory& memory, void* pointer) noexcept;
/// Copies between any two places, once the devices there have done all that they were asked for, and waits: not for use within a frame.
void copy_memory(const Memory& to_memory, void* to, const Memory& from_memory, const void* from, std::size_t num_bytes);
/// Sets every byte to zero.
void clear_memory(const Memory& memory, void* pointer, std::size_t num_bytes);

/// A copy from the memory of a context's device to the host.
struct MemoryRead {
  void* host;
  const void* device;
  std::size_t num_bytes;
};
}  // namespace detail

/// A growing buffer of elements that may be copied as bytes, whose place is fixed at construction.
///
/// resize() keeps the contents and never gives memory back, so a buffer that is reused from frame to frame soon stops allocating.
/// New elements are uninitialised unless stated. Not thread-safe.
template <class T>
class Array {
  // Elements are moved as bytes. Eigen's fixed-size matrices allow it without being formally trivially copyable.
  static_assert(std::is_trivially_destructible_v<T>, "Array moves its elements as bytes");

 public:
  /// An empty array in the given place.
  explicit Array(const Memory& memory = {}) : memory_(memory) {}
  /// Elements in the given place, with undefined values.
  // Delegating, so that the destructor frees what was allocated before an exception.
  Array(const Memory& memory, std::size_t size) : Array(memory) { resize(size); }
  /// Copies host elements to the given place.
  Array(const Memory& memory, Span<const T> host) : Array(memory) { assign(host); }

  /// Copies the elements, in the same place.
  Array(const Array& other) : Array(other.memory_) { copy_from(other); }
  /// Takes over the elements; the other array is empty then.
  Array(Array&& other) noexcept { swap(other); }
  /// Copies or takes over the elements and the place.
  Array& operator=(Array other) noexcept {
    swap(other);
    return *this;
  }
  ~Array() { detail::free_memory(memory_, data_); }

  /// Exchanges elements and places.
  void swap(Array& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  /// The place of the elements.
  const Memory& memory() const { return memory_; }
  /// The number of elements.
  std::size_t size() const { return size_; }
  /// Whether there are no elements.
  bool empty() const { return size_ == 0; }
  /// Memory held, in bytes; at least size() elements.
  std::size_t num_bytes() const { return capacity_ * sizeof(T); }
  /// The first element, in memory(); may be null where the array is empty.
  T* data() { return data_; }
  /// The first element, in memory(); may be null where the array is empty.
  const T* data() const { return data_; }
  /// Element i of an array in host memory. Never checks bounds.
  T& operator[](std::size_t i) { return data_[i]; }
  /// Element i of an array in host memory. Never checks bounds.
  const T& operator[](std::size_t i) const { return data_[i]; }
  /// The first element.
  T* begin() { return data_; }
  /// Behind the last element.
  T* end() { return data_ + size_; }
  /// The first element.
  const T* begin() const { return data_; }
  /// Behind the last element.
  const T* end() const { return data_ + size_; }

  /// Makes room for `capacity` elements, exactly, keeping the contents.
  void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    Array larger(memory_);
    larger.data_ = static_cast<T*>(detail::allocate_memory(memory_, capacity * sizeof(T)));
    larger.capacity_ = capacity;
    larger.size_ = size_;
    if (size_ != 0) detail::copy_memory(memory_, larger.data_, memory_, data_, size_ * sizeof(T));
    swap(larger);
  }
  /// Sets the size, keeping the first elements; grows by at least a quarter when it must grow.
  void resize(std::size_t size) {
    if (size > capacity_) reserve(std::max(size, capacity_ + capacity_ / 4));
    size_ = size;
  }
  /// Sets every byte of the contents to zero.
  void clear_to_zero() {
    if (size_ != 0) detail::clear_memory(memory_, data_, size_ * sizeof(T));
  }
  /// Replaces the contents by a copy of host elements.
  void assign(Span<const T> host) {
    resize(host.size());
    if (size_ != 0) detail::copy_memory(memory_, data_, MemoryKind::kHost, host.data(), size_ * sizeof(T));
  }
  /// Returns a copy of the contents in host memory.
  std::vector<T> to_host() const {
    std::vector<T> host(size_);
    if (size_ != 0) detail::copy_memory(MemoryKind::kHost, host.data(), memory_, data_, size_ * sizeof(T));
    return host;
  }
  /// The same two in the order of a context's stream, which alone they wait for: for use within a frame.
  /// @pre memory() is the context's.
  void assign(const Context& context, Span<const T> host) {
    resize(host.size());
    if (size_ != 0) detail::write_memory(context, data_, host.data(), size_ * sizeof(T));
  }
  /// A copy on the host; waits for the device.
  std::vector<T> to_host(const Context& context) const {
    std::vector<T> host(size_);
    if (size_ != 0) detail::read_memory(context, host.data(), data_, size_ * sizeof(T));
    return host;
  }
  /// One element, likewise.
  T read(const Context& context, std::size_t i) const {
    T value;
    detail::read_memory(context, &value, data_ + i, sizeof(T));
    return value;
  }

 private:
  void copy_from(const Array& other) {
    resize(other.size_);
    if (size_ != 0) detail::copy_memory(memory_, data_, other.memory_, other.data_, size_ * sizeof(T));
  }

  Memory memory_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// Copies of several arrays to the host that wait for the device once between them.
class HostReads {
 public:
  /// Sizes `to` at once and has it filled by wait(); neither may change until then.
  template <class T>
  void add(const Array<T>& from, std::vector<T>& to) {
    to.resize(from.size());
    if (!from.empty()) reads_.push_back({to.data(), from.data(), from.size() * sizeof(T)});
  }
  /// Copies what was added, in the order of the context's stream. @pre The arrays live in the context's memory.
  void wait(const Context& context) {
    if (!reads_.empty()) detail::read_memory(context, Span<const detail::MemoryRead>(reads_));
    reads_.clear();
  }

 private:
  std::vector<detail::MemoryRead> reads_;
};

}  // namespace foothold
