// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <vector>

#include "benchmark_options.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/fusion/pose_refiner.h"
#include "foothold/relocalisation/forest_relocaliser.h"

namespace foothold::benchmark {

/// The parts under test on one device: a relocaliser, and a pipeline that tracks and fuses without it.
struct DeviceRig {
  DeviceRig(const Context& device, const std::string& preset)
      : context(device),
        uploader(context),
        relocaliser(context, default_forest(), ForestRelocaliserSettings::preset(preset)),
        pipeline(context, {}, nullptr),
        refiner(context) {}

  Context context;
  FrameUploader uploader;
  ForestRelocaliser relocaliser;
  FusionPipeline pipeline;
  PoseRefiner refiner;
};

/// Prints durations of whole calls and of stages.
void time_calls(const Options& options);

/// Prints what CUDA makes of a recording beside what the CPU makes of it. @return whether they agree
bool compare_devices(const Options& options);

/// Processes a recording again and again, and prints a line for each time. @return whether all were alike
bool soak(const Options& options);

}  // namespace foothold::benchmark
