// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The algorithms of training_examples.h and learnt_views.h over an executor.
#pragma once

#include "examples/learnt_views_kernels.h"
#include "examples/training_examples_kernels.h"

namespace foothold {

/// Scratch memory of LearntViews::keep_new().
struct KeepNewBuffers {
  Array<std::uint64_t>& sort_buffer;
  Array<std::uint32_t>& kept;
  Array<std::uint32_t>& counts;
  Array<std::uint32_t>& kept_before;
  Array<std::uint32_t>& totals;
};

template <class Executor>
struct ExampleAlgorithms {
  static void sample(const Context& context, const SampleTrainingPixel& body, std::size_t num_cells);
  static void colour(const Context& context, const ColourExample& body, std::size_t num_examples);
  static void keep_new(const Context& context, const ViewTable& table, const ViewpointOf& view_of, std::uint32_t examples_per_view,
                       const TrainingExamples& from, TrainingExamples& to, const KeepNewBuffers& buffers);
  static void clear(const Context& context, Array<std::uint64_t>& slots);
  static void rehash(const Context& context, const Array<std::uint64_t>& from, const ViewTable& to);
};

template <class Executor>
void ExampleAlgorithms<Executor>::sample(const Context& context, const SampleTrainingPixel& body, std::size_t num_cells) {
  Executor(context).for_each(num_cells, body);
}

template <class Executor>
void ExampleAlgorithms<Executor>::colour(const Context& context, const ColourExample& body, std::size_t num_examples) {
  Executor(context).for_each(num_examples, body);
}

template <class Executor>
void ExampleAlgorithms<Executor>::clear(const Context& context, Array<std::uint64_t>& slots) {
  Executor(context).for_each(slots.size(), ClearViews{slots.data()});
}

template <class Executor>
void ExampleAlgorithms<Executor>::rehash(const Context& context, const Array<std::uint64_t>& from, const ViewTable& to) {
  Executor(context).for_each(from.size(), Rehash{from.data(), to});
}

template <class Executor>
void ExampleAlgorithms<Executor>::keep_new(const Context& context, const ViewTable& table, const ViewpointOf& view_of,
                                           std::uint32_t examples_per_view, const TrainingExamples& from, TrainingExamples& to,
                                           const KeepNewBuffers& buffers) {
  const Executor executor(context);
  const std::size_t num_examples = from.pixels.size();
  std::uint32_t* const num_kept = buffers.totals.data();
  std::uint32_t* const num_entries = num_kept + 1;
  std::uint32_t* const num_beyond_reach = num_kept + 2;
  executor.sort(Span<std::uint64_t>(to.surface_keys), buffers.sort_buffer, kExampleBits, kExampleBits + kSurfaceBits);
  const Span<const std::uint64_t> keys(to.surface_keys);
  const Span<const std::uint32_t> kept(buffers.kept);
  executor.for_each(num_examples, KeepNewExamples{keys, table, view_of, examples_per_view, buffers.kept.data(), buffers.counts.data(),
                                                  num_entries, num_beyond_reach});
  executor.exclusive_scan(kept, Span<std::uint32_t>(buffers.kept_before));
  const PackExamples pack{kept,    buffers.kept_before.data(), from.pixels.data(), from.points.data(), to.pixels.data(), to.points.data(),
                          num_kept};
  executor.for_each(num_examples, EnterExamples{pack, keys, table, view_of, buffers.counts.data()});
}

}  // namespace foothold
