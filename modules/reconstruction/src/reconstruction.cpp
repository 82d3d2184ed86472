// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/reconstruction/reconstruction.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <optional>

#include "foothold/api/background_relocaliser.h"
#include "foothold/base/error.h"
#include "map_limits.h"

namespace foothold {
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

/// A reconstruction's settings without a forest, under the names that they have with one.
struct FusionOnlySettings {
  FusionSettings fusion;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&FusionOnlySettings::fusion, "fusion");
  }
};

}  // namespace

/// A relocaliser that learns always, beside tracking, and answers while it is on.
class SwitchedRelocaliser final : public BackgroundRelocaliser {
 public:
  using BackgroundRelocaliser::BackgroundRelocaliser;

  std::vector<PoseEstimate> relocalise(const Frame& frame) override {
    return is_on ? BackgroundRelocaliser::relocalise(frame) : std::vector<PoseEstimate>();
  }

  bool is_on = true;
};

void ReconstructionSettings::validate() const {
  fusion.validate();
  forest.validate();
}

/// What is saved, and replaced when another scene is loaded.
struct Reconstruction::Scene {
  Scene(const Context& context, const FusionSettings& settings, std::unique_ptr<Relocaliser> the_relocaliser, Copy the_copy)
      : copy(the_copy), relocaliser(std::move(the_relocaliser)), pipeline(context, settings, decorate(context)) {}
  Scene(const Context& context, const Scene& other)
      : copy(other.copy), relocaliser(other.copied_relocaliser()), pipeline(other.pipeline, decorate(context)), limits(other.limits) {
    if (switched.has_value()) switched->is_on = other.switched->is_on;
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The relocaliser, or null, once it has learnt what it was given.
  Relocaliser* taught_relocaliser() const {
    if (switched.has_value()) switched->wait();
    return relocaliser.get();
  }
  std::unique_ptr<Relocaliser> copied_relocaliser() const {
    const Relocaliser* const taught = taught_relocaliser();
    return taught == nullptr ? nullptr : copy(*taught);
  }
  Relocaliser* decorate(const Context& context) { return relocaliser == nullptr ? nullptr : &switched.emplace(context, *relocaliser); }

  /// The parts of a scene file, as SavedPart or LoadedPart.
  template <class Part>
  std::vector<Part> parts() {
    std::vector<Part> result;
    // Whatever a reconstruction is made with is Persistent, too.
    Relocaliser* const taught = taught_relocaliser();
    if (taught != nullptr) result.push_back({kRelocaliserPart, dynamic_cast<Persistent*>(taught)});
    result.push_back({kReconstructionPart, &pipeline});
    return result;
  }

  Copy copy;                                    // null without a relocaliser
  std::unique_ptr<Relocaliser> relocaliser;     // may be learning: see taught_relocaliser()
  std::optional<SwitchedRelocaliser> switched;  // around the relocaliser
  FusionPipeline pipeline;
  MapLimits limits;
};

Reconstruction::Reconstruction(const Context& context, const ReconstructionSettings& settings, Forest forest)
    : Reconstruction(context, settings.fusion, ForestRelocaliser(context, std::move(forest), settings.forest)) {}

Reconstruction::Reconstruction(const Context& context, const FusionSettings& settings, ForestRelocaliser relocaliser)
    : Reconstruction(context, settings, std::make_unique<ForestRelocaliser>(std::move(relocaliser)), copy_of<ForestRelocaliser>) {
  const auto& made = static_cast<const ForestRelocaliser&>(*scene_->relocaliser);
  description_.settings = scene_settings(ReconstructionSettings{settings, made.settings()});
  description_.provenance.push_back({"forest", hexadecimal(made.forest().fingerprint())});
}

Reconstruction::Reconstruction(const Context& context, const FusionSettings& settings)
    : Reconstruction(context, settings, nullptr, nullptr) {}

Reconstruction::Reconstruction(const Context& context, const FusionSettings& settings, std::unique_ptr<Relocaliser> relocaliser, Copy copy)
    : context_(context),
      uploader_(context),
      description_{scene_settings(FusionOnlySettings{settings}), {{"version", FOOTHOLD_VERSION}}},
      scene_(std::make_unique<Scene>(context, settings, std::move(relocaliser), copy)) {}

Reconstruction::Reconstruction(const Reconstruction& other)
    : context_(other.context_),
      uploader_(context_),
      description_(other.description_),
      scene_(std::make_unique<Scene>(context_, *other.scene_)) {}

Reconstruction::~Reconstruction() = default;
Reconstruction::Reconstruction(Reconstruction&&) noexcept = default;
Reconstruction& Reconstruction::operator=(Reconstruction other) noexcept {
  std::swap(context_, other.context_);
  std::swap(uploader_, other.uploader_);
  std::swap(description_, other.description_);
  std::swap(scene_, other.scene_);
  return *this;
}

void Reconstruction::start_at(const SE3& world_from_camera) {
  scene_->pipeline.start_at(world_from_camera);
  scene_->limits.watch_reach(world_from_camera, scene_->pipeline.settings().volume, context_);
}

FusionFrameResult Reconstruction::process(const Frame& frame) {
  FusionFrameResult result = scene_->pipeline.process(uploader_.upload(frame));
  scene_->limits.watch(frame, scene_->pipeline.settings().volume, context_, result);
  return result;
}

void Reconstruction::force_loss() { scene_->pipeline.force_loss(); }
void Reconstruction::reset() {
  scene_->pipeline.reset();
  scene_->limits = {};
}

bool Reconstruction::relocalises() const { return scene_->switched.has_value() && scene_->switched->is_on; }
void Reconstruction::set_relocalises(bool on) {
  if (scene_->switched.has_value()) scene_->switched->is_on = on;
}

const FusionPipeline& Reconstruction::pipeline() const { return scene_->pipeline; }
void Reconstruction::wait_for_learning() const { scene_->taught_relocaliser(); }
std::size_t Reconstruction::relocaliser_bytes() const {
  const Relocaliser* const taught = scene_->taught_relocaliser();
  return taught == nullptr ? 0 : taught->state_bytes();
}

SceneDescription Reconstruction::describe(const std::vector<SettingText>& provenance) const {
  SceneDescription description{description_.settings, provenance};
  description.provenance.insert(description.provenance.end(), description_.provenance.begin(), description_.provenance.end());
  description.provenance.push_back({"saved", utc_now()});
  return description;
}

void Reconstruction::save(const std::string& path, const std::vector<SettingText>& provenance) const {
  save_scene(path, describe(provenance), scene_->parts<SavedPart>());
}

void Reconstruction::save(std::ostream& stream, const std::vector<SettingText>& provenance) const {
  write_scene(stream, describe(provenance), scene_->parts<SavedPart>());
}

void Reconstruction::check_settings(const std::string& name, const SceneDescription& scene) const {
  std::vector<SettingText> others;
  std::string differences;
  for (const SettingText& setting : description_.settings) {
    if (!shapes_the_scene(setting.path)) continue;
    const auto same_path = [&](const SettingText& other) { return other.path == setting.path; };
    const auto saved = std::find_if(scene.settings.begin(), scene.settings.end(), same_path);
    if (saved == scene.settings.end()) {
      throw FileError(name + ": does not tell " + setting.path + ": it comes from another version of Foothold");
    }
    if (saved->text == setting.text) continue;
    others.push_back(*saved);
    differences += (differences.empty() ? "" : ", ") + setting.path + " = " + saved->text + " instead of " + setting.text;
  }
  if (!others.empty()) throw OtherSceneSettings(name + ": the scene was made with other settings: " + differences, std::move(others));
}

std::unique_ptr<Reconstruction::Scene> Reconstruction::new_scene() const {
  std::unique_ptr<Relocaliser> relocaliser = scene_->copied_relocaliser();
  if (relocaliser != nullptr) relocaliser->reset();
  auto scene = std::make_unique<Scene>(context_, scene_->pipeline.settings(), std::move(relocaliser), scene_->copy);
  if (scene->switched.has_value()) scene->switched->is_on = scene_->switched->is_on;
  return scene;
}

/// @param read  Reads the parts that it is given, checked by what it is given.
template <class Read>
std::vector<SettingText> Reconstruction::replace_scene(const std::string& name, Read&& read) {
  std::unique_ptr<Scene> scene = new_scene();
  SceneDescription loaded =
      read(scene->template parts<LoadedPart>(), [&](const SceneDescription& description) { check_settings(name, description); });
  scene_ = std::move(scene);  // nothing behind it may throw
  return std::move(loaded.provenance);
}

std::vector<SettingText> Reconstruction::load(const std::string& path) {
  return replace_scene(path, [&](const std::vector<LoadedPart>& parts, const SceneCheck& check) { return load_scene(path, parts, check); });
}

std::vector<SettingText> Reconstruction::load(std::istream& stream, const std::string& name) {
  return replace_scene(
      name, [&](const std::vector<LoadedPart>& parts, const SceneCheck& check) { return read_scene(stream, name, parts, check); });
}

}  // namespace foothold
