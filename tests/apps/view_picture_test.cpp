// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The picture of a running reconstruction: that everything is where it belongs, whatever is shown.
#include "common/view_picture.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "common/canvas.h"
#include "common/view_style.h"
#include "common/view_warnings.h"
#include "foothold/io/image_file.h"
#include "support/catch.h"

namespace foothold::apps {
namespace {

// Places of the layout [px].
const cv::Rect kConfidence(495, 0, 350, 60);
const cv::Rect kMap(924, 100, 340, 270);
const cv::Rect kCounters(1045, 680, 235, 40);
constexpr int kPillX = 24;
constexpr int kPillY = 30;

ViewContents busy_contents() {
  ViewContents contents;
  contents.title = "kitchen";
  contents.frame_text = "frame 5 of 9";
  contents.colour = Image<Rgb8>(64, 48, Rgb8{10, 200, 30});
  contents.depth_m = Image<float>(64, 48, 2.0F);
  contents.model = Image<Rgb8>(32, 24, Rgb8{200, 100, 50});
  contents.model_caption = "map";
  contents.state = ViewState::kTracking;
  contents.confidence = 0.5F;
  contents.timings = {{"track", 5.0}, {"fuse", 7.0}};
  contents.total_ms = 12.0;
  contents.view_ms = 3.0;
  contents.frames_per_second = 30.0;
  contents.history = std::vector<ViewMoment>(20, ViewMoment{ViewState::kTracking, 0.9F, false, false});
  contents.map.cells = {{0.0F, 0.0F, Rgb8{200, 200, 200}}, {2.0F, 2.0F, Rgb8{200, 200, 200}}};
  contents.map.trajectory = {{0.2F, 0.2F, ViewState::kTracking, false, false}, {1.5F, 0.5F, ViewState::kTracking, false, true}};
  contents.counters = "3 frames skipped";
  contents.keys = {{"H", "these keys"}};
  return contents;
}

Rgb8 at(const cv::Mat& picture, int x, int y) {
  const auto& pixel = picture.at<cv::Vec3b>(y, x);
  return {pixel[2], pixel[1], pixel[0]};
}

bool equal(Rgb8 a, Rgb8 b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

int count(const cv::Mat& picture, const cv::Rect& area, Rgb8 colour) {
  int num_found = 0;
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) num_found += equal(at(picture, x, y), colour) ? 1 : 0;
  }
  return num_found;
}

bool same(const cv::Mat& a, const cv::Mat& b, const cv::Rect& area) {
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) {
      if (!equal(at(a, x, y), at(b, x, y))) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("compose_view: nothing to show still makes a picture") {
  const cv::Mat picture = compose_view({});
  REQUIRE(picture.size() == cv::Size(kViewWidth, kViewHeight));
  REQUIRE(picture.type() == CV_8UC3);
  CHECK(equal(at(picture, kPillX, kPillY), style::kGrey));
}

TEST_CASE("compose_view: each state has its colour") {
  ViewContents contents = busy_contents();
  for (const ViewState state : {ViewState::kTracking, ViewState::kSettling, ViewState::kLost, ViewState::kPaused}) {
    contents.state = state;
    CHECK(equal(at(compose_view(contents), kPillX, kPillY), style::colour_of(state)));
  }
}

TEST_CASE("compose_view: the confidence bar is as long as the confidence") {
  ViewContents contents = busy_contents();
  const int half = count(compose_view(contents), kConfidence, style::kGreen);
  contents.confidence = 1.0F;
  const int whole = count(compose_view(contents), kConfidence, style::kGreen);
  CHECK(half > 0);
  CHECK(std::abs(whole - 2 * half) < 40);  // round ends
  contents.confidence = 0.0F;
  CHECK(count(compose_view(contents), kConfidence, style::kGreen) == 0);
}

TEST_CASE("compose_view: pictures appear in their places and colours") {
  ViewContents contents = busy_contents();
  const cv::Mat picture = compose_view(contents);
  CHECK(equal(at(picture, 200, 200), Rgb8{10, 200, 30}));
  CHECK(equal(at(picture, 200, 550), colourise_depth(contents.depth_m, 0.0F, contents.max_depth_m)(0, 0)));
  CHECK(equal(at(picture, 670, 240), Rgb8{200, 100, 50}));
  contents.model_is_current = false;
  CHECK(at(compose_view(contents), 670, 240).r < 120);
}

TEST_CASE("compose_view: relocalised poses are marked on the map and in the history") {
  ViewContents contents = busy_contents();
  CHECK(count(compose_view(contents), kMap, style::kBlue) == 0);
  contents.map.trajectory.back().relocalised = true;
  CHECK(count(compose_view(contents), kMap, style::kBlue) > 20);
}

TEST_CASE("compose_view: warnings have a place of their own, and leave the rest as it is") {
  const cv::Rect warnings_edge(734, 570, 4, 110);
  const cv::Rect lower_right(734, 432, 530, 248);
  ViewContents contents = busy_contents();
  const cv::Mat before = compose_view(contents);
  CHECK(count(before, warnings_edge, style::kAmber) == 0);
  contents.warnings = {"the map is full"};
  const cv::Mat one = compose_view(contents);
  CHECK(count(one, warnings_edge, style::kAmber) > 100);
  contents.warnings = std::vector<std::string>(40, std::string(900, 'W'));
  const cv::Mat many = compose_view(contents);
  for (const cv::Mat& after : {one, many}) {
    CHECK(same(before, after, {0, 0, kViewWidth, lower_right.y}));
    CHECK(same(before, after, {0, 0, lower_right.x, kViewHeight}));
    CHECK(same(before, after, {0, lower_right.br().y, kViewWidth, kViewHeight - lower_right.br().y}));
    CHECK(same(before, after, {lower_right.br().x, 0, kViewWidth - lower_right.br().x, kViewHeight}));
  }
}

TEST_CASE("wrapped: lines fit, and hold the whole message") {
  const std::string message = "2 of its 40 frames cannot be read, " + std::string(300, 'W') + " and count as frames without depth";
  constexpr double kWidth = 200.0;
  std::string joined;
  for (const std::string& line : wrapped(message, style::kLabel, kWidth)) {
    CHECK(Canvas::text_width(line, style::kLabel) <= kWidth);
    joined += line;
  }
  const auto without_blanks = [](std::string text) {
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
  };
  CHECK(without_blanks(joined) == without_blanks(message));
  CHECK(wrapped("", style::kLabel, kWidth) == std::vector<std::string>{""});
}

TEST_CASE("with_short_paths: of a long path its end remains") {
  CHECK(with_short_paths("/recordings/of/the/year/2026/kitchen/frame-000018.depth.png: cut short") ==
        ".../frame-000018.depth.png: cut short");
  CHECK(with_short_paths("/a/b: " + std::string(50, 'W')) == "/a/b: " + std::string(50, 'W'));
  CHECK(with_short_paths("/kept/" + std::string(60, 'w') + ": x") == ".../" + std::string(60, 'w') + ": x");
}

TEST_CASE("compose_view: advice stands at the bottom of the map as the camera sees it, line by line") {
  const cv::Rect last_line(490, 378, 360, 26);
  const cv::Rect line_before(490, 350, 360, 26);
  ViewContents contents = busy_contents();
  CHECK(count(compose_view(contents), last_line, style::kAmber) == 0);
  contents.advice = {"9 of 10 frames skipped: move slowly, or use --fast"};
  CHECK(count(compose_view(contents), last_line, style::kAmber) > 50);
  CHECK(count(compose_view(contents), line_before, style::kAmber) == 0);
  contents.advice.emplace_back("lost: point the camera at what was mapped");
  CHECK(count(compose_view(contents), line_before, style::kAmber) > 50);
}

TEST_CASE("compose_view: long texts are cut before they reach their neighbours") {
  ViewContents contents = busy_contents();
  const cv::Mat before = compose_view(contents);
  contents.title = std::string(500, 'W');
  contents.state_note = std::string(500, 'W');
  contents.notice = std::string(500, 'W');
  contents.advice = {std::string(500, 'W')};
  const cv::Mat after = compose_view(contents);
  CHECK(same(before, after, kConfidence));
  CHECK(same(before, after, kCounters));
  CHECK(same(before, after, kMap));
  CHECK(same(before, after, {0, kMap.y, 424, kMap.height + 60}));  // the camera's pictures, left of the advice
}

TEST_CASE("compose_view: help lies over the rest") {
  ViewContents contents = busy_contents();
  contents.keys = std::vector<ViewKey>(12, ViewKey{"Esc", "a rather long explanation of what happens"});
  contents.show_help = true;
  const cv::Mat picture = compose_view(contents);
  CHECK(at(picture, 200, 200).g < 120);
  CHECK(equal(at(picture, kViewWidth / 2 + 150, kViewHeight / 2 - 215), style::kPanel));
}

TEST_CASE("compose_view: values beyond all bounds do no harm") {
  ViewContents contents = busy_contents();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float value : {nan, -1.0F, 1e9F}) {
    contents.confidence = value;
    contents.timings = std::vector<ViewTiming>(6, ViewTiming{"stage", value});
    contents.total_ms = value;
    contents.frames_per_second = value;
    contents.history = std::vector<ViewMoment>(100000, ViewMoment{ViewState::kLost, value, true, true});
    CHECK_NOTHROW(compose_view(contents));
  }
  contents.colour = Image<Rgb8>(3, 2000);
  contents.depth_m = Image<float>(2000, 3, nan);
  CHECK_NOTHROW(compose_view(contents));
}

}  // namespace foothold::apps
