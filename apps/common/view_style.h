// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Colours and sizes that the parts of the view share.
#pragma once

#include "common/view_contents.h"

namespace foothold::apps::style {

inline constexpr Rgb8 kBackground = {18, 21, 26};
inline constexpr Rgb8 kPanel = {28, 33, 40};
inline constexpr Rgb8 kGroove = {46, 53, 63};
inline constexpr Rgb8 kText = {232, 235, 240};
inline constexpr Rgb8 kDimText = {148, 158, 172};
inline constexpr Rgb8 kDarkText = {16, 18, 22};
inline constexpr Rgb8 kGreen = {76, 195, 120};
inline constexpr Rgb8 kAmber = {236, 180, 60};
inline constexpr Rgb8 kRed = {236, 92, 82};
inline constexpr Rgb8 kBlue = {90, 170, 250};
inline constexpr Rgb8 kGrey = {120, 130, 145};

/// Heights of capital letters [px].
inline constexpr double kLabel = 9.0;
inline constexpr double kBody = 10.5;
inline constexpr double kHeading = 13.0;

inline constexpr int kRadius = 6;

constexpr Rgb8 colour_of(ViewState state) {
  switch (state) {
    case ViewState::kTracking:
      return kGreen;
    case ViewState::kSettling:
      return kAmber;
    case ViewState::kLost:
    case ViewState::kRecording:
      return kRed;
    case ViewState::kWaiting:
    case ViewState::kPaused:
      break;
  }
  return kGrey;
}

constexpr const char* name_of(ViewState state) {
  switch (state) {
    case ViewState::kWaiting:
      return "WAITING";
    case ViewState::kTracking:
      return "TRACKING";
    case ViewState::kSettling:
      return "SETTLING";
    case ViewState::kLost:
      return "LOST";
    case ViewState::kPaused:
      return "PAUSED";
    case ViewState::kRecording:
      return "RECORDING";
  }
  return "";
}

}  // namespace foothold::apps::style
