// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// A reconstruction with its relocaliser, which can be saved and goes on another day.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "foothold/frames/frame_uploader.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/io/scene_file.h"
#include "foothold/relocalisation/forest_relocaliser.h"

namespace foothold::apps {

struct SessionSettings {
  FusionSettings fusion;
  ForestRelocaliserSettings forest;

  template <class Visitor>
  static void fields(Visitor& v) {
    v(&SessionSettings::fusion, "fusion");
    v(&SessionSettings::forest, "forest");
  }
  /// @throws InvalidSettings
  void validate() const;
};

/// A FusionPipeline and the ForestRelocaliser that it trains and asks.
class ReconstructionSession {
 public:
  /// @throws InvalidSettings; DeviceError
  ReconstructionSession(const Context& context, const SessionSettings& settings, Forest forest = default_forest());
  ~ReconstructionSession();
  ReconstructionSession(const ReconstructionSession&) = delete;
  ReconstructionSession& operator=(const ReconstructionSession&) = delete;

  /// Takes the next frame, copying it to the device where that has a memory of its own. @pre The frame has an image, in host memory.
  FusionFrameResult process(const RgbdFrame& frame);
  /// Makes tracking of the next frame fail.
  void force_loss();
  /// Forgets the scene.
  void reset();

  /// Whether the relocaliser is asked when tracking is lost. It learns in any case.
  bool relocalises() const;
  void set_relocalises(bool on);

  /// Saves map, pose, what the relocaliser has learnt, and the settings. The file of that name is replaced once all is written.
  /// @param provenance  for people: where the frames came from, and the like; version, time and forest are added. @throws FileError
  void save(const std::string& path, const std::vector<SettingText>& provenance) const;

  /// Goes on with a saved scene: the camera counts as lost until it is found there. On failure everything stays as it was.
  /// @return The provenance.
  /// @throws FileError for a file that is missing, damaged, or made with another forest or other settings that scenes depend on; the
  /// message says how to set those.
  std::vector<SettingText> load(const std::string& path);

  const FusionPipeline& pipeline() const;
  const SessionSettings& settings() const;
  /// Memory held for map and relocaliser [bytes].
  std::size_t state_bytes() const;

 private:
  struct Scene;

  Context context_;
  SessionSettings settings_;
  Forest forest_;
  std::unique_ptr<Scene> scene_;
  FrameUploader uploader_;
};

}  // namespace foothold::apps
