// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "failure_pictures.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "common/canvas.h"
#include "foothold/base/angle.h"
#include "foothold/evaluation/text_table.h"

namespace foothold::benchmark {
namespace {

using apps::Canvas;
using apps::TextAlign;

constexpr Rgb8 kBackground = {22, 26, 32};
constexpr Rgb8 kNothing = {38, 44, 53};
constexpr Rgb8 kText = {232, 235, 240};
constexpr Rgb8 kDim = {148, 158, 172};
constexpr Rgb8 kRight = {76, 201, 164};
constexpr Rgb8 kWrong = {242, 150, 90};

constexpr int kGap = 12;
constexpr int kTileWidth = 288;
constexpr int kCaptionHeight = 40;
constexpr int kColumns = 4;
constexpr std::size_t kMostCandidates = 16;
/// Correspondences drawn per view: enough to see where they lie, few enough to follow one.
constexpr std::size_t kMostCorrespondences = 60;
/// A mode supports a pose if it is as near as an inlier's. Reference: kInlierDistanceM of the pose estimator.
constexpr float kSupportDistance_m = 0.05F;
/// Told apart at a glance; pixels whose modes are drawn.
constexpr Rgb8 kModeColours[] = {{250, 204, 70}, {92, 190, 250}, {240, 110, 170}, {150, 226, 120}};

/// A colour by the place in the image, so that a correspondence can be found again in every view.
Rgb8 place_colour(const Eigen::Vector2f& pixel, const Frame& frame) {
  const double hue = 330.0 * static_cast<double>(pixel.x()) / frame.depth.width;
  const double value = 1.0 - 0.35 * static_cast<double>(pixel.y()) / frame.depth.height;
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue / 60.0, 6.0);
    const double c = value - value * 0.8 * std::max(0.0, std::min({k, 4.0 - k, 1.0}));
    return static_cast<std::uint8_t>(std::lround(255.0 * c));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

/// The mode nearest to where a pose puts a pixel, if it supports the pose.
std::optional<Eigen::Vector3f> supporting_mode(const Explanation& explanation, const ExplainedPixel& pixel, const SE3& world_from_camera) {
  const Eigen::Vector3f point_world = world_from_camera * pixel.point_camera;
  float nearest_m = kSupportDistance_m;
  std::optional<Eigen::Vector3f> found;
  for (std::size_t m = pixel.first_mode; m < pixel.first_mode + pixel.num_modes; ++m) {
    const float distance_m = (explanation.modes[m].mean_world - point_world).norm();
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    found = explanation.modes[m].mean_world;
  }
  return found;
}

/// An image in a canvas, and where its pixels lie there.
struct Panel {
  cv::Rect area;
  double scale = 1.0;  ///< canvas pixels per pixel of the frame
  cv::Point2d operator()(const Eigen::Vector2f& pixel) const {
    return {area.x + scale * (static_cast<double>(pixel.x()) + 0.5), area.y + scale * (static_cast<double>(pixel.y()) + 0.5)};
  }
};

Panel place(Canvas& canvas, const Image<Rgb8>& image, cv::Point corner, int width, int frame_width) {
  const cv::Rect area(corner, cv::Size(width, width * image.height() / image.width()));
  canvas.picture(area, image);
  return {area, static_cast<double>(width) / frame_width};
}

/// Draws the correspondences that support a candidate.
/// @param in_candidate_view  draws modes as the candidate sees them, else the pixels themselves.
void draw_support(Canvas& canvas, const Panel& panel, const FailureCase& failure, const ExplainedCandidate& candidate,
                  bool in_candidate_view, double radius) {
  const Frame frame = failure.frame.view();
  const SE3 camera_from_world = candidate.world_from_camera.inverse();
  std::size_t num_drawn = 0;
  for (const ExplainedPixel& pixel : failure.explanation.pixels) {
    if (num_drawn == kMostCorrespondences) return;
    const std::optional<Eigen::Vector3f> mode = supporting_mode(failure.explanation, pixel, candidate.world_from_camera);
    if (!mode.has_value()) continue;
    ++num_drawn;
    const Eigen::Vector2f own = frame.calibration.depth.project(pixel.point_camera);
    const Eigen::Vector3f seen_camera = camera_from_world * *mode;
    if (in_candidate_view && seen_camera.z() <= 0.0F) continue;
    const Eigen::Vector2f at = in_candidate_view ? frame.calibration.depth.project(seen_camera) : own;
    if (!panel.area.contains(cv::Point(panel(at)))) continue;
    canvas.disc(panel(at), radius + 1.2, kBackground);
    canvas.disc(panel(at), radius, place_colour(own, frame));
  }
}

std::string error_text(const PoseError& error) {
  return format_number(100.0 * error.translation_m, error.translation_m < 0.1 ? 1 : 0) + " cm, " +
         format_number(kDegPerRad * error.rotation_rad, error.rotation_rad < 0.17 ? 1 : 0) + " deg off";
}

void draw_frame_around(Canvas& canvas, const cv::Rect& area, Rgb8 colour) {
  cv::rectangle(canvas.pixels(), area, apps::bgr(colour), 3, cv::LINE_AA);
}

Image<Rgb8> to_image(const Canvas& canvas) {
  Image<Rgb8> image(canvas.pixels().cols, canvas.pixels().rows);
  cv::Mat rgb(image.height(), image.width(), CV_8UC3, image.data());
  cv::cvtColor(canvas.pixels(), rgb, cv::COLOR_BGR2RGB);
  return image;
}

RenderCamera camera_of(const FailureCase& failure, const SE3& world_from_camera) {
  return {failure.frame.calibration.depth, failure.frame.depth.width(), failure.frame.depth.height(), world_from_camera};
}

/// Two of three axes and the third from the cross product; z looks along `forward`, y is down.
Eigen::Matrix3f look_along(const Eigen::Vector3f& forward, const Eigen::Vector3f& up) {
  Eigen::Matrix3f rotation;
  const Eigen::Vector3f z = forward.normalized();
  const Eigen::Vector3f x = z.cross(up).normalized();
  rotation.col(0) = x;
  rotation.col(1) = z.cross(x);
  rotation.col(2) = z;
  return rotation;
}

/// A camera behind and above the true one that sees what it sees.
RenderCamera overview_camera(const FailureCase& failure) {
  constexpr int kWidth = 1212;
  constexpr int kHeight = 760;
  constexpr float kFocal_px = 820.0F;
  std::vector<float> depths;
  Eigen::Vector3f centre_camera = Eigen::Vector3f::Zero();
  for (const ExplainedPixel& pixel : failure.explanation.pixels) {
    depths.push_back(pixel.point_camera.z());
    centre_camera += pixel.point_camera / static_cast<float>(failure.explanation.pixels.size());
  }
  std::nth_element(depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2), depths.end());
  const float distance_m = std::max(1.0F, depths[depths.size() / 2]);
  const Eigen::Vector3f up = -failure.truth().rotation.col(1);
  const Eigen::Vector3f ahead = failure.truth().rotation.col(2);
  const Eigen::Vector3f centre = failure.truth() * centre_camera;
  const Eigen::Vector3f eye =
      centre - 2.0F * distance_m * ahead + 1.1F * distance_m * up + 1.0F * distance_m * failure.truth().rotation.col(0);
  return {{kFocal_px, kFocal_px, 0.5F * kWidth, 0.5F * kHeight}, kWidth, kHeight, SE3{look_along(centre - eye, up), eye}};
}

/// Draws on an image as a camera sees the world.
class WorldPainter {
 public:
  WorldPainter(Canvas& canvas, const RenderCamera& camera)
      : canvas_(canvas), camera_(camera), camera_from_world_(camera.world_from_camera.inverse()) {}

  void line(const Eigen::Vector3f& from_world, const Eigen::Vector3f& to_world, Rgb8 colour, double thickness) {
    const auto from = project(from_world);
    const auto to = project(to_world);
    if (from.has_value() && to.has_value()) canvas_.line(*from, *to, colour, thickness);
  }
  void disc(const Eigen::Vector3f& point_world, double radius, Rgb8 colour) {
    const auto at = project(point_world);
    if (!at.has_value()) return;
    canvas_.disc(*at, radius + 1.5, kBackground);
    canvas_.disc(*at, radius, colour);
  }
  /// The outline of a Gaussian's two standard deviations, drawn as the ellipse of its two longest axes.
  void ellipse(const ExplainedMode& mode, Rgb8 colour) {
    constexpr int kCorners = 28;
    constexpr float kDeviations = 2.0F;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> axes(mode.covariance_world);
    std::optional<Eigen::Vector3f> last;
    for (int i = 0; i <= kCorners; ++i) {
      const float angle = 6.2831853F * static_cast<float>(i) / kCorners;
      const Eigen::Vector3f corner = mode.mean_world +
                                     kDeviations * std::cos(angle) * std::sqrt(axes.eigenvalues()(2)) * axes.eigenvectors().col(2) +
                                     kDeviations * std::sin(angle) * std::sqrt(axes.eigenvalues()(1)) * axes.eigenvectors().col(1);
      if (last.has_value()) line(*last, corner, colour, 2.0);
      last = corner;
    }
  }
  void frustum(const SE3& world_from_camera, const Frame& frame, Rgb8 colour) {
    constexpr float kLength_m = 0.35F;
    Eigen::Vector3f corners[4];
    for (int i = 0; i < 4; ++i) {
      const float u = i == 0 || i == 3 ? 0.0F : static_cast<float>(frame.depth.width);
      const float v = i < 2 ? 0.0F : static_cast<float>(frame.depth.height);
      const Intrinsics& k = frame.calibration.depth;
      corners[i] = world_from_camera * Eigen::Vector3f((u - k.cx) / k.fx * kLength_m, (v - k.cy) / k.fy * kLength_m, kLength_m);
    }
    for (int i = 0; i < 4; ++i) {
      line(world_from_camera.translation, corners[i], colour, 3.0);
      line(corners[i], corners[(i + 1) % 4], colour, 3.0);
    }
  }

 private:
  std::optional<cv::Point2d> project(const Eigen::Vector3f& point_world) const {
    constexpr float kNear_m = 0.05F;
    const Eigen::Vector3f point = camera_from_world_ * point_world;
    if (point.z() < kNear_m) return std::nullopt;
    const Eigen::Vector2f pixel = camera_.intrinsics.project(point);
    constexpr float kFar_px = 4000.0F;  // beyond it, OpenCV's fixed-point coordinates would overflow
    if (pixel.cwiseAbs().maxCoeff() > kFar_px) return std::nullopt;
    return cv::Point2d(static_cast<double>(pixel.x()), static_cast<double>(pixel.y()));
  }

  Canvas& canvas_;
  const RenderCamera& camera_;
  SE3 camera_from_world_;
};

/// Dims and greys an image, so that what is drawn on it stands out.
Image<Rgb8> faded(Image<Rgb8> image) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    Rgb8& pixel = image.data()[i];
    const int grey = (pixel.r * 3 + pixel.g * 6 + pixel.b) / 10;
    const auto mixed = [&](int channel) { return static_cast<std::uint8_t>((channel + 2 * grey) / 3 * 6 / 10 + 16); };
    pixel = {mixed(pixel.r), mixed(pixel.g), mixed(pixel.b)};
  }
  return image;
}

/// Pixels that support the best candidate, spread over the image.
std::vector<const ExplainedPixel*> chosen_pixels(const FailureCase& failure) {
  std::vector<const ExplainedPixel*> chosen;
  for (const ExplainedPixel& pixel : failure.explanation.pixels) {
    if (chosen.size() == std::size(kModeColours)) break;
    if (supporting_mode(failure.explanation, pixel, failure.explanation.candidates.front().world_from_camera).has_value())
      chosen.push_back(&pixel);
  }
  return chosen;
}

}  // namespace

SceneModel::SceneModel(const Context& context, const TsdfSettings& settings) : volume_(context, settings), raycaster_(context) {}

Image<Rgb8> SceneModel::render(const RenderCamera& camera, Rgb8 background) {
  raycaster_.render(volume_, camera, map_, true);
  Image<Rgb8> image(camera.width, camera.height, background);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (map_.pixels.data()[i].depth_m > 0.0F) image.data()[i] = map_.colours.data()[i];
  }
  return image;
}

Image<Rgb8> draw_candidates(const FailureCase& failure, SceneModel& model) {
  const std::vector<ExplainedCandidate>& candidates = failure.explanation.candidates;
  const std::size_t num_shown = std::min(candidates.size(), kMostCandidates);
  const int frame_width = failure.frame.depth.width();
  const int tile_height = kTileWidth * failure.frame.depth.height() / frame_width;
  const int large_width = 2 * kTileWidth + kGap;
  const int large_height = large_width * failure.frame.depth.height() / frame_width;
  const int num_rows = (static_cast<int>(num_shown) + kColumns - 1) / kColumns;
  Canvas canvas(kColumns * (kTileWidth + kGap) + kGap, kGap + large_height + kCaptionHeight + num_rows * (tile_height + kCaptionHeight),
                kBackground);

  const Panel live = place(canvas, failure.frame.colour, {kGap, kGap}, large_width, frame_width);
  if (!candidates.empty()) draw_support(canvas, live, failure, candidates.front(), false, 3.5);
  const Panel truth =
      place(canvas, model.render(camera_of(failure, failure.truth()), kNothing), {2 * kGap + large_width, kGap}, large_width, frame_width);
  draw_frame_around(canvas, truth.area, kRight);
  const double caption_y = kGap + large_height + 17.0;
  canvas.text({static_cast<double>(live.area.x), caption_y}, "The live frame, with what supports the first hypothesis", 11.0, kText);
  canvas.text({static_cast<double>(truth.area.x), caption_y}, "The map from the true pose", 11.0, kText);

  for (std::size_t i = 0; i < num_shown; ++i) {
    const int left = kGap + static_cast<int>(i % kColumns) * (kTileWidth + kGap);
    const int top = kGap + large_height + kCaptionHeight + static_cast<int>(i / kColumns) * (tile_height + kCaptionHeight);
    const Image<Rgb8> view = model.render(camera_of(failure, candidates[i].world_from_camera).reduced(2), kNothing);
    const Panel panel = place(canvas, view, {left, top}, kTileWidth, frame_width);
    draw_support(canvas, panel, failure, candidates[i], true, 2.2);
    const PoseError error = failure.error_of(candidates[i]);
    if (kFoundThreshold.contains(error)) draw_frame_around(canvas, panel.area, kRight);
    canvas.text({static_cast<double>(left), top + tile_height + 14.0},
                std::to_string(i + 1) + "   energy " + format_number(static_cast<double>(candidates[i].mean_energy), 3), 9.5, kText);
    canvas.text({static_cast<double>(left + kTileWidth), top + tile_height + 14.0}, error_text(error), 9.5,
                kFoundThreshold.contains(error) ? kRight : kWrong, TextAlign::kRight);
  }
  return to_image(canvas);
}

Image<Rgb8> draw_modes(const FailureCase& failure, SceneModel& model) {
  const RenderCamera camera = overview_camera(failure);
  Canvas canvas(camera.width, camera.height, kBackground);
  canvas.picture({0, 0, camera.width, camera.height}, faded(model.render(camera, kNothing)));
  WorldPainter painter(canvas, camera);
  const Frame frame = failure.frame.view();
  painter.frustum(failure.truth(), frame, kRight);
  painter.frustum(failure.explanation.candidates.front().world_from_camera, frame, kWrong);
  std::size_t num_drawn = 0;
  for (const ExplainedPixel* pixel : chosen_pixels(failure)) {
    const Rgb8 colour = kModeColours[num_drawn++];
    const Eigen::Vector3f place_world = failure.truth() * pixel->point_camera;
    for (std::size_t m = pixel->first_mode; m < pixel->first_mode + pixel->num_modes; ++m) {
      const ExplainedMode& mode = failure.explanation.modes[m];
      painter.line(place_world, mode.mean_world, colour, 1.0);
      painter.ellipse(mode, colour);
      painter.disc(mode.mean_world, 2.0 + 0.6 * std::log2(static_cast<double>(mode.num_points)), colour);
    }
    painter.disc(place_world, 7.0, kText);
    painter.disc(place_world, 4.5, colour);
  }
  canvas.fill_rounded({12, 12, 545, 82}, 6, kBackground, 0.8);
  canvas.text({26.0, 32.0}, "green: the true camera     orange: the estimate", 11.0, kText);
  canvas.text({26.0, 54.0}, "white ring: where a pixel truly is; lines: to all modes of its leaves", 10.0, kDim);
  canvas.text({26.0, 74.0}, "ellipse: two standard deviations of a mode", 10.0, kDim);
  return to_image(canvas);
}

}  // namespace foothold::benchmark
