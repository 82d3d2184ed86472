// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/array.h"

#include <cstdint>
#include <vector>

#include "support/catch.h"

namespace foothold {
namespace {

TEST_CASE("Array: grows and shrinks with its contents kept and its memory held") {
  Array<int> array;
  REQUIRE(array.empty());
  REQUIRE(array.num_bytes() == 0);
  for (int i = 0; i < 1000; ++i) {
    array.resize(static_cast<std::size_t>(i) + 1);
    array[static_cast<std::size_t>(i)] = i;
  }
  for (int i = 0; i < 1000; ++i) REQUIRE(array[static_cast<std::size_t>(i)] == i);
  const std::size_t held = array.num_bytes();
  const int* data = array.data();
  REQUIRE(held >= 1000 * sizeof(int));
  array.resize(3);
  REQUIRE(array.size() == 3);
  array.resize(1000);
  REQUIRE(array.num_bytes() == held);
  REQUIRE(array.data() == data);
}

TEST_CASE("Array: grows by a quarter at least, reserves exactly") {
  Array<char> array(MemoryKind::kHost, 1000);
  array.resize(1001);
  REQUIRE(array.num_bytes() == 1250);
  array.reserve(5000);
  REQUIRE(array.num_bytes() == 5000);
  REQUIRE(array.size() == 1001);
  array.reserve(10);
  REQUIRE(array.num_bytes() == 5000);
}

TEST_CASE("Array: is aligned to cache lines") {
  for (const std::size_t size : {1, 7, 64, 1000}) {
    const Array<char> array(MemoryKind::kHost, size);
    REQUIRE(reinterpret_cast<std::uintptr_t>(array.data()) % 64 == 0);
  }
}

TEST_CASE("Array: copies are independent, moves leave nothing behind") {
  const std::vector<int> values = {3, 1, 4, 1, 5};
  Array<int> original(MemoryKind::kHost, values);
  Array<int> copy = original;
  copy[0] = 9;
  REQUIRE(original.to_host() == values);
  REQUIRE(copy[0] == 9);

  Array<int> moved = std::move(copy);
  REQUIRE(moved[0] == 9);
  REQUIRE(moved.size() == 5);

  original = moved;
  REQUIRE(original.to_host() == moved.to_host());
  original = std::move(moved);
  REQUIRE(original[0] == 9);
  original.swap(original);
  REQUIRE(original.size() == 5);
}

TEST_CASE("Array: assigns, clears and copies to the host") {
  Array<float> array(MemoryKind::kHost, 100);
  array.clear_to_zero();
  for (const float value : array) REQUIRE(value == 0.0F);
  const std::vector<float> values = {1.0F, 2.0F};
  array.assign(values);
  REQUIRE(array.to_host() == values);
  array.assign(Span<const float>());
  REQUIRE(array.empty());
  REQUIRE(array.to_host().empty());
}

TEST_CASE("Span: views containers and parts of them") {
  std::vector<int> values = {0, 1, 2, 3, 4};
  const Span<int> span(values);
  const Span<const int> part = span.subspan(1, 3);
  REQUIRE(part.size() == 3);
  REQUIRE(part[0] == 1);
  span[1] = 7;
  REQUIRE(part[0] == 7);
  int sum = 0;
  for (const int value : part) sum += value;
  REQUIRE(sum == 12);
  REQUIRE(Span<int>().empty());
}

}  // namespace
}  // namespace foothold
