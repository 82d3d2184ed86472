// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/renderer.h"

#include <algorithm>

#include "foothold/base/exec/cpu_executor.h"
#include "shading.h"
#include "visibility.h"

namespace foothold {
namespace {

using namespace synthetic_detail;

/// One rendering: everything that its tiles share.
struct Rendering {
  const Room& room;
  const Intrinsics& intrinsics;
  const SE3& world_from_camera;
  std::vector<VisiblePrimitive> visible;
  RenderedView& view;

  void set_rays(Tile& tile, int left, int top) const {
    for (int i = 0; i < Tile::kSize; ++i) {
      tile.x[i] = (static_cast<float>(left + i % Tile::kSide) - intrinsics.cx) / intrinsics.fx;
      tile.y[i] = (static_cast<float>(top + i / Tile::kSide) - intrinsics.cy) / intrinsics.fy;
      tile.t[i] = kMiss;
      tile.primitive[i] = -1;
    }
  }

  void trace(Tile& tile, int left, int top) const {
    float farthest = kMiss;
    for (const VisiblePrimitive& p : visible) {
      if (p.nearest_m > farthest) break;
      if (p.right < left || p.bottom < top || p.left >= left + Tile::kSide || p.top >= top + Tile::kSide) continue;
      tile.trace(p.view, p.index);
      farthest = tile.farthest();
    }
  }

  void write(const Tile& tile, int left, int top) const {
    const Shading shading(room, intrinsics, world_from_camera);
    const int width = view.depth.width();
    const int height = view.depth.height();
    for (int i = 0; i < Tile::kSize; ++i) {
      const int u = left + i % Tile::kSide;
      const int v = top + i / Tile::kSide;
      if (u >= width || v >= height) continue;
      view.primitive(u, v) = tile.primitive[i];
      if (tile.primitive[i] < 0) continue;
      const Shade shade = shading(tile.primitive[i], tile.x[i], tile.y[i], tile.t[i]);
      view.depth(u, v) = tile.t[i];
      view.colour(u, v) = shade.colour;
      view.incidence_cosine(u, v) = shade.incidence_cosine;
    }
  }

  void render_row(Tile& tile, int top) const {
    for (int left = 0; left < view.depth.width(); left += Tile::kSide) {
      set_rays(tile, left, top);
      trace(tile, left, top);
      write(tile, left, top);
    }
  }
};

/// Renders with a loop over rows of tiles that runs its body for 0 .. n - 1 in any order.
template <class ForEachRow>
RenderedView render_rows(const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width, int height,
                         const ForEachRow& for_each_row) {
  FOOTHOLD_EXPECTS(is_valid(intrinsics));
  FOOTHOLD_EXPECTS(width > 0 && height > 0);
  RenderedView view{Image<float>(width, height), Image<Rgb8>(width, height), Image<float>(width, height),
                    Image<std::int32_t>(width, height, -1)};
  const Rendering rendering{room, intrinsics, world_from_camera, visible_primitives(room, intrinsics, world_from_camera, width, height),
                            view};
  const int num_rows = (height + Tile::kSide - 1) / Tile::kSide;
  for_each_row(static_cast<std::size_t>(num_rows),
               [&](Tile& tile, std::size_t row) { rendering.render_row(tile, static_cast<int>(row) * Tile::kSide); });
  return view;
}

}  // namespace

RenderedView render(const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width, int height) {
  return render_rows(room, intrinsics, world_from_camera, width, height, [](std::size_t num_rows, const auto& body) {
    Tile tile;
    for (std::size_t row = 0; row < num_rows; ++row) body(tile, row);
  });
}

RenderedView render(const Context& context, const Room& room, const Intrinsics& intrinsics, const SE3& world_from_camera, int width,
                    int height) {
  return render_rows(room, intrinsics, world_from_camera, width, height, [&](std::size_t num_rows, const auto& body) {
    CpuExecutor(context).for_each_team<Tile>(num_rows, [&](CpuTeam, Tile& tile, std::size_t row) { body(tile, row); });
  });
}

}  // namespace foothold
