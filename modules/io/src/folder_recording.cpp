// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "folder_recording.h"

#include <algorithm>
#include <cmath>

#include "camera_model.h"
#include "exr_header.h"
#include "exr_image.h"
#include "foothold/base/contract.h"
#include "foothold/frames/register_colour.h"
#include "foothold/io/recording_check.h"
#include "image_decoding.h"
#include "lost_identities.h"
#include "raw_image.h"
#include "recording_conventions.h"
#include "text_file.h"
#include "undistortion.h"
#include "unreadable_frames.h"

namespace foothold::io {
namespace {

namespace fs = std::filesystem;

/// Recordings whose first pose is further from their origin are shown relative to it: at a kilometre, single precision still resolves a
/// sixteenth of a millimetre.
constexpr double kFar_m = 1000.0;

ImageSize size_of(const StoredImage& image, const ImageSize& raw_size) {
  if (image.coding == ImageCoding::kExr) return parse_exr_header(read_stored_image(image), image.file).size;
  if (image.coding != ImageCoding::kFile) return raw_size;
  const std::optional<ImageHeader> header = parse_image_header(read_stored_image(image));
  if (!header.has_value()) throw_file_error(image.file, "a damaged or empty image", "a complete PNG or JPEG image");
  return header->size;
}

float in_metres(std::uint16_t value, float units_per_m) {
  constexpr std::uint16_t kInvalid = 65535;
  return value == kInvalid ? 0.0F : static_cast<float>(value) / units_per_m;
}
float in_metres(float value, float units_per_m) { return std::isfinite(value) && value > 0.0F ? value / units_per_m : 0.0F; }

template <class T>
void check_size(const Image<T>& image, const ImageSize& expected, const fs::path& file) {
  const ImageSize size{image.width(), image.height()};
  if (size != expected) throw OtherImage(file, to_string(size) + " pixels", to_string(expected) + " as in the first frame");
}

class FolderRecording : public Recording {
 public:
  FolderRecording(FoundRecording found, const Context& context, const SequenceOptions& options, const RecordingCalibration& calibration)
      : unreadable_(found, context),
        found_(std::move(found)),
        depth_size_(calibration.depth.size),
        colour_size_(calibration.colour.size),
        depth_lens_(calibration.depth),
        colour_lens_(calibration.colour),
        registers_(options.register_colour || depth_size_ != colour_size_) {
    const auto [units_per_m, unit_source] = settle_depth_unit(found_, calibration, options);
    facts_ = {found_.folder.string(),
              found_.layout,
              depth_size_.width,
              depth_size_.height,
              colour_size_.width,
              colour_size_.height,
              calibration.pinholes(),
              calibration.source,
              to_string(calibration.depth.distortion),
              to_string(calibration.colour.distortion),
              units_per_m,
              unit_source,
              found_.frames.front().depth.coding == ImageCoding::kExr,
              {},
              {},
              {}};
    settle_poses(settle_pose_convention(found_, options));
  }

  std::string name() const override { return recording_name(found_.folder); }
  int num_frames() const override { return static_cast<int>(found_.frames.size()); }
  const RecordingFacts& facts() const override { return facts_; }
  Eigen::Vector3d origin_m() const override { return origin_m_; }

  Image<float> load_depth(int index) const override {
    const StoredImage& stored = frame_at(index).depth;
    const std::string bytes = read_stored_image(stored);
    if (stored.coding == ImageCoding::kExr) return depth_of(decode_exr(bytes, stored.file), stored.file);
    return depth_of(
        stored.coding == ImageCoding::kFile ? decode_u16(bytes, stored.file) : decode_raw_depth(bytes, stored, found_.raw_depth_size),
        stored.file);
  }

  RgbdFrame load(int index) const override {
    RgbdFrame frame;
    frame.calibration = facts_.calibration;
    frame.index = index;
    frame.timestamp_s = frame_at(index).timestamp_s;
    frame.world_from_camera = facts_.world_from_camera[static_cast<std::size_t>(index)];
    if (unreadable_.contains(index)) {
      clear_images(frame);
    } else {
      try {
        frame.depth = load_depth(index);
        frame.colour = load_colour(index);
      } catch (const OtherImage&) {
        throw;
      } catch (const FileError& error) {
        if (!unreadable_.add(index, error)) throw;
        clear_images(frame);
      }
    }
    if (registers_) register_colour(frame);
    return frame;
  }

 private:
  /// Depth in metres, as a pinhole would have seen it.
  template <class T>
  Image<float> depth_of(Image<T> raw, const fs::path& file) const {
    check_size(raw, depth_size_, file);
    depth_lens_.apply(raw);
    Image<float> depth(raw.width(), raw.height());
    const auto units_per_m = static_cast<float>(facts_.depth_units_per_m);
    std::transform(raw.data(), raw.data() + raw.size(), depth.data(), [&](T value) { return in_metres(value, units_per_m); });
    return depth;
  }

  Image<Rgb8> load_colour(int index) const {
    const StoredImage& stored = frame_at(index).colour;
    Image<Rgb8> colour = stored.coding == ImageCoding::kFile ? decode_rgb(read_stored_image(stored), stored.file)
                                                             : decode_raw_colour(read_stored_image(stored), stored, found_.raw_colour_size);
    check_size(colour, colour_size_, stored.file);
    colour_lens_.apply(colour);
    return colour;
  }

  /// Makes a frame without depth.
  void clear_images(RgbdFrame& frame) const {
    frame.depth = Image<float>(depth_size_.width, depth_size_.height);
    frame.colour = Image<Rgb8>(colour_size_.width, colour_size_.height);
  }

  const RecordedFrame& frame_at(int index) const {
    FOOTHOLD_EXPECTS(index >= 0 && index < num_frames());
    return found_.frames[static_cast<std::size_t>(index)];
  }

  /// Poses in Foothold's convention, relative to the first where that lies far out.
  void settle_poses(const PoseConvention& convention) {
    facts_.pose_convention = to_string(convention);
    bool any = false;
    for (const RecordedFrame& frame : found_.frames) {
      facts_.times_s.push_back(frame.timestamp_s);
      if (!frame.pose.has_value()) {
        facts_.world_from_camera.emplace_back();
        continue;
      }
      const RecordedPose pose = apply(convention, *frame.pose);
      if (!any && pose.translation_m.norm() > kFar_m) origin_m_ = pose.translation_m.array().round();
      any = true;
      facts_.world_from_camera.push_back(to_se3(pose, origin_m_));
    }
  }

  mutable UnreadableFrames unreadable_;
  FoundRecording found_;
  ImageSize depth_size_;
  ImageSize colour_size_;
  Undistortion depth_lens_;
  Undistortion colour_lens_;
  bool registers_;
  RecordingFacts facts_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();
};

/// What a user should know of how a recording is read.
std::string describe(const RecordingFacts& facts, const ImageSize& depth_size) {
  std::string text = facts.folder + ": " + facts.layout + ", " + std::to_string(facts.times_s.size()) + " frames of " +
                     to_string(depth_size) + "; intrinsics " + to_string(facts.calibration.depth) + " (" + facts.calibration_source +
                     "); depth in " + depth_unit_text(facts) + " (" + facts.depth_unit_source + ")";
  if (facts.depth_distortion != "none") text += "; distortion " + facts.depth_distortion + " is corrected";
  if (facts.pose_convention != "as-is") text += "; poses read as " + facts.pose_convention;
  return text;
}

void warn_of_missing_poses(const RecordingFacts& facts, bool tells_poses, const Context& context) {
  const auto& poses = facts.world_from_camera;
  const auto num_missing = std::count_if(poses.begin(), poses.end(), [](const std::optional<SE3>& pose) { return !pose.has_value(); });
  if (num_missing == 0 || !tells_poses) return;
  if (num_missing == static_cast<std::ptrdiff_t>(poses.size())) {
    context.log(LogLevel::kWarning,
                facts.folder + ": none of its " + std::to_string(poses.size()) + " frames has a pose: tracking was lost in all");
    return;
  }
  const auto first = std::find_if(poses.begin(), poses.end(), [](const std::optional<SE3>& pose) { return !pose.has_value(); });
  context.log(LogLevel::kWarning, facts.folder + ": " + std::to_string(num_missing) + " of its " + std::to_string(poses.size()) +
                                      " frames have no pose, the first of them frame " + std::to_string(first - poses.begin()));
}

}  // namespace
}  // namespace foothold::io

std::string foothold::depth_unit_text(const RecordingFacts& facts) {
  return facts.depth_units_per_m == 1.0 ? "metres" : "1/" + io::numbers_text(&facts.depth_units_per_m, 1) + " m";
}

namespace foothold::io {

std::shared_ptr<Recording> make_recording(FoundRecording found, const Context& context, const SequenceOptions& options) {
  const ImageSize depth_size = size_of(found.frames.front().depth, found.raw_depth_size);
  const ImageSize colour_size = size_of(found.frames.front().colour, found.raw_colour_size);
  const RecordingCalibration calibration = find_calibration(found.folder, found.calibration, depth_size, colour_size, options);
  const bool tells_poses = found.tells_poses;
  drop_lost_identities(found.frames, found.folder.string(), context);
  auto recording = std::make_shared<FolderRecording>(std::move(found), context, options, calibration);
  context.log(LogLevel::kInfo, describe(recording->facts(), depth_size));
  if (!calibration.warning.empty()) context.log(LogLevel::kWarning, calibration.warning);
  warn_of_missing_poses(recording->facts(), tells_poses, context);
  if (!options.check) return recording;
  for (const std::string& warning : check_recording(*recording).warnings) context.log(LogLevel::kWarning, warning);
  return recording;
}

std::string recording_name(const fs::path& folder) {
  fs::path path = fs::absolute(folder).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  const std::string name = path.filename().string();
  const std::string parent = path.parent_path().filename().string();
  return name.rfind("seq-", 0) == 0 && !parent.empty() ? parent + "/" + name : name;
}

}  // namespace foothold::io
