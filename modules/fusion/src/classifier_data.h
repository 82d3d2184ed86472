// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The classifiers that ship, as text. The build makes classifier_data.cpp from the files in data/, so that the library finds them wherever
/// it is installed.
#pragma once

namespace foothold {

extern const char* const kTrackingQualityText;
extern const char* const kPoseAcceptanceText;

}  // namespace foothold
