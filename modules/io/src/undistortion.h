// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Takes lens distortion out of images.
#pragma once

#include <cstdint>
#include <memory>

#include "camera_model.h"
#include "foothold/base/image.h"

namespace foothold::io {

/// Resamples images of a bent camera as a pinhole of the same intrinsics would have seen them, by OpenCV's maps, which are computed once.
/// What the lens did not see becomes black, or no depth. Colour is interpolated; depth is taken from the nearest pixel, for between a near
/// and a far surface there is none. Thread-safe.
class Undistortion {
 public:
  /// Does nothing for a camera without distortion.
  explicit Undistortion(const CameraModel& camera);
  ~Undistortion();
  Undistortion(Undistortion&&) noexcept;
  Undistortion& operator=(Undistortion&&) noexcept;

  /// @pre The image has the camera's size.
  void apply(Image<Rgb8>& image) const;
  void apply(Image<std::uint16_t>& image) const;
  void apply(Image<float>& image) const;

 private:
  struct Maps;
  template <class T>
  void resample(Image<T>& image, int type, int interpolation) const;

  std::unique_ptr<Maps> maps_;
};

}  // namespace foothold::io
