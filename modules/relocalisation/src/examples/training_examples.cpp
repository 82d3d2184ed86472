// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "examples/training_examples.h"

#include "examples/examples_algorithms.h"
#include "foothold/base/exec/dispatch.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct ExampleAlgorithms<CudaExecutor>;
#endif

void sample_examples(const Context& context, const Frame& frame, const ReservoirSettings& settings, const SE3& scene_from_camera,
                     std::uint64_t frame_seed, TrainingExamples& examples) {
  const int spacing = scaled_to_width(settings.grid_spacing_px, frame.depth.width);
  const int grid_width = (frame.depth.width + spacing - 1) / spacing;
  const int grid_height = (frame.depth.height + spacing - 1) / spacing;
  const std::size_t num_cells = static_cast<std::size_t>(grid_width) * static_cast<std::size_t>(grid_height);
  examples.pixels.resize(num_cells);
  examples.points.resize(num_cells);
  examples.surface_keys.resize(num_cells);
  const SampleTrainingPixel body{frame,
                                 scene_from_camera,
                                 grid_width,
                                 spacing,
                                 settings.jitter,
                                 frame_seed,
                                 examples.pixels.data(),
                                 examples.points.data(),
                                 examples.surface_keys.data()};
  dispatch(context, [&](auto on) { ExampleAlgorithms<typename decltype(on)::Executor>::sample(context, body, num_cells); });
}

void colour_examples(const Context& context, const FeatureImage& image, TrainingExamples& examples) {
  const ColourExample body{image.view(), image.downscale(), examples.pixels.data(), examples.points.data()};
  dispatch(context, [&](auto on) { ExampleAlgorithms<typename decltype(on)::Executor>::colour(context, body, examples.pixels.size()); });
}

}  // namespace foothold
