// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/view_window.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <opencv2/highgui.hpp>

#include "foothold/base/error.h"

namespace foothold::apps {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool can_connect(const std::string& path, bool abstract) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t offset = abstract ? 1 : 0;  // Linux: names of abstract sockets begin with a zero
  if (path.size() + offset >= sizeof(address.sun_path)) return false;
  std::memcpy(address.sun_path + offset, path.data(), path.size());
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
  if (descriptor < 0) return false;
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + offset + path.size());
  const bool connected = ::connect(descriptor, reinterpret_cast<const sockaddr*>(&address), length) == 0;
  ::close(descriptor);
  return connected;
}

}  // namespace

/// Window toolkits end the process when they cannot reach the display, so it is tried first.
std::string describe_missing_display() {
  if (is_set("WAYLAND_DISPLAY") || is_set("QT_QPA_PLATFORM")) return {};
  if (!is_set("DISPLAY")) return "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set";
  const std::string display = std::getenv("DISPLAY");
  if (display.front() != ':') return {};  // on another machine: not ours to try
  const std::string path = "/tmp/.X11-unix/X" + display.substr(1, display.find('.') - 1);
  if (can_connect(path, false) || can_connect(path, true)) return {};
  return "the display '" + display + "' of DISPLAY does not answer";
}

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
