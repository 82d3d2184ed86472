// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/raycaster.h"

#include <algorithm>
#include <climits>

#include "foothold/base/exec/dispatch.h"
#include "raycast/raycaster_kernels.h"

namespace foothold {

#ifdef FOOTHOLD_HAS_CUDA
extern template struct RaycastAlgorithms<CudaExecutor>;
#endif

Raycaster::Raycaster(const Context& context) : context_(context), scratch_(std::make_unique<Scratch>(context.memory())) {}
Raycaster::~Raycaster() = default;
Raycaster::Raycaster(Raycaster&&) noexcept = default;
Raycaster& Raycaster::operator=(Raycaster&&) noexcept = default;

void Raycaster::render(const TsdfVolume& volume, const RenderCamera& camera, SurfaceMap& map, bool with_colour) {
  scratch_->pose.assign(context_, Span<const SE3>(&camera.world_from_camera, 1));
  render_all(volume, camera, scratch_->pose, map, with_colour);
}

void Raycaster::render_all(const TsdfVolume& volume, const RenderCamera& camera, const Array<SE3>& world_from_cameras, SurfaceMap& map,
                           bool with_colour) {
  FOOTHOLD_EXPECTS(camera.width > 0 && camera.height > 0 && is_valid(camera.intrinsics));
  FOOTHOLD_EXPECTS(volume.context().memory() == context_.memory() && map.pixels.memory() == context_.memory());
  FOOTHOLD_EXPECTS(!world_from_cameras.empty() && world_from_cameras.memory() == context_.memory());
  FOOTHOLD_EXPECTS(&world_from_cameras != &map.world_from_cameras);
  FOOTHOLD_EXPECTS(world_from_cameras.size() * static_cast<std::size_t>(std::max(camera.width * camera.height, volume.num_blocks())) <=
                   INT_MAX);
  const ScopedStage stage(context_, "fusion/raycast");
  const auto num_pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height) * world_from_cameras.size();
  map.camera = camera;
  map.world_from_cameras.resize(world_from_cameras.size());
  map.pixels.resize(num_pixels);
  map.colours.resize(with_colour ? num_pixels : 0);
  dispatch(context_, [&](auto on) {
    RaycastAlgorithms<typename decltype(on)::Executor>::render(context_, volume.view(), world_from_cameras, *scratch_, map);
  });
}

}  // namespace foothold
