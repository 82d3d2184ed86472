// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/fusion/view_comparer.h"

#include <limits>

#include "fusion/scene.h"
#include "support/catch.h"

namespace foothold {
namespace {

using test::make_context;
using test::Scene;

/// A map of the scene, rendered in colour from the middle of the arc.
struct Model {
  explicit Model(const Context& context, const Scene& scene = {}) : volume(test::fused_arc(context, scene, 12)) {
    Raycaster(context).render(volume, test::camera_of(test::render(scene, pose)), map, true);
  }
  SE3 pose = test::pose_on_arc(0.5F);
  TsdfVolume volume;
  SurfaceMap map;
};

ViewAgreement compare(const Context& context, const RgbdFrame& frame, const SurfaceMap& map, const SE3& pose) {
  ViewComparer check(context);
  check.set_frame(frame.view());
  return check.compare(map, pose);
}

TEST_CASE("ViewComparer: a frame agrees with a map that it helped to make") {
  const Context context = make_context();
  const Model model(context);
  const ViewAgreement view = compare(context, test::render(Scene{}, model.pose), model.map, model.pose);
  REQUIRE(view.num_valid == 80 * 60);  // every fourth pixel in both directions, all of them with depth
  REQUIRE(view.overlap > 0.97F);
  REQUIRE(view.agreement > 0.97F);
  REQUIRE(view.in_front < 0.02F);
  REQUIRE(view.behind < 0.02F);
  REQUIRE(view.solid_in_front < 0.001F);
  REQUIRE(view.solid_behind < 0.001F);
  REQUIRE(view.unlike_texture < 0.1F);
  REQUIRE(view.difference < 0.25F);
  REQUIRE(view.colour_correlation > 0.9F);
}

TEST_CASE("ViewComparer: something in free space is in front, a missing thing is behind") {
  const Context context = make_context();
  const Model model(context);
  RgbdFrame frame = test::render(Scene{}, model.pose);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 80; ++u) frame.depth(u, v) = 0.5F;  // a quarter of the image
  }
  const ViewAgreement hand = compare(context, frame, model.map, model.pose);
  REQUIRE(hand.in_front == Approx(0.25F).margin(0.02F));
  REQUIRE(hand.behind < 0.02F);
  REQUIRE(hand.solid_in_front > 0.2F);
  REQUIRE(hand.solid_in_front <= hand.in_front);
  REQUIRE(hand.solid_behind < 0.001F);
  REQUIRE(hand.difference > 0.6F);

  Scene without_sphere;
  without_sphere.sphere_centre_world = {0.0, 0.0, -100.0};
  const ViewAgreement gone = compare(context, test::render(without_sphere, model.pose), model.map, model.pose);
  REQUIRE(gone.behind > 0.05F);
  REQUIRE(gone.in_front < 0.02F);
  REQUIRE(gone.solid_behind > 0.04F);
  REQUIRE(gone.solid_in_front < 0.001F);
}

TEST_CASE("ViewComparer: single wrong pixels, and differences as small as noise, are nothing solid") {
  const Context context = make_context();
  const Model model(context);
  RgbdFrame frame = test::render(Scene{}, model.pose);
  for (int v = 2; v < 240; v += 12) {
    for (int u = 2; u < 320; u += 12) frame.depth(u, v) += 1.0F;  // compared pixels, every third in both directions
  }
  const ViewAgreement speckled = compare(context, frame, model.map, model.pose);
  REQUIRE(speckled.behind > 0.08F);
  REQUIRE(speckled.solid_behind == 0.0F);

  RgbdFrame biased = test::render(Scene{}, model.pose);
  for (std::size_t i = 0; i < biased.depth.size(); ++i) biased.depth.data()[i] += 0.05F;
  const ViewAgreement off = compare(context, biased, model.map, model.pose);
  REQUIRE(off.behind > 0.5F);
  REQUIRE(off.solid_behind < 0.01F);
}

TEST_CASE("ViewComparer: what falls outside the rendering does not overlap") {
  const Context context = make_context();
  const Model model(context);
  const SE3 turned = model.pose * se3_exp((Tangent6() << 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F).finished());
  const ViewAgreement view = compare(context, test::render(Scene{}, turned), model.map, turned);
  REQUIRE(view.overlap > 0.1F);
  REQUIRE(view.overlap < 0.6F);
  REQUIRE(view.agreement > 0.9F);
}

TEST_CASE("ViewComparer: colour that differs correlates less, the dark and the colourless not at all") {
  const Context context = make_context();
  const Model model(context);
  RgbdFrame mirrored = test::render(Scene{}, model.pose);
  for (std::size_t i = 0; i < mirrored.colour.size(); ++i) {
    Rgb8& pixel = mirrored.colour.data()[i];
    pixel = {static_cast<std::uint8_t>(255 - pixel.r), static_cast<std::uint8_t>(255 - pixel.g), static_cast<std::uint8_t>(255 - pixel.b)};
  }
  REQUIRE(compare(context, mirrored, model.map, model.pose).colour_correlation < -0.9F);
  REQUIRE(compare(context, mirrored, model.map, model.pose).unlike_texture == 1.0F);
  RgbdFrame dark = test::render(Scene{}, model.pose);
  for (std::size_t i = 0; i < dark.colour.size(); ++i) dark.colour.data()[i] = {};
  REQUIRE(compare(context, dark, model.map, model.pose).colour_correlation == 0.0F);
  SurfaceMap colourless;
  Raycaster(context).render(model.volume, model.map.camera, colourless);
  REQUIRE(compare(context, test::render(Scene{}, model.pose), colourless, model.pose).colour_correlation == 0.0F);
}

TEST_CASE("ViewComparer: a frame without depth gives zeros") {
  const Context context = make_context();
  const Model model(context);
  RgbdFrame blank = test::render(Scene{}, model.pose);
  for (std::size_t i = 0; i < blank.depth.size(); ++i) blank.depth.data()[i] = i % 2 == 0 ? 0.0F : std::numeric_limits<float>::quiet_NaN();
  const ViewAgreement view = compare(context, blank, model.map, model.pose);
  REQUIRE(view.num_valid == 0);
  REQUIRE(view.overlap == 0.0F);
  REQUIRE(view.agreement == 0.0F);
  REQUIRE(view.difference == 0.0F);
}

TEST_CASE("ViewComparer: several comparisons at once find what each finds alone") {
  const Context context = make_context();
  const Model model(context);
  const std::vector<SE3> poses = {model.pose, test::pose_on_arc(0.6F), test::look_at({0.0F, 0.0F, 20.0F}, {0.0F, 0.0F, 30.0F})};
  const Array<SE3> starts(MemoryKind::kHost, Span<const SE3>(poses));
  SurfaceMap models;
  Raycaster(context).render_all(model.volume, model.map.camera, starts, models, true);
  const RgbdFrame frame = test::render(Scene{}, model.pose);
  ViewComparer check(context);
  check.set_frame(frame.view());
  check.compare_all(models, starts);
  HostReads reads;
  check.queue_results(reads);
  reads.wait(context);
  const std::vector<ViewAgreement> together = check.results();
  REQUIRE(together.size() == poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    RenderCamera camera = model.map.camera;
    camera.world_from_camera = poses[i];
    SurfaceMap map;
    Raycaster(context).render(model.volume, camera, map, true);
    const ViewAgreement alone = check.compare(map, poses[i]);
    REQUIRE(together[i].num_valid == alone.num_valid);
    REQUIRE(together[i].overlap == alone.overlap);
    REQUIRE(together[i].difference == alone.difference);
    REQUIRE(together[i].colour_correlation == alone.colour_correlation);
    REQUIRE(together[i].texture_correlation == alone.texture_correlation);
  }
  REQUIRE(together.front().overlap > 0.97F);
  REQUIRE(together.back().overlap == 0.0F);
}

TEST_CASE("ViewComparer: identical for any number of threads") {
  ViewAgreement one;
  for (const int num_threads : {1, 2, 4}) {
    const Context context = make_context(num_threads);
    const Model model(context);
    const SE3 beside = test::pose_on_arc(0.6F);
    const ViewAgreement view = compare(context, test::render(Scene{}, beside), model.map, beside);
    if (num_threads == 1) one = view;
    REQUIRE(view.num_valid == one.num_valid);
    REQUIRE(view.overlap == one.overlap);
    REQUIRE(view.difference == one.difference);
    REQUIRE(view.colour_correlation == one.colour_correlation);
  }
}

}  // namespace
}  // namespace foothold
