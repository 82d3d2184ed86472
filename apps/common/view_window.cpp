// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/view_window.h"

#include <cctype>
#include <opencv2/highgui.hpp>

#include "common/display_probe.h"
#include "foothold/base/error.h"

namespace foothold::apps {

ViewWindow::ViewWindow(std::string title) : title_(std::move(title)) {
  const std::string missing = describe_missing_display();
  if (!missing.empty()) throw DeviceError("cannot open a window: " + missing);
  try {
    cv::namedWindow(title_, cv::WINDOW_NORMAL | cv::WINDOW_KEEPRATIO | cv::WINDOW_GUI_NORMAL);
  } catch (const cv::Exception& error) {
    throw DeviceError("cannot open a window: OpenCV says: " + error.err);
  }
}

ViewWindow::~ViewWindow() {
  try {
    if (!closed_) cv::destroyWindow(title_);
  } catch (const cv::Exception&) {  // it is gone already
  }
}

int ViewWindow::show(const cv::Mat& picture, int wait_ms) {
  if (closed_) return -1;
  cv::imshow(title_, picture);
  if (!sized_) cv::resizeWindow(title_, picture.cols, picture.rows);
  sized_ = true;
  return wait(wait_ms);
}

int ViewWindow::wait(int wait_ms) {
  if (closed_) return -1;
  const int key = cv::waitKey(wait_ms);
  try {
    closed_ = cv::getWindowProperty(title_, cv::WND_PROP_VISIBLE) < 0.5;
  } catch (const cv::Exception&) {
    closed_ = true;
  }
  return key < 0 ? -1 : std::tolower(key & 0xff);
}

}  // namespace foothold::apps
