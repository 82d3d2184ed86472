// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A whole reconstruction, which can be saved and goes on another day: what a program needs that has a camera and no tracker.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "foothold/base/persistent.h"
#include "foothold/files/scene_file.h"
#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/relocalisation/forest_relocaliser.h"

namespace foothold {

/// Those of the parts.
struct ReconstructionSettings {
  FusionSettings fusion;             ///< of the tracker and the map
  ForestRelocaliserSettings forest;  ///< of the relocaliser

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    v(&ReconstructionSettings::fusion, "fusion");
    v(&ReconstructionSettings::forest, "forest");
  }
  /// @throws InvalidSettings
  void validate() const;
};

/// A scene was made under other settings than those of the reconstruction, under which its voxels and leaves mean something else.
class OtherSceneSettings : public FileError {
 public:
  /// With what differs in words, and the scene's settings that differ.
  OtherSceneSettings(const std::string& message, std::vector<SettingText> settings) : FileError(message), settings_(std::move(settings)) {}
  /// Those that differ, as the scene has them: a reconstruction with these can go on with it (assign_setting()).
  const std::vector<SettingText>& settings() const { return settings_; }

 private:
  std::vector<SettingText> settings_;
};

/// Tracks a camera, maps what it sees, and finds it again when it was lost: a FusionPipeline with the relocaliser that it teaches and asks.
///
/// The relocaliser learns a frame while that frame is fused and rendered, and the next is tracked (BackgroundRelocaliser): so process() may
/// return before it has learnt, and what learning throws is thrown by a later call. Whatever looks at the relocaliser waits for it.
///
/// One object serves one thread of control. Copies are independent in everything, for experiments that branch off.
/// Determinism: a function of settings, forest and frames alone, whether the relocaliser learns beside or in between.
class Reconstruction {
 public:
  /// With a forest relocaliser. @throws InvalidSettings, DeviceError
  explicit Reconstruction(const Context& context, const ReconstructionSettings& settings = {}, Forest forest = default_forest());
  /// With a relocaliser that was made before. @pre It works on the context. @throws InvalidSettings, DeviceError
  Reconstruction(const Context& context, const FusionSettings& settings, ForestRelocaliser relocaliser);
  /// The same of another kind, whose settings saved scenes do not tell.
  /// @tparam Kind  A Relocaliser that is Persistent and can be copied.
  template <class Kind>
  Reconstruction(const Context& context, const FusionSettings& settings, Kind relocaliser)
      : Reconstruction(context, settings, std::make_unique<Kind>(std::move(relocaliser)), copy_of<Kind>) {
    static_assert(std::is_base_of_v<Relocaliser, Kind> && std::is_base_of_v<Persistent, Kind>);
  }
  /// Without a relocaliser: a lost camera is found only where it was last seen. @throws InvalidSettings, DeviceError
  Reconstruction(const Context& context, const FusionSettings& settings);
  ~Reconstruction();
  /// Copies the map and what the relocaliser has learnt.
  Reconstruction(const Reconstruction& other);
  /// What was moved from may only be assigned to or destroyed.
  Reconstruction(Reconstruction&& other) noexcept;
  /// Copies or takes over the map and what the relocaliser has learnt.
  Reconstruction& operator=(Reconstruction other) noexcept;

  /// Sets the pose of the first frame; the identity otherwise. @pre No frame was processed since construction or reset().
  void start_at(const SE3& world_from_camera);
  /// Takes the next frame, in host memory or the context's; it is copied to the device where that has a memory of its own. Its images are
  /// free when the call returns. The context's log is warned once when the map is full, and once if most depth lies outside its range.
  FusionFrameResult process(const Frame& frame);
  /// Returns once the relocaliser has learnt every frame that it was given. Only measurements need it. @throws What learning threw.
  void wait_for_learning() const;
  /// Makes tracking of the next frame fail, whatever it shows: for tests and benchmarks.
  void force_loss();
  /// Forgets the scene.
  void reset();

  /// Whether the relocaliser is asked when tracking is lost. It learns in any case.
  bool relocalises() const;
  /// Has the relocaliser asked, or not, when tracking is lost.
  void set_relocalises(bool on);

  /// Saves map, pose, what the relocaliser has learnt, and the settings, in the form of docs/scene-format.md. A file of that name is
  /// replaced once all is written.
  /// @param provenance  For people: where the frames came from, and the like; version, forest and time are added. @throws FileError
  void save(const std::string& path, const std::vector<SettingText>& provenance = {}) const;
  /// The same to a stream. @throws FileError
  void save(std::ostream& stream, const std::vector<SettingText>& provenance = {}) const;

  /// Goes on with a saved scene: the camera counts as lost until it is found there. On failure everything stays as it was.
  /// @return The provenance.
  /// @throws FileError for a scene that is missing, damaged, or made with another forest; OtherSceneSettings.
  std::vector<SettingText> load(const std::string& path);
  /// The same from a stream. @param name  Stands for it in messages.
  std::vector<SettingText> load(std::istream& stream, const std::string& name);

  /// Map, rendering, state and settings.
  const FusionPipeline& pipeline() const;
  /// Memory of what the relocaliser learnt [bytes]; 0 without one. That of the map is pipeline().volume().state_bytes().
  std::size_t relocaliser_bytes() const;

 private:
  struct Scene;
  using Copy = std::unique_ptr<Relocaliser> (*)(const Relocaliser&);

  template <class Kind>
  static std::unique_ptr<Relocaliser> copy_of(const Relocaliser& relocaliser) {
    return std::make_unique<Kind>(static_cast<const Kind&>(relocaliser));
  }

  Reconstruction(const Context& context, const FusionSettings& settings, std::unique_ptr<Relocaliser> relocaliser, Copy copy);
  /// An empty scene with a relocaliser that has learnt nothing.
  std::unique_ptr<Scene> new_scene() const;
  SceneDescription describe(const std::vector<SettingText>& provenance) const;
  void check_settings(const std::string& name, const SceneDescription& scene) const;
  template <class Read>
  std::vector<SettingText> replace_scene(const std::string& name, Read&& read);

  Context context_;
  FrameUploader uploader_;
  SceneDescription description_;  // all settings, and what is known of a scene's provenance before it is saved
  std::unique_ptr<Scene> scene_;
};

}  // namespace foothold
