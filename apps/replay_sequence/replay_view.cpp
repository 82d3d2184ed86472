// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "replay_view.h"

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "common/log.h"
#include "common/view_picture.h"
#include "foothold/base/atomic_file.h"
#include "foothold/base/error.h"

namespace foothold::replay {
namespace {

using apps::ViewContents;

constexpr int kEscape = 27;
/// Between looks at the window while it is paused.
constexpr int kPause_ms = 50;

const std::vector<apps::ViewKey> kKeys = {
    {"Space", "pause, or go on"}, {"H", "show or hide these keys"}, {"Esc", "end the replay and save"}};

void write_picture(const std::string& path, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  write_file_atomically(path, std::string(bytes.begin(), bytes.end()), Durability::kCrash);
}

}  // namespace

ReplayView::ReplayView(const Context& context, const ReplayOptions& options)
    : monitor_(context), folder_(options.video_folder), title_(options.sequence), every_(options.video_every) {
  if (!folder_.empty()) {
    std::error_code error;
    std::filesystem::create_directory(folder_, error);
    if (error) throw FileError(folder_ + ": cannot be created: " + error.message());
  }
  if (options.show) window_ = std::make_unique<apps::ViewWindow>("replay_sequence");
}

void ReplayView::add(const RgbdFrame& frame, const FusionPipeline& pipeline, const FusionFrameResult& result, const std::string& event) {
  if (!is_active()) return;
  monitor_.add(pipeline, result, !event.empty());
  if (!event.empty()) notice_ = event;
  if (num_added_++ % every_ != 0) return;
  const Stopwatch watch;
  draw(frame, pipeline);
  monitor_.add_drawing(watch.elapsed_ms());
}

void ReplayView::draw(const RgbdFrame& frame, const FusionPipeline& pipeline) {
  ViewContents contents = monitor_.contents(frame, pipeline);
  contents.title = title_;
  contents.frame_text = "frame " + std::to_string(frame.index);
  contents.notice = notice_;
  contents.warnings = apps::warnings();
  contents.counters = run_;
  contents.show_help = show_help_;
  if (!folder_.empty()) {
    char name[32];
    std::snprintf(name, sizeof(name), "view-%06d.png", num_added_ - 1);
    write_picture((std::filesystem::path(folder_) / name).string(), apps::compose_view(contents));
  }
  if (window_ == nullptr || ended_) return;
  contents.keys = kKeys;
  heed_keys(window_->show(apps::compose_view(contents)), contents);
}

void ReplayView::heed_keys(int key, ViewContents& contents) {
  bool paused = key == ' ';
  const apps::ViewState state = contents.state;
  while (true) {
    if (window_->closed() || key == kEscape || apps::interrupted()) {
      ended_ = true;
      return;
    }
    if (key == 'h') show_help_ = !show_help_;
    if (!paused && key != 'h') return;
    contents.show_help = show_help_;
    contents.state = paused ? apps::ViewState::kPaused : state;
    key = window_->show(apps::compose_view(contents), paused ? kPause_ms : 1);
    if (key == ' ') paused = !paused;
  }
}

void ReplayView::begin_branch() {
  if (is_active()) main_monitor_.emplace(monitor_);
}

void ReplayView::end_branch() {
  if (!main_monitor_.has_value()) return;
  monitor_ = *main_monitor_;
  main_monitor_.reset();
  notice_.clear();
}

void ReplayView::start_again(const std::string& what) {
  run_ = what;
  notice_.clear();
  monitor_.clear();
}

}  // namespace foothold::replay
