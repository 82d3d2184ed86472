// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "live_view.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "common/view_picture.h"
#include "foothold/base/error.h"
#include "foothold/io/image_file.h"

namespace foothold::live {
namespace {

constexpr double kMinInterval_ms = 60.0;  ///< between pictures: enough for eyes
constexpr double kDrawingShare = 0.25;    ///< of the time that drawing may take

Image<Rgb8> image_of(const cv::Mat& picture) {
  Image<Rgb8> image(picture.cols, picture.rows);
  for (int v = 0; v < picture.rows; ++v) {
    const cv::Vec3b* row = picture.ptr<cv::Vec3b>(v);
    for (int u = 0; u < picture.cols; ++u) image(u, v) = {row[u][2], row[u][1], row[u][0]};
  }
  return image;
}

}  // namespace

const std::vector<apps::ViewKey>& live_keys() {
  static const std::vector<apps::ViewKey> keys{{"Space", "pause and go on"},
                                               {"R", "reset: forget the scene"},
                                               {"L", "lose the camera: tracking of the next frame fails"},
                                               {"T", "relocaliser on and off"},
                                               {"M", "save the surface"},
                                               {"S", "save the scene"},
                                               {"O", "go on with the scene saved last"},
                                               {"H", "this help"},
                                               {"Q, Esc", "end; what was asked for is saved"}};
  return keys;
}

LiveView::LiveView(bool with_window, std::string folder, int frames_between_files)
    : folder_(std::move(folder)), frames_between_files_(frames_between_files) {
  if (with_window) window_ = std::make_unique<apps::ViewWindow>("Foothold");
  if (folder_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_)) {
    throw FileError(folder_ + ": cannot be created: " + (error ? error.message() : "a file of this name is in the way"));
  }
}

bool LiveView::window_is_due() const {
  if (window_ == nullptr || drawing_.valid()) return false;
  return !since_shown_.has_value() || since_shown_->elapsed_ms() > std::max(kMinInterval_ms, drawing_ms_ / kDrawingShare);
}

bool LiveView::file_is_due(std::int64_t num_frames) const {
  return !folder_.empty() && num_frames != last_file_ && num_frames % frames_between_files_ == 0;
}

LiveView::Drawn LiveView::drawn(const apps::ViewContents& contents) {
  const Stopwatch watch;
  cv::Mat picture = apps::compose_view(contents);
  return {std::move(picture), watch.elapsed_ms()};
}

void LiveView::show(apps::ViewContents contents, std::int64_t num_frames) {
  if (!file_is_due(num_frames) && since_shown_.has_value()) {
    drawing_ = std::async(std::launch::async, [contents = std::move(contents)] { return drawn(contents); });
    return;
  }
  drawing_ = {};  // what is being drawn is older: it must not be shown after this one
  const Drawn now = drawn(contents);
  if (file_is_due(num_frames)) write_file(now, num_frames);
  present(now);
}

void LiveView::write_file(const Drawn& drawn, std::int64_t num_frames) {
  last_file_ = num_frames;
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "view-%06lld.png", static_cast<long long>(num_frames));
  write_png((std::filesystem::path(folder_) / name.data()).string(), image_of(drawn.picture));
}

void LiveView::present(const Drawn& drawn) {
  const Stopwatch watch;
  if (window_ != nullptr) {
    const int key = window_->show(drawn.picture);
    if (key >= 0) key_ = key;
  }
  drawing_ms_ = drawn.ms + watch.elapsed_ms();
  since_shown_.emplace();
}

int LiveView::take_key() {
  if (drawing_.valid() && drawing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) present(drawing_.get());
  if (window_ != nullptr && key_ < 0) key_ = window_->wait(1);
  return std::exchange(key_, -1);
}

}  // namespace foothold::live
