// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "tum_sequence.h"

#include <array>
#include <cctype>
#include <cmath>

#include "calibration_file.h"
#include "foothold/base/contract.h"
#include "frame_images.h"
#include "text_file.h"
#include "trajectory.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// Depth images count fifths of a millimetre, in both data sets.
constexpr float kDepthUnitsPerM = 5000.0F;
/// Images further apart than this are not of one frame; half the time between frames and a little.
constexpr double kMaxPairDifference_s = 0.02;
/// Longest silence of the ground truth to interpolate over: ten samples of the motion capture system, three frames of a moving camera.
constexpr double kMaxPoseGap_s = 0.1;
/// ICL-NUIM counts frames instead of seconds.
constexpr double kIclFrameRate_hz = 30.0;

constexpr Intrinsics kIclNuim{481.20F, 480.0F, 319.5F, 239.5F};
constexpr Intrinsics kRosDefault{525.0F, 525.0F, 319.5F, 239.5F};
/// Of the benchmark's three cameras, from its page on file formats. Lens distortion is left as it is (the third has none).
constexpr std::array<Intrinsics, 3> kFreiburg{
    {{517.3F, 516.5F, 318.6F, 255.3F}, {520.9F, 521.0F, 325.1F, 249.7F}, {535.4F, 539.2F, 320.1F, 247.6F}}};

/// The camera that a folder's name tells, as in "rgbd_dataset_freiburg1_xyz" or "fr3_office".
Intrinsics intrinsics_by_name(const std::string& name) {
  for (const std::string prefix : {"freiburg", "fr"}) {
    for (std::size_t at = name.find(prefix); at != std::string::npos; at = name.find(prefix, at + 1)) {
      const std::size_t digit = at + prefix.size();
      const bool number_ends = digit + 1 >= name.size() || std::isdigit(static_cast<unsigned char>(name[digit + 1])) == 0;
      if (digit < name.size() && name[digit] >= '1' && name[digit] <= '3' && number_ends) {
        return kFreiburg[static_cast<std::size_t>(name[digit] - '1')];
      }
    }
  }
  return kRosDefault;
}

/// A frame of the recording.
struct TumFrame {
  ImagePair images;
  std::optional<SE3> world_from_camera;
};

/// What a folder's files say.
struct TumFolder {
  fs::path path;
  fs::path ground_truth;  ///< empty without one
  bool is_icl_nuim = false;
};

TumFolder inspect(const fs::path& path) {
  TumFolder folder;
  folder.path = path;
  if (fs::exists(path / "groundtruth.txt")) folder.ground_truth = path / "groundtruth.txt";
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    const std::string name = entry.path().filename().string();
    constexpr std::string_view kSuffix = ".gt.freiburg";
    if (name.size() < kSuffix.size() || name.compare(name.size() - kSuffix.size(), kSuffix.size(), kSuffix) != 0) continue;
    if (folder.is_icl_nuim) throw FileError(path.string() + ": got several *.gt.freiburg files, expected one");
    folder.is_icl_nuim = true;
    folder.ground_truth = entry.path();
  }
  return folder;
}

std::vector<ImagePair> read_pairs(const fs::path& folder, const Context& context) {
  const auto read_list = [&](const char* name) { return parse_image_list(read_file(folder / name, kMaxListFileBytes), folder / name); };
  if (!fs::exists(folder / "rgb.txt") && !fs::exists(folder / "depth.txt")) {
    const fs::path file = folder / "associations.txt";
    return parse_associations(read_file(file, kMaxListFileBytes), file);
  }
  const std::vector<StampedFile> depth = read_list("depth.txt");
  std::vector<ImagePair> pairs = associate(depth, read_list("rgb.txt"), kMaxPairDifference_s);
  if (pairs.empty()) throw_file_error(folder / "depth.txt", "no time within 20 ms of one in rgb.txt", "images of one recording");
  if (pairs.size() < depth.size()) {
    context.log(LogLevel::kInfo, folder.string() + ": " + std::to_string(depth.size() - pairs.size()) + " of " +
                                     std::to_string(depth.size()) + " depth images left out: no colour image within 20 ms");
  }
  return pairs;
}

/// ICL-NUIM's world and camera have y upwards, and so a negative focal length. Mirroring both along y gives our camera and, since a pose
/// M T M is rigid again, an equivalent world.
SE3 mirror_y(const SE3& pose) {
  const Eigen::Vector3f mirror(1.0F, -1.0F, 1.0F);
  return {mirror.asDiagonal() * pose.rotation * mirror.asDiagonal(), mirror.asDiagonal() * pose.translation};
}

void check_exists(const fs::path& file, const char* list) {
  if (!fs::exists(file)) throw FileError(file.string() + ": no such file, but " + list + " lists it");
}

std::vector<TumFrame> read_frames(const TumFolder& folder, const Context& context, const SequenceOptions& options) {
  std::vector<StampedPose> trajectory;
  if (!folder.ground_truth.empty()) trajectory = parse_trajectory(read_file(folder.ground_truth, kMaxListFileBytes), folder.ground_truth);
  std::vector<TumFrame> frames;
  std::size_t num_without_pose = 0;
  for (const ImagePair& pair : read_pairs(folder.path, context)) {
    check_exists(folder.path / pair.depth.name, "a list beside it");
    check_exists(folder.path / pair.colour.name, "a list beside it");
    TumFrame frame{pair, interpolate(trajectory, pair.depth.timestamp_s, kMaxPoseGap_s)};
    if (frame.world_from_camera && folder.is_icl_nuim) frame.world_from_camera = mirror_y(*frame.world_from_camera);
    if (!frame.world_from_camera) ++num_without_pose;
    if (frame.world_from_camera || trajectory.empty() || !options.only_with_pose) frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw_file_error(folder.ground_truth, "no pose at the time of any frame", "the ground truth of this recording");
  if (num_without_pose > 0 && !trajectory.empty()) {
    context.log(LogLevel::kWarning, folder.ground_truth.string() + ": says nothing about " + std::to_string(num_without_pose) +
                                        " frames, which " + (options.only_with_pose ? "are left out" : "come without a pose"));
  }
  return frames;
}

class TumSequence : public Sequence {
 public:
  TumSequence(const TumFolder& folder, std::vector<TumFrame> frames, const SequenceOptions& options)
      : folder_(folder), frames_(std::move(frames)), options_(options) {
    const fs::path file = folder.path / "camera-intrinsics.txt";
    if (fs::exists(file)) {
      calibration_.depth = parse_intrinsics(read_file(file, kMaxNumbersFileBytes), file);
    } else {
      calibration_.depth = folder.is_icl_nuim ? kIclNuim : intrinsics_by_name(recording_name(folder.path));
    }
    calibration_.colour = calibration_.depth;
  }

  std::string name() const override { return recording_name(folder_.path); }
  int num_frames() const override { return static_cast<int>(frames_.size()); }

  RgbdFrame load(int index) const override {
    FOOTHOLD_EXPECTS(index >= 0 && index < num_frames());
    const TumFrame& source = frames_[static_cast<std::size_t>(index)];
    RgbdFrame frame;
    frame.calibration = calibration_;
    frame.index = index;
    frame.timestamp_s = source.images.depth.timestamp_s / (folder_.is_icl_nuim ? kIclFrameRate_hz : 1.0);
    frame.world_from_camera = source.world_from_camera;
    read_frame_images(folder_.path / source.images.colour.name, folder_.path / source.images.depth.name, kDepthUnitsPerM, options_, frame);
    return frame;
  }

 private:
  TumFolder folder_;
  std::vector<TumFrame> frames_;
  SequenceOptions options_;
  RgbdCalibration calibration_;
};

}  // namespace

bool looks_like_tum(const fs::path& folder) {
  return fs::exists(folder / "rgb.txt") || fs::exists(folder / "depth.txt") || fs::exists(folder / "associations.txt");
}

std::unique_ptr<Sequence> open_tum(const fs::path& folder, const Context& context, const SequenceOptions& options) {
  const TumFolder inspected = inspect(folder);
  std::vector<TumFrame> frames = read_frames(inspected, context, options);
  return std::make_unique<TumSequence>(inspected, std::move(frames), options);
}

}  // namespace foothold::io
