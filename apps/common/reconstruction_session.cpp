// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "common/reconstruction_session.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include "foothold/base/error.h"

namespace foothold::apps {
namespace {

constexpr const char* kRelocaliserPart = "relocaliser";
constexpr const char* kReconstructionPart = "reconstruction";

/// Settings that a scene depends on: under others, its voxels and leaves mean something else.
constexpr const char* kSceneSettings[] = {"fusion.volume.", "forest.features.", "forest.reservoirs.capacity",
                                          "forest.clustering.max_modes"};

bool shapes_the_scene(const std::string& path) {
  return std::any_of(std::begin(kSceneSettings), std::end(kSceneSettings),
                     [&](const std::string& prefix) { return path.compare(0, prefix.size(), prefix) == 0; });
}

/// @throws FileError if a scene cannot go on under the settings.
void check_scene_settings(const std::string& path, const std::vector<SettingText>& saved, const std::vector<SettingText>& current) {
  std::string differences;
  std::string remedy;
  for (const SettingText& setting : current) {
    if (!shapes_the_scene(setting.path)) continue;
    const auto same_path = [&](const SettingText& other) { return other.path == setting.path; };
    const auto found = std::find_if(saved.begin(), saved.end(), same_path);
    if (found == saved.end()) throw FileError(path + ": does not tell " + setting.path + ": it comes from another version of Foothold");
    if (found->text == setting.text) continue;
    differences += (differences.empty() ? "" : ", ") + setting.path + " = " + found->text + " instead of " + setting.text;
    remedy += " --set " + setting.path + "=" + found->text;
  }
  if (differences.empty()) return;
  throw FileError(path + ": the scene was made with other settings: " + differences + ". To go on with it, give" + remedy);
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm time{};
  gmtime_r(&now, &time);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &time);
  return text.data();
}

std::string hexadecimal(std::uint64_t value) {
  std::array<char, 20> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

/// A relocaliser that learns always, and answers while it is on.
class SwitchedRelocaliser : public Relocaliser {
 public:
  explicit SwitchedRelocaliser(Relocaliser& relocaliser) : relocaliser_(relocaliser) {}

  void train(const Frame& frame, const SE3& world_from_camera) override { relocaliser_.train(frame, world_from_camera); }
  std::vector<PoseEstimate> relocalise(const Frame& frame) override {
    return is_on ? relocaliser_.relocalise(frame) : std::vector<PoseEstimate>();
  }
  void update() override { relocaliser_.update(); }
  void reset() override { relocaliser_.reset(); }
  std::size_t state_bytes() const override { return relocaliser_.state_bytes(); }
  float acceptance_threshold() const override { return relocaliser_.acceptance_threshold(); }

  bool is_on = true;

 private:
  Relocaliser& relocaliser_;
};

}  // namespace

void SessionSettings::validate() const {
  fusion.validate();
  forest.validate();
}

/// What is saved, and replaced when another scene is loaded.
struct ReconstructionSession::Scene {
  Scene(const Context& context, const SessionSettings& settings, const Forest& forest)
      : relocaliser(context, forest, settings.forest), switched(relocaliser), pipeline(context, settings.fusion, &switched) {}

  ForestRelocaliser relocaliser;
  SwitchedRelocaliser switched;
  FusionPipeline pipeline;
};

ReconstructionSession::ReconstructionSession(const Context& context, const SessionSettings& settings, Forest forest)
    : context_(context), settings_(settings), forest_(std::move(forest)), uploader_(context) {
  settings.validate();
  scene_ = std::make_unique<Scene>(context_, settings_, forest_);
}

ReconstructionSession::~ReconstructionSession() = default;

FusionFrameResult ReconstructionSession::process(const RgbdFrame& frame) {
  return scene_->pipeline.process(uploader_.upload(frame.view()));
}

void ReconstructionSession::force_loss() { scene_->pipeline.force_loss(); }
void ReconstructionSession::reset() { scene_->pipeline.reset(); }

bool ReconstructionSession::relocalises() const { return scene_->switched.is_on; }
void ReconstructionSession::set_relocalises(bool on) { scene_->switched.is_on = on; }

const FusionPipeline& ReconstructionSession::pipeline() const { return scene_->pipeline; }
const SessionSettings& ReconstructionSession::settings() const { return settings_; }

std::size_t ReconstructionSession::state_bytes() const {
  return scene_->pipeline.volume().state_bytes() + scene_->relocaliser.state_bytes();
}

void ReconstructionSession::save(const std::string& path, const std::vector<SettingText>& provenance) const {
  SceneDescription description{scene_settings(settings_), provenance};
  description.provenance.push_back({"version", FOOTHOLD_VERSION});
  description.provenance.push_back({"saved", utc_now()});
  description.provenance.push_back({"forest", hexadecimal(forest_.fingerprint())});
  save_scene(path, description, {{kRelocaliserPart, &scene_->relocaliser}, {kReconstructionPart, &scene_->pipeline}});
}

std::vector<SettingText> ReconstructionSession::load(const std::string& path) {
  check_scene_settings(path, read_scene_description(path).settings, scene_settings(settings_));
  auto loaded = std::make_unique<Scene>(context_, settings_, forest_);
  const SceneDescription description =
      load_scene(path, {{kRelocaliserPart, &loaded->relocaliser}, {kReconstructionPart, &loaded->pipeline}});
  loaded->switched.is_on = scene_->switched.is_on;
  scene_ = std::move(loaded);
  return description.provenance;
}

}  // namespace foothold::apps
