// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The executor's verbs, run on the device and brought back to the host.
#pragma once

#include <cstdint>
#include <vector>

#include "foothold/base/context.h"

namespace foothold::test {

/// Lanes reduce `values_per_item` numbers for each of `num_items` items.
struct TeamResults {
  std::vector<int> sums;      ///< of the values, by team.sum()
  std::vector<float> arrays;  ///< of the values, their squares and one, by team.sum_all(), item by item
  std::vector<int> lowest;
  std::vector<int> highest;
  std::vector<int> counted;  ///< of the values, through shared memory and fetch_add()
};

/// The value that item `item` has at place `k`.
int team_value(int item, int k);

TeamResults run_team_verbs(const Context& context, int num_items, int values_per_item);
/// The sums of the values alone, by teams that share no memory.
std::vector<int> run_bare_teams(const Context& context, int num_items, int values_per_item);
/// visits[i] = i * i for i below n.
std::vector<std::uint32_t> run_for_each(const Context& context, std::size_t n);
std::vector<std::uint32_t> run_exclusive_scan(const Context& context, const std::vector<std::uint32_t>& in);
std::vector<std::uint64_t> run_sort(const Context& context, const std::vector<std::uint64_t>& keys, int low_bit, int high_bit);
/// The first numbers of Random(seed, stream) for each stream below num_streams.
std::vector<float> run_random(const Context& context, std::uint64_t seed, int num_streams);

}  // namespace foothold::test
