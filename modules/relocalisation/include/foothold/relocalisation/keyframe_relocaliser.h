// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Random ferns: relocalisation by the most similar keyframe, the baseline that the forest is measured against.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "foothold/api/relocaliser.h"
#include "foothold/base/context.h"
#include "foothold/base/persistent.h"
#include "foothold/base/settings.h"

namespace foothold {

/// How frames are encoded, kept and recognised. (P): [Glocker2015]. (T): fitted to the loss protocol with gaps of 0 to 30 frames on
/// 7-Scenes RedKitchen seq-01 and TUM fr3/teddy together, where 9 of 10 proposals above the acceptance threshold were right.
struct KeyframeRelocaliserSettings {
  int num_ferns = 500;                 ///< ferns of four binary depth tests each (P)
  int encoded_width_px = 40;           ///< images are halved until they are about this wide (P)
  float smoothing_sigma_px = 2.5F;     ///< of the Gaussian that smooths the halved image (P)
  float min_threshold_m = 0.8F;        ///< least depth that a test compares with: a Kinect's nominal range [m]
  float max_threshold_m = 4.0F;        ///< greatest depth that a test compares with: a Kinect's nominal range [m]
  float min_valid_fraction = 0.1F;     ///< of the halved image; frames with less depth are ignored
  float harvest_dissimilarity = 0.2F;  ///< a frame less dissimilar from some keyframe becomes none (P)
  int max_keyframes = 100000;          ///< kept at most
  int num_candidates = 1;              ///< nearest keyframes whose poses are proposed (P)
  float confidence_midpoint = 0.1F;    ///< dissimilarity at which a proposal is as likely right as wrong (T)
  float confidence_spread = 0.05F;     ///< how gently confidence falls around its midpoint (T)
  float acceptance_threshold = 0.75F;  ///< confidence from which a host should believe the first proposal (T)
  std::uint64_t seed = 42;             ///< of the tests' places and thresholds

  /// Shows each field to the visitor, with its name, what it means and its range.
  template <class Visitor>
  static void fields(Visitor& v) {
    using S = KeyframeRelocaliserSettings;
    v(&S::num_ferns, "num_ferns", "Ferns of four binary depth tests each (P).", Range{16, 8192});
    v(&S::encoded_width_px, "encoded_width_px", "Images are halved until they are about this wide (P).", Range{8, 640});
    v(&S::smoothing_sigma_px, "smoothing_sigma_px", "Standard deviation of the Gaussian that smooths the halved image (P).",
      Range{0.1, 20});
    v(&S::min_threshold_m, "min_threshold_m", "Least depth that a test compares with: a Kinect's nominal range.", Range{0, 100});
    v(&S::max_threshold_m, "max_threshold_m", "Greatest depth that a test compares with: a Kinect's nominal range.", Range{0, 100});
    v(&S::min_valid_fraction, "min_valid_fraction", "Frames of which less of the halved image has depth are ignored.", Range{0, 1});
    v(&S::harvest_dissimilarity, "harvest_dissimilarity", "A frame becomes a keyframe unless one is less dissimilar than this (P).",
      Range{0, 1});
    v(&S::max_keyframes, "max_keyframes", "Keyframes kept; once reached, none are added.", Range{1, 10000000});
    v(&S::num_candidates, "num_candidates", "Nearest keyframes whose poses are proposed; the baseline has 1 (P).", Range{1, 1000});
    v(&S::confidence_midpoint, "confidence_midpoint", "Dissimilarity at which a proposal is as likely right as wrong (T).", Range{0, 1});
    v(&S::confidence_spread, "confidence_spread", "How gently the confidence falls around its midpoint (T).", Range{0.0001, 1});
    v(&S::acceptance_threshold, "acceptance_threshold", "Confidence from which a host should believe the first proposal (T).", Range{0, 1});
    v(&S::seed, "seed", "Seed of the tests' places and thresholds.", Range{0, 1.8446744073709552e19});
  }
  /// @throws InvalidSettings naming the field, its value and its range.
  void validate() const;
};

/// Proposes the pose of the keyframe whose fern code is most like the frame's.
///
/// A frame's depth image is halved to about 40x30 pixels and smoothed, both skipping holes; each fern compares it with a threshold at four
/// random places and so yields four bits. The dissimilarity of two frames is the fraction of ferns whose bits differ. Only depth is used.
///
/// Determinism: a function of the frames and settings alone; one thread.
/// Cost:        one pass over the image and 256 bytes per keyframe; no allocation after warm-up except for new keyframes.
/// Reference:   [Glocker2015]; test places cover the whole image.
class KeyframeRelocaliser final : public Relocaliser, public Persistent {
 public:
  /// Works on the host whatever the context's device; frames in CUDA memory are copied. @throws InvalidSettings
  explicit KeyframeRelocaliser(const Context& context, const KeyframeRelocaliserSettings& settings = {});
  ~KeyframeRelocaliser() override;
  /// What was moved from may only be assigned to or destroyed.
  KeyframeRelocaliser(KeyframeRelocaliser&&) noexcept;
  /// What was moved from may only be assigned to or destroyed.
  KeyframeRelocaliser& operator=(KeyframeRelocaliser&&) noexcept;
  /// Copies the scene too, for experiments that branch off.
  KeyframeRelocaliser(const KeyframeRelocaliser&);
  /// Copies the scene too.
  KeyframeRelocaliser& operator=(const KeyframeRelocaliser&);

  void train(const Frame& frame, const SE3& world_from_camera) override;
  std::vector<PoseEstimate> relocalise(const Frame& frame) override;
  void update() override {}
  void reset() override;
  std::size_t state_bytes() const override;
  float acceptance_threshold() const override;

  void save(std::ostream& stream) const override;
  void load(std::istream& stream) override;

  /// Keyframes kept so far.
  std::size_t num_keyframes() const;
  /// As given to the constructor.
  const KeyframeRelocaliserSettings& settings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace foothold
