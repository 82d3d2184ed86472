// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "live_view.h"

#include <algorithm>
#include <array>
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
  if (window_ == nullptr) return false;
  return !since_drawn_.has_value() || since_drawn_->elapsed_ms() > std::max(kMinInterval_ms, drawing_ms_ / kDrawingShare);
}

bool LiveView::file_is_due(std::int64_t num_frames) const {
  return !folder_.empty() && num_frames != last_file_ && num_frames % frames_between_files_ == 0;
}

double LiveView::show(const apps::ViewContents& contents, std::int64_t num_frames) {
  const Stopwatch watch;
  const cv::Mat picture = apps::compose_view(contents);
  if (file_is_due(num_frames)) {
    last_file_ = num_frames;
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "view-%06lld.png", static_cast<long long>(num_frames));
    write_png((std::filesystem::path(folder_) / name.data()).string(), image_of(picture));
  }
  if (window_ != nullptr) {
    const int key = window_->show(picture);
    if (key >= 0) key_ = key;
  }
  drawing_ms_ = watch.elapsed_ms();
  since_drawn_.emplace();
  return drawing_ms_;
}

int LiveView::take_key() {
  if (window_ != nullptr && key_ < 0) key_ = window_->wait(1);
  return std::exchange(key_, -1);
}

}  // namespace foothold::live
