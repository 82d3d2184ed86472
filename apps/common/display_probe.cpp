// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/display_probe.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <opencv2/highgui.hpp>

namespace foothold::apps {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPatience = std::chrono::seconds(10);
constexpr std::size_t kMaxOutput = 1U << 16U;

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// The child's part: opens a window and ends. Whatever is said goes to `output`.
[[noreturn]] void open_window(int output) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGABRT, SIGTERM, SIGINT}) std::signal(signal, SIG_DFL);
  ::dup2(output, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  try {
    cv::namedWindow("probe", cv::WINDOW_NORMAL);
    cv::waitKey(1);
    cv::destroyAllWindows();
  } catch (const cv::Exception& error) {
    const std::string text = "OpenCV says: " + error.err + "\n";
    const ssize_t ignored = ::write(output, text.data(), text.size());
    static_cast<void>(ignored);
    ::_exit(1);
  }
  ::_exit(0);
}

/// What the child says until it ends. @return False if it did not end in time.
bool read_to_end(int descriptor, std::string& text) {
  const Clock::time_point deadline = Clock::now() + kPatience;
  std::array<char, 4096> block{};
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd waiting{descriptor, POLLIN, 0};
    if (left <= 0 || ::poll(&waiting, 1, static_cast<int>(left)) <= 0) return false;
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count <= 0) return true;
    if (text.size() < kMaxOutput) text.append(block.data(), static_cast<std::size_t>(count));
  }
}

/// The first line in which a toolkit complains, without control characters.
std::string complaint(const std::string& output) {
  for (std::size_t begin = 0; begin < output.size();) {
    const std::size_t end = std::min(output.find('\n', begin), output.size());
    std::string line = output.substr(begin, end - begin);
    begin = end + 1;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.find("XDG_RUNTIME_DIR") != std::string::npos) continue;
    for (char& c : line) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    return line.substr(0, 200);
  }
  return {};
}

std::string display_name() {
  std::string name;
  for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
    if (is_set(variable)) name += (name.empty() ? "" : ", ") + std::string(variable) + "=" + std::getenv(variable);
  }
  return name;
}

}  // namespace

std::string describe_missing_display() {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY") && !is_set("QT_QPA_PLATFORM")) {
    return "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set";
  }
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) open_window(ends[1]);
  ::close(ends[1]);
  std::string output;
  const bool in_time = child > 0 && read_to_end(ends[0], output);
  ::close(ends[0]);
  if (child < 0) return {};
  if (!in_time) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (in_time && WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  const std::string why = in_time ? complaint(output) : "it does not answer";
  return "the display (" + display_name() + ") cannot be used" + (why.empty() ? "" : ": " + why);
}

}  // namespace foothold::apps
