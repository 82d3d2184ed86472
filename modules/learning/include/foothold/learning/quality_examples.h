// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Makes examples of right and wrong tracking, and of right and wrong relocalised poses, from recordings with known poses.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "foothold/api/frame_source.h"
#include "foothold/base/context.h"
#include "foothold/fusion/fusion_pipeline.h"
#include "foothold/learning/classifier_training.h"

namespace foothold {

/// Which frames are tried from which starts, how they are spoilt, and which results count as right or wrong.
struct QualityExampleSettings {
  /// Every so many frames are fused, with their true poses.
  int frame_stride = 4;
  /// Of the fused frames, every so many are first tried.
  int try_stride = 2;
  /// Of the frames that are never fused, every so many are tried on the finished map.
  int view_stride = 7;
  /// Of another recording's frames, every so many are tried on the finished map.
  int foreign_stride = 12;
  /// So many times, evenly spread over the mapped recording, the frames that are never fused are also tried on what is mapped until then:
  /// those of them of which between these parts fall on the map.
  int partial_maps = 3;
  float least_partial_overlap = 0.2F;  ///< the least of these parts, in [0, 1]
  float most_partial_overlap = 0.8F;   ///< the greatest of these parts, in [0, 1]
  /// Starts tried for a frame.
  int starts_per_frame = 8;
  /// Further starts for a frame, those of mined_from poses somewhere in the map that look most like the frame after coarse alignment.
  int mined_starts = 2;
  int mined_from = 12;  ///< poses that are looked at for them
  /// Part of the tried frames that are spoilt: by darkness, a covered lens or bursts of noise.
  float spoilt_part = 0.25F;
  /// Noise of the poses with which frames are fused, so that maps are as blurred as tracked ones; every third recording is fused without,
  /// and every third with twice as much.
  float map_noise_m = 0.003F;
  float map_noise_deg = 0.15F;  ///< likewise [deg]
  /// Wear of the camera: shifted colour, distorted depth, exposure that adjusts itself, blur. 1 is an old Kinect; every third recording has
  /// none, and every third half as much.
  float wear = 1.0F;
  /// Largest of the things that are in views but not in the map, as a part of the image's width; likewise.
  float strangers = 0.35F;
  /// Slow drift of the poses with which frames are fused, likewise. Results may be off by as much more.
  float drift_m = 0.015F;
  float drift_deg = 0.6F;  ///< likewise [deg]
  /// A result nearer to the truth than this is right.
  float right_m = 0.02F;
  float right_deg = 1.5F;  ///< likewise [deg]
  /// One further off than this is wrong; between the two it teaches nothing.
  float wrong_m = 0.05F;
  float wrong_deg = 5.0F;   ///< likewise [deg]
  std::uint64_t seed = 42;  ///< of every random choice

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    using S = QualityExampleSettings;
    v(&S::frame_stride, "frame_stride", "Every so many frames are fused.", Range{1, 1000});
    v(&S::try_stride, "try_stride", "Of these, every so many are tried.", Range{1, 1000});
    v(&S::view_stride, "view_stride", "Of the frames that are never fused, every so many are tried.", Range{1, 1000});
    v(&S::foreign_stride, "foreign_stride", "Of another recording's frames, every so many are tried.", Range{1, 1000});
    v(&S::partial_maps, "partial_maps", "Times at which they are also tried on what is mapped until then.", Range{0, 100});
    v(&S::least_partial_overlap, "least_partial_overlap", "Part of such a frame that falls on the map, at least.", Range{0.0, 1.0});
    v(&S::most_partial_overlap, "most_partial_overlap", "Part of such a frame that falls on the map, at most.", Range{0.0, 1.0});
    v(&S::starts_per_frame, "starts_per_frame", "Starts tried for a frame.", Range{1, 1000});
    v(&S::mined_starts, "mined_starts", "Further starts: those that look most like the frame.", Range{0, 1000});
    v(&S::mined_from, "mined_from", "Poses among which these are sought.", Range{1, 1000});
    v(&S::spoilt_part, "spoilt_part", "Part of the frames that are spoilt.", Range{0.0, 1.0});
    v(&S::map_noise_m, "map_noise_m", "Noise of the fused poses [m].", Range{0.0, 1.0});
    v(&S::map_noise_deg, "map_noise_deg", "Noise of the fused poses [deg].", Range{0.0, 90.0});
    v(&S::wear, "wear", "Wear of the camera, 1 for that of an old Kinect.", Range{0.0, 10.0});
    v(&S::strangers, "strangers", "Largest of the things that are not in the map, as a part of the image's width.", Range{0.0, 1.0});
    v(&S::drift_m, "drift_m", "Drift of the fused poses [m].", Range{0.0, 1.0});
    v(&S::drift_deg, "drift_deg", "Drift of the fused poses [deg].", Range{0.0, 90.0});
    v(&S::right_m, "right_m", "Results nearer to the truth are right [m].", Range{1e-4, 1.0});
    v(&S::right_deg, "right_deg", "Results nearer to the truth are right [deg].", Range{1e-3, 90.0});
    v(&S::wrong_m, "wrong_m", "Results further off are wrong [m].", Range{1e-4, 10.0});
    v(&S::wrong_deg, "wrong_deg", "Results further off are wrong [deg].", Range{1e-3, 180.0});
    v(&S::seed, "seed", "Seed of the starts.", Range{0.0, 18446744073709551615.0});
  }
  /// Throws InvalidSettings naming the field, its value and its range.
  void validate() const { validate_settings(*this); }
};

/// A map and what is tried on it.
struct QualityRecording {
  const Sequence* mapped = nullptr;   ///< fused with its true poses; each frame is tried before it is fused
  const Sequence* views = nullptr;    ///< other frames of the same world, tried on the finished map and on parts of it; may be null
  const Sequence* foreign = nullptr;  ///< frames of another world: whatever pose is found for them is wrong; may be null
  int group = 0;                      ///< given to every example
};

/// Examples for both classifiers.
struct QualityExamples {
  std::vector<ClassifierExample> tracking;    ///< values as of quality_features()
  std::vector<ClassifierExample> acceptance;  ///< values as of acceptance_features()
};

/// The number of frames that collect_quality_examples() goes through.
int num_example_frames(const QualityRecording& recording, const QualityExampleSettings& settings);

/// Fuses a recording with its true poses, and tries to track frames from starts that are right, a little wrong, wrong, taken from
/// elsewhere, and chosen for looking right. What counts is the error of the result: alignment may mend a bad start, or snap to a wrong
/// place.
///
/// Tracking renders the map at the start, as a tracker does at the last pose; acceptance refines the start, as is done with a relocaliser's
/// proposal. Nothing is right for a frame of a covered lens, and a noisy frame well aligned teaches nothing.
///
/// @param progress  Called after each frame with the number done; collecting stops when it returns false.
/// @pre `recording.mapped` is not null. Frames without a true pose are skipped.
/// Determinism: a function of recordings and settings.
void collect_quality_examples(const Context& context, const QualityRecording& recording, const FusionSettings& fusion,
                              const QualityExampleSettings& settings, QualityExamples& examples,
                              const std::function<bool(int)>& progress = {});

}  // namespace foothold
