// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Renders a TsdfVolume as seen from a pose: what the camera ought to see.
#pragma once

#include <memory>

#include "foothold/base/array.h"
#include "foothold/base/camera.h"
#include "foothold/base/se3.h"
#include "foothold/fusion/tsdf_volume.h"

namespace foothold {

/// A virtual camera.
struct RenderCamera {
  Intrinsics intrinsics;  ///< of the image that is rendered [px]
  int width = 0;          ///< columns
  int height = 0;         ///< rows
  SE3 world_from_camera;  ///< its pose

  /// The same camera with both sides of its image divided by `divisor`, rounded down.
  RenderCamera reduced(int divisor) const {
    return {intrinsics.scaled(1.0F / static_cast<float>(divisor)), width / divisor, height / divisor, world_from_camera};
  }
};

/// One pixel of a rendered surface: a point and its normal in the frame of the rendering camera. 16 bytes.
struct SurfacePixel {
  float normal_x = 0.0F;  ///< unit length, towards the camera; all zero where it is unknown
  float normal_y = 0.0F;  ///< likewise
  float normal_z = 0.0F;  ///< likewise
  float depth_m = 0.0F;   ///< z along the optical axis; 0 where no surface was hit

  /// Whether the normal is known.
  FOOTHOLD_HD bool has_normal() const { return normal_x != 0.0F || normal_y != 0.0F || normal_z != 0.0F; }
};
static_assert(sizeof(SurfacePixel) == 16, "surface maps are shared with kernels");

/// A rendered surface, or several from different poses of one camera, in the memory of the context that rendered them.
struct SurfaceMap {
  /// An empty rendering in the given place.
  explicit SurfaceMap(const Memory& memory = {}) : world_from_cameras(memory), pixels(memory), colours(memory) {}

  /// Of several renderings only the camera counts, not its pose.
  RenderCamera camera;
  /// The pose of each rendering.
  Array<SE3> world_from_cameras;
  /// One rendering after another.
  Array<SurfacePixel> pixels;
  /// As many as pixels if colour was asked for, else none; black where no surface was hit.
  Array<Rgb8> colours;

  /// Whether nothing was rendered.
  bool empty() const { return pixels.empty(); }
  /// Poses that were rendered from.
  std::size_t num_renderings() const { return world_from_cameras.size(); }
};

/// Finds, along the ray of each pixel, where the map's signed distance falls through zero.
///
/// Rays start and end at the depth range of the surface blocks that project into their tile of the image, cross other blocks in one step,
/// and interpolate trilinearly only near the surface. Normals come from neighbouring points of the rendering. Nothing is seen farther than
/// 2^15 voxels from the camera, 328 m at 1 cm, so that every ray ends soon, wherever blocks lie.
///
/// Determinism: pixels are independent; identical for any number of threads. Reference: [Newcombe2011] Sec. 3.4, [Prisacariu2017] for the
/// ranges.
class Raycaster {
 public:
  struct Scratch;  ///< buffers of the implementation

  explicit Raycaster(const Context& context);
  ~Raycaster();
  /// What was moved from may only be assigned to or destroyed.
  Raycaster(Raycaster&&) noexcept;
  /// What was moved from may only be assigned to or destroyed.
  Raycaster& operator=(Raycaster&&) noexcept;

  /// Renders `volume` into `map`, whose memory is reused. @pre the volume and the map live in the context's memory; the image is not empty.
  void render(const TsdfVolume& volume, const RenderCamera& camera, SurfaceMap& map, bool with_colour = false);

  /// Renders `volume` from each of several poses, all at once: the camera is `camera` but for its pose.
  /// @pre As for render(); the poses, too, live in the context's memory and are not those of `map`; all images together have fewer than
  /// 2^31 pixels, and there are fewer than 2^31 pairs of a pose and a block.
  void render_all(const TsdfVolume& volume, const RenderCamera& camera, const Array<SE3>& world_from_cameras, SurfaceMap& map,
                  bool with_colour = false);

 private:
  Context context_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace foothold
