// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the picture of a running reconstruction shows, as plain values: apps fill it in, compose_view() draws it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "foothold/base/image.h"

namespace foothold::apps {

/// How the reconstruction stands, each with a colour of its own.
enum class ViewState { kWaiting, kTracking, kSettling, kLost, kPaused, kRecording };

/// A stage of the work on a frame.
struct ViewTiming {
  std::string name;
  double ms = 0.0;
};

/// A frame of the past.
struct ViewMoment {
  ViewState state = ViewState::kTracking;
  float confidence = 0.0F;
  bool relocalised = false;  ///< the relocaliser set the pose
  bool event = false;        ///< something happened to the camera: a jump, a covered lens, a forced loss
};

/// A coloured square of the map from above.
struct MapCell {
  float x_m = 0.0F;  ///< to the right on the picture
  float y_m = 0.0F;  ///< downwards on the picture
  Rgb8 colour;
};

/// A camera position on the map from above.
struct MapStop {
  float x_m = 0.0F;
  float y_m = 0.0F;
  ViewState state = ViewState::kTracking;
  bool relocalised = false;
  bool joined = false;  ///< a line connects it with the stop before
};

/// Where the camera is on the map from above, and where it looks.
struct MapCamera {
  float x_m = 0.0F;
  float y_m = 0.0F;
  float forward_x = 0.0F;  ///< unit vector
  float forward_y = 1.0F;
  bool is_current = true;  ///< false: where it was last seen
};

/// The reconstruction from above.
struct MapContents {
  float cell_m = 0.04F;
  std::vector<MapCell> cells;
  std::vector<MapStop> trajectory;
  std::optional<MapCamera> camera;
};

/// A key and what it does.
struct ViewKey {
  std::string key;
  std::string meaning;
};

/// One picture's worth of content. Whatever is empty is left out or said to be missing.
struct ViewContents {
  std::string title;       ///< what is being reconstructed
  std::string frame_text;  ///< such as "frame 312"

  Image<Rgb8> colour;    ///< as the camera sees it
  Image<float> depth_m;  ///< z [m]
  float max_depth_m = 5.0F;
  Image<Rgb8> model;          ///< the map as seen from the camera
  std::string model_caption;  ///< such as "map from the camera" or "map from where the camera was last seen"
  bool model_is_current = true;
  std::vector<std::string> advice;  ///< what the one who holds the camera should do, a line each: shown on the map

  ViewState state = ViewState::kWaiting;
  bool relocalised = false;  ///< a few moments ago: shown beside the state
  std::string state_note;    ///< such as "relocalised after 3 frames"
  float confidence = 0.0F;   ///< [0, 1]

  std::vector<ViewTiming> timings;
  double total_ms = 0.0;  ///< of the stages and what lies between them
  double view_ms = 0.0;   ///< of drawing this view, which comes on top; 0 if unknown
  double frames_per_second = 0.0;
  std::vector<ViewMoment> history;  ///< oldest first
  MapContents map;

  std::string notice;                 ///< what happened last
  std::vector<std::string> warnings;  ///< in their order
  std::string counters;               ///< such as "0 frames skipped"
  std::vector<ViewKey> keys;
  bool show_help = false;
};

}  // namespace foothold::apps
