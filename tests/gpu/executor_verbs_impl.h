// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Definitions of executor_verbs.h over CudaExecutor, the real one or the emulated one.
#pragma once

#include "foothold/base/array.h"
#include "foothold/base/random.h"
#include "gpu/executor_verbs.h"

namespace foothold::test {
namespace verbs {

FOOTHOLD_HD inline int value_of(int item, int k) { return (item * 31 + k * 17) % 101 - 50; }

struct SharedCounter {
  int counter;
  int values[64];
};

struct ReduceItem {
  int values_per_item;
  int* sums;
  float* arrays;
  int* lowest;
  int* highest;
  int* counted;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, SharedCounter& shared, std::size_t item) const {
    if (team.lane() == 0) shared.counter = 0;
    for (int i = team.lane(); i < 64; i += team.size()) shared.values[i] = i;
    team.sync();
    int sum = 0;
    float array[3] = {};
    int low = 1000;
    int high = -1000;
    for (int k = team.lane(); k < values_per_item; k += team.size()) {
      const int value = value_of(static_cast<int>(item), k);
      sum += value;
      array[0] += static_cast<float>(value);
      array[1] += static_cast<float>(value * value);
      array[2] += 1.0F;
      low = value < low ? value : low;
      high = value > high ? value : high;
      team.fetch_add(shared.counter, shared.values[63 - k % 64] + k % 64 - 62);  // one, if the other lanes have written
    }
    sum = team.sum(sum);
    team.sum_all(array);
    low = team.lowest(low);
    high = team.highest(high);
    if (team.lane() != 0) return;
    sums[item] = sum;
    for (int k = 0; k < 3; ++k) arrays[3 * item + static_cast<std::size_t>(k)] = array[k];
    lowest[item] = low;
    highest[item] = high;
    counted[item] = shared.counter;
  }
};

struct SumItem {
  int values_per_item;
  int* sums;

  template <class Team>
  FOOTHOLD_HD void operator()(const Team& team, std::size_t item) const {
    int sum = 0;
    for (int k = team.lane(); k < values_per_item; k += team.size()) sum += value_of(static_cast<int>(item), k);
    sum = team.sum(sum);
    if (team.lane() == 0) sums[item] = sum;
  }
};

struct Square {
  std::uint32_t* values;
  FOOTHOLD_HD void operator()(std::size_t i) const { values[i] = static_cast<std::uint32_t>(i * i); }
};

struct DrawNumbers {
  std::uint64_t seed;
  float* numbers;
  FOOTHOLD_HD void operator()(std::size_t i) const {
    Random random(seed, i);
    numbers[2 * i] = random.uniform();
    numbers[2 * i + 1] = random.ahead(i).uniform(-3.0F, 5.0F);
  }
};

}  // namespace verbs

int team_value(int item, int k) { return verbs::value_of(item, k); }

TeamResults run_team_verbs(const Context& context, int num_items, int values_per_item) {
  const auto n = static_cast<std::size_t>(num_items);
  Array<int> sums(context.memory(), n);
  Array<float> arrays(context.memory(), 3 * n);
  Array<int> lowest(context.memory(), n);
  Array<int> highest(context.memory(), n);
  Array<int> counted(context.memory(), n);
  CudaExecutor(context).template for_each_team<verbs::SharedCounter>(
      n, verbs::ReduceItem{values_per_item, sums.data(), arrays.data(), lowest.data(), highest.data(), counted.data()});
  return {sums.to_host(context), arrays.to_host(context), lowest.to_host(context), highest.to_host(context), counted.to_host(context)};
}

std::vector<int> run_bare_teams(const Context& context, int num_items, int values_per_item) {
  Array<int> sums(context.memory(), static_cast<std::size_t>(num_items));
  CudaExecutor(context).for_each_team(sums.size(), verbs::SumItem{values_per_item, sums.data()});
  return sums.to_host(context);
}

std::vector<std::uint32_t> run_for_each(const Context& context, std::size_t n) {
  Array<std::uint32_t> values(context.memory(), n);
  CudaExecutor(context).for_each(n, verbs::Square{values.data()});
  return values.to_host(context);
}

std::vector<std::uint32_t> run_exclusive_scan(const Context& context, const std::vector<std::uint32_t>& in) {
  const Array<std::uint32_t> device_in(context.memory(), Span<const std::uint32_t>(in));
  Array<std::uint32_t> out(context.memory(), in.size() + 1);
  CudaExecutor(context).exclusive_scan(Span<const std::uint32_t>(device_in), Span<std::uint32_t>(out));
  return out.to_host(context);
}

std::vector<std::uint64_t> run_sort(const Context& context, const std::vector<std::uint64_t>& keys, int low_bit, int high_bit) {
  Array<std::uint64_t> sorted(context.memory(), Span<const std::uint64_t>(keys));
  Array<std::uint64_t> buffer(context.memory());
  CudaExecutor(context).sort(Span<std::uint64_t>(sorted), buffer, low_bit, high_bit);
  return sorted.to_host(context);
}

std::vector<float> run_random(const Context& context, std::uint64_t seed, int num_streams) {
  const auto n = static_cast<std::size_t>(num_streams);
  Array<float> numbers(context.memory(), 2 * n);
  CudaExecutor(context).for_each(n, verbs::DrawNumbers{seed, numbers.data()});
  return numbers.to_host(context);
}

}  // namespace foothold::test
