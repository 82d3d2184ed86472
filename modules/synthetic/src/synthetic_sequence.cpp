// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/synthetic_sequence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "foothold/base/angle.h"
#include "foothold/base/contract.h"
#include "foothold/base/error.h"
#include "foothold/synthetic/renderer.h"
#include "foothold/synthetic/sensor_model.h"
#include "foothold/synthetic/trajectory.h"
#include "rooms.h"

namespace foothold {
namespace {

constexpr char kPrefix[] = "synthetic:";
constexpr double kFramesPerSecond = 30.0;
/// The nominal calibration of 7-Scenes at 640x480.
constexpr float kFocalLength_px = 585.0F;
constexpr float kReferenceHeight = 480.0F;

TrajectoryKind trajectory_kind(const std::string& text) {
  if (text == "train") return TrajectoryKind::kTrain;
  if (text == "test") return TrajectoryKind::kTest;
  throw InvalidSettings("setting trajectory: got '" + text + "', expected train or test");
}

Intrinsics intrinsics_for(int width, int height) {
  const float factor = static_cast<float>(width) / kReferenceWidth;
  Intrinsics result = Intrinsics{kFocalLength_px, kFocalLength_px, 0.5F * kReferenceWidth, 0.5F * kReferenceHeight}.scaled(factor);
  // Images of another shape keep square pixels and the same middle.
  result.cy = (0.5F * kReferenceHeight + 0.5F) * static_cast<float>(height) / kReferenceHeight - 0.5F;
  return result;
}

/// As many threads as a context has, but not the same: whoever waits for a result in that context shall not render frames meanwhile.
Context rendering_context(const Context& context) {
  ContextOptions options;
  options.num_threads = context.num_threads();
  return Context(options);
}

SE3 rolled(float roll_deg) {
  const float angle = roll_deg * kRadPerDeg;
  SE3 result;
  result.rotation << std::cos(angle), -std::sin(angle), 0.0F, std::sin(angle), std::cos(angle), 0.0F, 0.0F, 0.0F, 1.0F;
  return result;
}

class SyntheticSequence final : public Sequence {
 public:
  SyntheticSequence(const SyntheticSequenceSettings& settings, const Context& context)
      : settings_(settings),
        context_(rendering_context(context)),
        trajectory_(make_room(settings.room), trajectory_kind(settings.trajectory), settings.seed),
        room_(changed_room(make_room(settings.room), settings)),
        intrinsics_(intrinsics_for(settings.width, settings.height)) {}

  std::string name() const override { return synthetic_spec(settings_); }
  int num_frames() const override { return settings_.frames; }

  RgbdFrame load(int index) const override {
    FOOTHOLD_EXPECTS(index >= 0 && index < settings_.frames);
    RgbdFrame frame;
    frame.index = index;
    frame.timestamp_s = static_cast<double>(index) / kFramesPerSecond;
    frame.calibration = {intrinsics_, intrinsics_, SE3{}};
    const SE3 on_path = trajectory_.world_from_camera(frame.timestamp_s);
    const SE3 world_from_camera = (settings_.mirrored ? mirrored_pose(on_path) : on_path) * rolled(settings_.roll_deg);
    frame.world_from_camera = world_from_camera;
    RenderedView view = render(context_, room_, intrinsics_, world_from_camera, settings_.width, settings_.height);
    if (settings_.noise > 0) view = measure(sensor_model(settings_.noise), room_, std::move(view), settings_.seed, index);
    frame.depth = std::move(view.depth);
    frame.colour = std::move(view.colour);
    apply_effects(settings_, settings_.seed, frame);
    return frame;
  }

 private:
  SyntheticSequenceSettings settings_;
  Context context_;
  Trajectory trajectory_;
  Room room_;
  Intrinsics intrinsics_;
};

/// Sets one "key=value" of a spec.
void assign(SyntheticSequenceSettings& settings, const std::string& spec, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InvalidSettings("synthetic sequence '" + spec + "': got '" + assignment + "', expected key=value");
  }
  const std::string key = assignment.substr(0, equals);
  std::string value = assignment.substr(equals + 1);
  if (key == "noise" && (value == "true" || value == "false")) value = value == "true" ? "1" : "0";
  assign_setting(settings, key, value);
}

}  // namespace

void SyntheticSequenceSettings::validate() const {
  validate_settings(*this);
  trajectory_kind(trajectory);
  synthetic_detail::check_room_name(room);
}

bool is_synthetic_spec(const std::string& spec) { return spec.compare(0, sizeof(kPrefix) - 1, kPrefix) == 0; }

SyntheticSequenceSettings parse_synthetic_spec(const std::string& spec) {
  const std::string body = is_synthetic_spec(spec) ? spec.substr(sizeof(kPrefix) - 1) : spec;
  const std::size_t question = body.find('?');
  SyntheticSequenceSettings settings;
  settings.room = body.substr(0, question);
  std::size_t begin = question == std::string::npos ? body.size() : question + 1;
  while (begin < body.size()) {
    const std::size_t end = std::min(body.find('&', begin), body.size());
    assign(settings, spec, body.substr(begin, end - begin));
    begin = end + 1;
  }
  settings.validate();
  return settings;
}

std::string synthetic_spec(const SyntheticSequenceSettings& settings) {
  const std::vector<SettingDescription> defaults = describe_settings(SyntheticSequenceSettings{});
  const std::vector<SettingDescription> actual = describe_settings(settings);
  std::string spec = kPrefix + settings.room;
  char separator = '?';
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (actual[i].path == "room" || actual[i].value == defaults[i].value) continue;
    spec += separator + actual[i].path + "=" + actual[i].value;
    separator = '&';
  }
  return spec;
}

std::unique_ptr<Sequence> make_synthetic_sequence(const SyntheticSequenceSettings& settings, const Context& context) {
  settings.validate();
  return std::make_unique<SyntheticSequence>(settings, context);
}

}  // namespace foothold
