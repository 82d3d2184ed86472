// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace foothold::apps {
namespace {

constexpr double kRedraw_ms = 100.0;
constexpr int kBarWidth = 30;

}  // namespace

std::string duration_text(double seconds) {
  const auto total = static_cast<long long>(std::lround(std::max(0.0, seconds)));
  std::array<char, 48> text{};
  if (total < 60) {
    std::snprintf(text.data(), text.size(), "%lld s", total);
  } else if (total < 3600) {
    std::snprintf(text.data(), text.size(), "%lld min %02lld s", total / 60, total % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%lld h %02lld min", total / 3600, total / 60 % 60);
  }
  return text.data();
}

ProgressBar::ProgressBar(std::string label, std::int64_t total)
    : label_(std::move(label)), total_(total), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (!is_terminal_ || !drawn_) return;
  draw();
  std::fputc('\n', stderr);
}

void ProgressBar::set(std::int64_t done) {
  done_ = std::clamp<std::int64_t>(done, 0, std::max<std::int64_t>(total_, 0));
  if (total_ <= 0) return;
  if (is_terminal_) {
    if (!drawn_ || watch_.elapsed_ms() - last_drawn_ms_ >= kRedraw_ms) draw();
  } else if (const int tenths = static_cast<int>(10 * done_ / total_); tenths > tenths_shown_) {
    tenths_shown_ = tenths;
    draw();
  }
}

void ProgressBar::draw() {
  drawn_ = true;
  last_drawn_ms_ = watch_.elapsed_ms();
  const double fraction = static_cast<double>(done_) / static_cast<double>(total_);
  const double elapsed_s = last_drawn_ms_ / 1000.0;
  std::string time;
  if (done_ >= total_) {
    time = "took " + duration_text(elapsed_s);
  } else if (done_ > 0) {
    time = duration_text(elapsed_s / fraction - elapsed_s) + " left";
  }
  const int percent = static_cast<int>(100.0 * fraction);
  if (!is_terminal_) {
    std::fprintf(stderr, "%s: %d %% (%lld of %lld), %s\n", label_.c_str(), percent, static_cast<long long>(done_),
                 static_cast<long long>(total_), time.c_str());
    return;
  }
  const auto filled = static_cast<std::size_t>(std::lround(fraction * kBarWidth));
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  // Escape [K clears what a longer line left behind.
  std::fprintf(stderr, "\r%s [%s] %3d %% (%lld of %lld) %s\033[K", label_.c_str(), bar.c_str(), percent, static_cast<long long>(done_),
               static_cast<long long>(total_), time.c_str());
  std::fflush(stderr);
}

}  // namespace foothold::apps
