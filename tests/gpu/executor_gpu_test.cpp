// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The CUDA executor's verbs, memory and streams against the standard library.
#include <algorithm>
#include <numeric>
#include <vector>

#include "foothold/base/array.h"
#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "foothold/frames/colour_registration.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/frames/register_colour.h"
#include "gpu/device.h"
#include "gpu/executor_verbs.h"
#include "support/catch.h"
#include "support/error_message.h"
#include "support/random_seed.h"

namespace foothold {
namespace {

/// Below, at and above the size of a block of threads.
const std::vector<std::size_t> kSizes = {0, 1, 127, 128, 129, 5000};

TEST_CASE("CudaExecutor::for_each: visits every index once") {
  const Context context = test::context_on(Device::kCuda);
  for (const std::size_t size : kSizes) {
    const std::vector<std::uint32_t> values = test::run_for_each(context, size);
    for (std::size_t i = 0; i < size; ++i) REQUIRE(values[i] == static_cast<std::uint32_t>(i * i));
  }
}

TEST_CASE("CudaExecutor::for_each_team: lanes share memory and reduce") {
  const Context context = test::context_on(Device::kCuda);
  for (const int values_per_item : {1, 5, 128, 1000}) {
    constexpr int kItems = 37;
    const test::TeamResults results = test::run_team_verbs(context, kItems, values_per_item);
    for (int item = 0; item < kItems; ++item) {
      std::vector<int> values;
      for (int k = 0; k < values_per_item; ++k) values.push_back(test::team_value(item, k));
      const auto i = static_cast<std::size_t>(item);
      REQUIRE(results.sums[i] == std::accumulate(values.begin(), values.end(), 0));
      REQUIRE(results.lowest[i] == *std::min_element(values.begin(), values.end()));
      REQUIRE(results.highest[i] == *std::max_element(values.begin(), values.end()));
      REQUIRE(results.counted[i] == values_per_item);
      // Integers this small add up exactly in any order.
      REQUIRE(results.arrays[3 * i] == static_cast<float>(results.sums[i]));
      REQUIRE(results.arrays[3 * i + 1] == static_cast<float>(std::inner_product(values.begin(), values.end(), values.begin(), 0)));
      REQUIRE(results.arrays[3 * i + 2] == static_cast<float>(values_per_item));
    }
    REQUIRE(test::run_bare_teams(context, kItems, values_per_item) == results.sums);
  }
}

TEST_CASE("CudaExecutor::exclusive_scan: sums what came before, the total last") {
  const Context context = test::context_on(Device::kCuda);
  Random random = test::test_random();
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{200000}}) {
    std::vector<std::uint32_t> in(size);
    for (std::uint32_t& value : in) value = random.below(1000);
    std::vector<std::uint32_t> expected(size + 1, 0);
    std::partial_sum(in.begin(), in.end(), expected.begin() + 1);
    REQUIRE(test::run_exclusive_scan(context, in) == expected);
  }
}

TEST_CASE("CudaExecutor::sort: is std::stable_sort by the chosen bits") {
  const Context context = test::context_on(Device::kCuda);
  Random random = test::test_random();
  const std::pair<int, int> kBitRanges[] = {{0, 64}, {0, 63}, {32, 47}, {32, 64}, {63, 64}, {10, 10}};
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{70000}}) {
    for (const auto& [low, high] : kBitRanges) {
      std::vector<std::uint64_t> keys(size);
      for (std::uint64_t& key : keys) key = ((static_cast<std::uint64_t>(random.bits()) << 32U) | random.bits()) & 0xC3C3C3C3C3C3C3C3ULL;
      const int num_bits = high - low;
      const std::uint64_t mask = num_bits == 64 ? ~std::uint64_t{0} : ((std::uint64_t{1} << num_bits) - 1) << low;
      std::vector<std::uint64_t> expected = keys;
      std::stable_sort(expected.begin(), expected.end(), [&](std::uint64_t a, std::uint64_t b) { return (a & mask) < (b & mask); });
      REQUIRE(test::run_sort(context, keys, low, high) == expected);
    }
  }
}

TEST_CASE("Random: draws the same numbers on the device") {
  const Context context = test::context_on(Device::kCuda);
  const std::vector<float> numbers = test::run_random(context, 7, 100);
  for (std::size_t i = 0; i < 100; ++i) {
    Random random(7, i);
    REQUIRE(numbers[2 * i] == random.uniform());
    REQUIRE(numbers[2 * i + 1] == random.ahead(i).uniform(-3.0F, 5.0F));
  }
}

TEST_CASE("Array: moves between host and device") {
  const Context context = test::context_on(Device::kCuda);
  std::vector<int> host(1000);
  std::iota(host.begin(), host.end(), -500);
  Array<int> array(MemoryKind::kCuda, Span<const int>(host));
  REQUIRE(array.to_host() == host);
  REQUIRE(array.to_host(context) == host);
  REQUIRE(array.read(context, 999) == 499);
  Array<int> copy = array;
  copy.resize(5000);
  REQUIRE(std::equal(host.begin(), host.end(), copy.to_host().begin()));
  array.clear_to_zero();
  REQUIRE(array.to_host() == std::vector<int>(1000, 0));
  for (int& value : host) value *= 2;
  array.assign(context, Span<const int>(host));
  std::fill(host.begin(), host.end(), 0);  // it may be reused at once
  REQUIRE(array.read(context, 0) == -1000);
  REQUIRE(array.to_host(context)[999] == 998);
}

TEST_CASE("Context: two contexts have streams of their own, copies share theirs") {
  const Context first = test::context_on(Device::kCuda);
  const Context copy = first;
  const Context second = test::context_on(Device::kCuda);
  REQUIRE(first.memory() == MemoryKind::kCuda);
  REQUIRE(copy.stream() == first.stream());
  REQUIRE(second.stream() != first.stream());
  REQUIRE_FALSE(first.device_name().empty());
}

TEST_CASE("Context: two contexts on one device work side by side") {
  const Context first = test::context_on(Device::kCuda);
  const Context second = test::context_on(Device::kCuda);
  Array<int> left(first.memory(), 1000);
  Array<int> right(second.memory(), 1000);
  for (int round = 0; round < 4; ++round) {
    const std::vector<int> values(1000, round);
    left.assign(first, Span<const int>(values));
    right.assign(second, Span<const int>(values));
    REQUIRE(test::run_for_each(first, 300)[299] == 299 * 299);
    REQUIRE(right.read(second, 999) == round);
    REQUIRE(left.read(first, 999) == round);
  }
}

TEST_CASE("Context::wait_for: what one context has put there is what the other finds, on one device") {
  const Context writer = test::context_on(Device::kCuda);
  const Context reader = test::context_on(Device::kCuda);
  Array<int> array(writer.memory(), 100);
  array.clear_to_zero();
  for (int round = 1; round < 4; ++round) {
    const std::vector<int> values(100, round);
    writer.wait_for(reader);  // or what is being read might be overwritten
    array.assign(writer, Span<const int>(values));
    reader.wait_for(writer);
    REQUIRE(array.read(reader, 99) == round);
  }
  const Context host;
  host.wait_for(writer);
  writer.wait_for(host);
}

TEST_CASE("Context: refuses a CUDA device that is not there, naming the setting and the range") {
  ContextOptions options;
  options.device = Device::kCuda;
  for (const int index : {-1, 1000}) {
    options.cuda_device = index;
    const std::string message = test::error_message<InvalidSettings>([&] { Context{options}; });
    REQUIRE(test::contains(message, "cuda_device"));
    REQUIRE(test::contains(message, std::to_string(index)));
    REQUIRE_FALSE(cuda_available(nullptr, index));
  }
}

TEST_CASE("Context: memory lives on the device that its context names") {
  if (!cuda_available(nullptr, 1)) return;  // a machine with one device
  const Context first = test::context_on(Device::kCuda);
  const Context second = test::context_on(Device::kCuda, 1, 1);
  REQUIRE(second.memory() == Memory(MemoryKind::kCuda, 1));
  REQUIRE(second.memory() != first.memory());
  REQUIRE(test::run_for_each(second, 300)[299] == 299 * 299);
  const std::vector<int> values(100, 7);
  const Array<int> array(second.memory(), Span<const int>(values));
  Array<int> copy = array;
  REQUIRE(copy.memory() == second.memory());
  copy.resize(10000);
  REQUIRE(copy.read(second, 99) == 7);
  Array<int> other(first.memory(), 100);
  detail::copy_memory(other.memory(), other.data(), array.memory(), array.data(), 100 * sizeof(int));
  REQUIRE(other.read(first, 99) == 7);
}

TEST_CASE("ScopedStage: on CUDA lasts as long as the work between its ends, inner ones no longer than outer ones") {
  Trace trace;
  ContextOptions options;
  options.device = Device::kCuda;
  options.trace = &trace;
  const Context context(options);
  Array<int> array(context.memory(), 100);
  const std::vector<int> values(100, 1);
  for (int i = 0; i < 3; ++i) {
    const ScopedStage outer(context, "outer");
    array.assign(context, Span<const int>(values));
    for (const char* name : {"outer/first", "outer/second"}) {
      const ScopedStage inner(context, name);
      array.assign(context, Span<const int>(values));
    }
  }
  REQUIRE(trace.stages().size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto duration_ms = [&](const char* name) { return trace.stages().at(name).at(i); };
    REQUIRE(duration_ms("outer/first") >= 0.0);
    REQUIRE(duration_ms("outer/first") + duration_ms("outer/second") <= 1.001 * duration_ms("outer") + 1e-3);
  }
}

TEST_CASE("Context: works on the host's stream if given one") {
  ContextOptions options;
  options.device = Device::kCuda;
  options.cuda_stream = nullptr;  // CUDA's default stream
  const Context context(options);
  REQUIRE(context.stream() == nullptr);
  REQUIRE(test::run_for_each(context, 300)[299] == 299 * 299);
}

TEST_CASE("FrameUploader: puts the images into device memory, frame after frame") {
  const Context context = test::context_on(Device::kCuda);
  FrameUploader uploader(context);
  for (const int width : {16, 40, 8}) {
    RgbdFrame frame;
    frame.depth = Image<float>(width, 5, 1.5F);
    frame.depth(3, 2) = static_cast<float>(width);
    frame.colour = Image<Rgb8>(width, 5, {1, 2, 3});
    frame.calibration.depth = frame.calibration.colour = {10.0F, 10.0F, 3.0F, 2.0F};
    frame.index = width;
    const Frame uploaded = uploader.upload(frame.view());
    REQUIRE(uploaded.depth.memory == MemoryKind::kCuda);
    REQUIRE(uploaded.colour.memory == MemoryKind::kCuda);
    REQUIRE(uploaded.index == width);
    std::vector<float> depth(frame.depth.size());
    detail::read_memory(context, depth.data(), uploaded.depth.data, depth.size() * sizeof(float));
    REQUIRE(std::equal(depth.begin(), depth.end(), frame.depth.data()));
    std::vector<std::uint8_t> colour(3 * frame.colour.size());
    detail::read_memory(context, colour.data(), uploaded.colour.data, colour.size());
    REQUIRE(colour[3 * frame.colour.size() - 1] == 3);
    REQUIRE(uploader.upload(uploaded).depth.data == uploaded.depth.data);  // already there
  }
}

TEST_CASE("ColourRegistration: registers in device memory as on the host") {
  const Context context = test::context_on(Device::kCuda);
  ColourRegistration on_host;
  ColourRegistration on_device;
  for (const int width : {16, 24}) {  // neither is the size of colour
    RgbdFrame frame;
    frame.depth = Image<float>(width, 6, 1.5F);
    frame.colour = Image<Rgb8>(32, 12);
    for (int u = 0; u < 32; ++u) frame.colour(u, 5) = {static_cast<std::uint8_t>(7 * u), 2, 3};
    frame.calibration.depth = {10.0F, 10.0F, 7.5F, 2.5F};
    frame.calibration.colour = {20.0F, 20.0F, 15.5F, 5.5F};
    frame.calibration.depth_from_colour.translation.x() = 0.1F;
    const Array<float> depth(MemoryKind::kCuda, {frame.depth.data(), frame.depth.size()});
    const Array<std::uint8_t> colour(MemoryKind::kCuda, {colour_view(frame.colour).data, 3 * frame.colour.size()});
    Frame in_device_memory = frame.view();
    in_device_memory.depth.data = depth.data();
    in_device_memory.colour.data = colour.data();
    in_device_memory.depth.memory = in_device_memory.colour.memory = MemoryKind::kCuda;
    const Frame result = on_device.apply(in_device_memory);
    REQUIRE(describe_frame_error(result).empty());
    REQUIRE(is_registered(result));
    REQUIRE(result.depth.data == depth.data());
    REQUIRE(result.colour.memory == MemoryKind::kCuda);
    std::vector<std::uint8_t> registered(3 * frame.depth.size());
    detail::read_memory(context, registered.data(), result.colour.data, registered.size());
    const Frame expected = on_host.apply(frame.view());
    REQUIRE(std::equal(registered.begin(), registered.end(), expected.colour.data));
    REQUIRE(on_device.apply(result).colour.data == result.colour.data);  // registered already
  }
}

}  // namespace
}  // namespace foothold
