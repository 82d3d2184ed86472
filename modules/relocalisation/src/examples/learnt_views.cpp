// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "examples/learnt_views.h"

#include <algorithm>

#include "examples/examples_algorithms.h"
#include "foothold/base/checked_stream.h"
#include "foothold/base/contract.h"
#include "foothold/base/exec/dispatch.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct ExampleAlgorithms<CudaExecutor>;
#endif

namespace {
constexpr std::size_t kFewestSlots = 1024;
// What a file may ask for. A table grows when a frame's examples might not fit, which need not be new: a small one may be empty.
constexpr std::uint64_t kMostSlots = std::uint64_t{1} << 30U;  ///< of a place, 8 GiB
constexpr std::uint64_t kMostEmptySlots = std::uint64_t{1} << 22U;
constexpr std::uint64_t kMostSlotsPerEntry = 16;
constexpr std::uint64_t kSmallTable = std::uint64_t{1} << 14U;  ///< slots of a table that is loaded however empty it is, 128 kB
}  // namespace

LearntViews::LearntViews(const Memory& memory)
    : slots_(memory), totals_(memory, 3), sort_buffer_(memory), kept_(memory), counts_(memory), kept_before_(memory), unfiltered_(memory) {
  totals_.clear_to_zero();
}

void LearntViews::make_room(const Context& context, std::size_t num_new) {
  const std::size_t wanted = (num_entries_ + num_new) * 3 / 2;
  if (wanted <= slots_.size()) return;
  std::size_t num_slots = kFewestSlots;
  while (num_slots < wanted) num_slots *= 2;
  set_num_slots(context, num_slots);
}

void LearntViews::set_num_slots(const Context& context, std::size_t num_slots) {
  Array<std::uint64_t> slots(slots_.memory(), num_slots);
  dispatch(context, [&](auto on) {
    using Algorithms = ExampleAlgorithms<typename decltype(on)::Executor>;
    Algorithms::clear(context, slots);
    Algorithms::rehash(context, slots_, ViewTable{slots.data(), num_slots - 1});
  });
  context.synchronise();  // before the former table goes
  slots_ = std::move(slots);
}

void LearntViews::keep_new(const Context& context, const Eigen::Vector3f& camera_scene, int examples_per_view, TrainingExamples& examples) {
  const std::size_t num_examples = examples.pixels.size();
  FOOTHOLD_EXPECTS(examples.surface_keys.size() == num_examples);
  num_beyond_reach_ = 0;
  if (num_examples == 0) return;
  make_room(context, num_examples);
  kept_.resize(num_examples);
  counts_.resize(num_examples);
  kept_before_.resize(num_examples + 1);
  unfiltered_.pixels.swap(examples.pixels);
  unfiltered_.points.swap(examples.points);
  examples.pixels.resize(num_examples);
  examples.points.resize(num_examples);
  const Eigen::Vector3f camera_mm = camera_scene * 1000.0F;
  const ViewpointOf view_of{{camera_mm.x(), camera_mm.y(), camera_mm.z()}};
  const KeepNewBuffers buffers{sort_buffer_, kept_, counts_, kept_before_, totals_};
  dispatch(context, [&](auto on) {
    ExampleAlgorithms<typename decltype(on)::Executor>::keep_new(context, ViewTable{slots_.data(), slots_.size() - 1}, view_of,
                                                                 static_cast<std::uint32_t>(examples_per_view), unfiltered_, examples,
                                                                 buffers);
  });
  const std::vector<std::uint32_t> totals = totals_.to_host(context);
  num_entries_ = totals[1];
  num_beyond_reach_ = totals[2];
  examples.pixels.resize(totals[0]);
  examples.points.resize(totals[0]);
}

void LearntViews::save(CheckedWriter& writer) const {
  std::vector<std::uint64_t> entries = slots_.to_host();
  entries.erase(std::remove(entries.begin(), entries.end(), kEmptySlot), entries.end());
  std::sort(entries.begin(), entries.end());
  writer.write(static_cast<std::uint64_t>(slots_.size()));
  writer.write_array(entries);
}

void LearntViews::load(const Context& context, CheckedReader& reader) {
  const auto num_slots = reader.read<std::uint64_t>("learnt views' table");
  if (num_slots > kMostSlots || (num_slots & (num_slots - 1)) != 0)
    reader.refuse("has " + std::to_string(num_slots) + " slots for learnt views, expected a power of two up to " +
                  std::to_string(kMostSlots));
  const auto entries = reader.read_array<std::uint64_t>("learnt views", 0, num_slots * 2 / 3);
  if (num_slots > kMostEmptySlots && num_slots > kMostSlotsPerEntry * entries.size()) {
    reader.refuse("has " + std::to_string(num_slots) + " slots for " + std::to_string(entries.size()) + " learnt views, expected at most " +
                  std::to_string(kMostSlotsPerEntry) + " for each");
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i] == kEmptySlot || (i > 0 && entries[i] >> kCountBits <= entries[i - 1] >> kCountBits))
      reader.refuse("has learnt views that are not in order");
  }
  // A scene may have many places: one that is nearly empty gets a smaller table, which grows when it must.
  std::uint64_t num_loaded_slots = num_slots;
  while (num_loaded_slots > kSmallTable && num_loaded_slots > kMostSlotsPerEntry * entries.size()) num_loaded_slots /= 2;
  LearntViews loaded(slots_.memory());
  if (num_loaded_slots > 0) loaded.set_num_slots(context, num_loaded_slots);
  const Array<std::uint64_t> from(slots_.memory(), Span<const std::uint64_t>(entries));
  dispatch(context, [&](auto on) {
    ExampleAlgorithms<typename decltype(on)::Executor>::rehash(context, from, ViewTable{loaded.slots_.data(), num_loaded_slots - 1});
  });
  context.synchronise();
  loaded.num_entries_ = entries.size();
  loaded.totals_.assign(std::vector<std::uint32_t>{0, static_cast<std::uint32_t>(entries.size()), 0});
  *this = std::move(loaded);
}

}  // namespace foothold
