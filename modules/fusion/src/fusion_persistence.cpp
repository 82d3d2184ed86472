// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/checked_stream.h"
#include "foothold/fusion/fusion_pipeline.h"

namespace foothold {
namespace {

constexpr BinaryFormat kReconstructionFormat{"reconstruction", "FHFUSE\r\n", 2};

/// A map goes on only as it began: voxels of another size mean another thing.
void check_settings(const TsdfSettings& saved, const TsdfSettings& expected) {
  const std::vector<SettingDescription> a = describe_settings(saved);
  const std::vector<SettingDescription> b = describe_settings(expected);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].value == b[i].value) continue;
    throw FileError("the map was made with " + a[i].path + " = " + a[i].value + ", expected " + b[i].value +
                    ", as the settings have it: change that setting of the volume to " + a[i].value + " to go on with this map");
  }
}

}  // namespace

void FusionPipeline::save(std::ostream& stream) const {
  CheckedWriter writer(stream, kReconstructionFormat);
  writer.write(started_);
  writer.write_transform(world_from_camera_);
  writer.finish();
  volume_.save(stream);
}

void FusionPipeline::load(std::istream& stream) {
  CheckedReader reader(stream, kReconstructionFormat);
  const auto started = reader.read<std::uint8_t>("state");
  reader.check_range("for whether it has begun", started, 0, 1);
  const SE3 world_from_camera = reader.read_transform("pose");
  reader.finish();
  TsdfVolume volume(context_, settings_.volume);
  volume.load(stream);
  check_settings(volume.settings(), settings_.volume);
  if (started == 0 && volume.num_blocks() != 0) {
    reader.refuse("has not begun, but has a map of " + std::to_string(volume.num_blocks()) + " blocks");
  }
  policy_.reset();  // may run out of memory; nothing behind it can
  volume_ = std::move(volume);
  rendering_ = SurfaceMap(context_.memory());
  world_from_camera_ = world_from_camera;
  started_ = started != 0;
  loss_forced_ = false;
  candidates_.clear();
  if (started_) policy_.update(TrackingQuality::kFailed, RelocalisationOutcome::kNothing);
}

}  // namespace foothold
