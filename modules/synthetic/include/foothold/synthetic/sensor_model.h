// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Makes an ideal view look as if a structured-light camera had taken it.
#pragma once

#include <cstdint>

#include "foothold/synthetic/renderer.h"

namespace foothold {

/// Image width for which sizes in pixels are stated [px]; other widths scale them.
inline constexpr float kReferenceWidth = 640.0F;

/// How far a structured-light camera is from ideal. The defaults describe a Kinect of the first generation.
struct SensorModel {
  /// Focal length times baseline [px*m]: 585 px, 7.5 cm. The disparity at depth z is this over z.
  float focal_baseline_px_m = 43.875F;
  /// Step of the disparity's quantisation [px]. [Khoshelham2012]
  float disparity_step_px = 0.125F;
  /// Standard deviation of the disparity [px]; half a step gives the measured 1.4 mm/m^2 growth with squared depth. [Khoshelham2012]
  float disparity_sigma_px = 0.0625F;
  /// Standard deviation of the sideways jitter of depth edges [px]. [Handa2014]
  float lateral_sigma_px = 0.5F;
  /// Depth outside these limits is not measured [m].
  float min_depth_m = 0.4F;
  float max_depth_m = 6.0F;  ///< the farthest [m]
  /// Surfaces seen flatter than this lose pixels: below the cosine half of them, below half the cosine all.
  float grazing_cosine = 0.17F;
  /// Standard deviation of the colour noise [grey levels].
  float colour_sigma = 3.0F;
  /// Loss of brightness in the image's corners, in [0, 1].
  float vignetting = 0.15F;
  /// Largest drift of exposure and of the balance of red and blue over time, in [0, 1].
  float exposure_drift = 0.0F;
};

/// The model of a noise level: 1 is a Kinect, 2 a bad day of it (twice the noise, drifting exposure).
SensorModel sensor_model(int noise_level);

/// Replaces depth and colour of a view by measurements. The view is taken by value because edges need its ideal depth beside.
///
/// @param room   The room that was rendered; its materials decide what the depth camera sees.
/// @param seed   Equal seeds, frames and views give equal measurements.
/// @param frame  Number of the frame; noise is independent from frame to frame, exposure drifts smoothly along it.
/// @return       The measured view; depth 0 marks holes.
RenderedView measure(const SensorModel& model, const Room& room, RenderedView ideal, std::uint64_t seed, int frame);

/// Adds the noise of another exposure to a frame that may have some: to disparity and to colour, per pixel. Holes stay, and nothing is
/// quantised.
/// @param seed   Equal seeds and frames add equal noise.
/// @param frame  Number of the frame; noise is independent from frame to frame.
/// @pre Both images have one size.
void add_noise(const SensorModel& model, std::uint64_t seed, int frame, Image<float>& depth, Image<Rgb8>& colour);

}  // namespace foothold
