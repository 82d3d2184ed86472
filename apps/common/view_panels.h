// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The parts of the view, each drawn into an area of its own.
#pragma once

#include "common/canvas.h"
#include "common/view_contents.h"

namespace foothold::apps {

/// State, confidence, title and frame.
void draw_header(Canvas& canvas, const cv::Rect& area, const ViewContents& contents);
/// Words on a dark plate near a corner.
void draw_caption(Canvas& canvas, cv::Point corner, const std::string& words);
/// A picture with a caption in its corner; says so where there is none.
void draw_picture(Canvas& canvas, const cv::Rect& area, const Image<Rgb8>& image, const std::string& caption, double brightness = 1.0);
/// Lines at the bottom of a picture, where nobody overlooks them.
void draw_advice(Canvas& canvas, const cv::Rect& area, const std::vector<std::string>& lines);
/// Depth, colour-coded, with the code.
void draw_depth(Canvas& canvas, const cv::Rect& area, const ViewContents& contents);
/// Milliseconds per stage as bars.
void draw_timings(Canvas& canvas, const cv::Rect& area, const ViewContents& contents);
/// State and confidence of the last frames.
void draw_history(Canvas& canvas, const cv::Rect& area, const std::vector<ViewMoment>& history);
/// What happened last, the counters, and how to get help.
void draw_footer(Canvas& canvas, const cv::Rect& area, const ViewContents& contents);
/// The keys, over everything else.
void draw_help(Canvas& canvas, const std::vector<ViewKey>& keys);
/// The map from above with the trajectory.
void draw_map(Canvas& canvas, const cv::Rect& area, const MapContents& map);

}  // namespace foothold::apps
