// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include <algorithm>
#include <array>

#include "foothold/base/binary_stream.h"
#include "foothold/base/checksum.h"
#include "foothold/fusion/fusion_pipeline.h"

namespace foothold {
namespace {

constexpr std::array<char, 8> kMagic{'F', 'H', 'F', 'U', 'S', 'E', '\r', '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr float kRigidTolerance = 1e-3F;

/// What is saved besides the map, which follows.
struct Head {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t started = 0;
  std::array<float, 12> world_from_camera{};  ///< rotation by columns, translation
};
static_assert(sizeof(Head) == 64, "written as bytes");

std::array<float, 12> to_array(const SE3& transform) {
  std::array<float, 12> values{};
  std::copy_n(transform.rotation.data(), 9, values.begin());
  std::copy_n(transform.translation.data(), 3, values.begin() + 9);
  return values;
}

SE3 to_transform(const std::array<float, 12>& values) {
  SE3 transform;
  std::copy_n(values.begin(), 9, transform.rotation.data());
  std::copy_n(values.begin() + 9, 3, transform.translation.data());
  return transform;
}

Head read_head(std::istream& stream) {
  const auto head = read_value<Head>(stream, "head");
  if (head.magic != kMagic) throw FileError("reconstruction: not one of Foothold: unknown first bytes");
  if (head.version != kVersion) {
    throw FileError("reconstruction: got version " + std::to_string(head.version) + ", expected " + std::to_string(kVersion));
  }
  const auto checksum = read_value<std::uint64_t>(stream, "head");
  if (checksum != fnv1a(kFnvBasis, &head, sizeof(head)) || head.started > 1 ||
      !is_rigid(to_transform(head.world_from_camera), kRigidTolerance)) {
    throw FileError("reconstruction: damaged in its head");
  }
  return head;
}

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
  Head head;
  head.started = started_ ? 1 : 0;
  head.world_from_camera = to_array(world_from_camera_);
  write_value(stream, head);
  write_value(stream, fnv1a(kFnvBasis, &head, sizeof(head)));
  volume_.save(stream);
}

void FusionPipeline::load(std::istream& stream) {
  const Head head = read_head(stream);
  TsdfVolume volume(context_, settings_.volume);
  volume.load(stream);
  check_settings(volume.settings(), settings_.volume);
  volume_ = std::move(volume);
  rendering_ = SurfaceMap(context_.memory());
  world_from_camera_ = to_transform(head.world_from_camera);
  started_ = head.started != 0;
  loss_forced_ = false;
  policy_.reset();
  if (started_) policy_.update(TrackingQuality::kFailed, RelocalisationOutcome::kNothing);
}

}  // namespace foothold
