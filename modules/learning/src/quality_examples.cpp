// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/learning/quality_examples.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "foothold/base/contract.h"
#include "foothold/base/random.h"
#include "foothold/fusion/tracking_quality.h"
#include "spoilt_frame.h"
#include "worn_camera.h"

namespace foothold {

namespace {

constexpr float kDegPerRad = 57.29578F;

/// How far off a start is: the largest rotation and translation.
struct StartKind {
  float rotation_deg;
  float translation_m;
};
/// Good tracking, fast motion, failing tracking, proposals of a relocaliser gone wrong. A start beyond these is another frame's pose.
constexpr StartKind kStartKinds[] = {{0.7F, 0.01F}, {3.0F, 0.05F}, {10.0F, 0.15F}, {30.0F, 0.4F}, {60.0F, 1.0F}};
constexpr int kNumStartKinds = 5;
/// Where looks alone decide: near a pose from which the map was seen.
constexpr StartKind kMinedKind = {25.0F, 0.4F};
constexpr int kMinedDivisor = 8;
constexpr int kMinedLevel = 3;  // of the pyramid: 2^3 = kMinedDivisor

Eigen::Vector3f random_direction(Random& random) {
  for (;;) {
    Eigen::Vector3f v;  // drawn in statements: the order of arguments is the compiler's
    for (const int axis : {2, 1, 0}) v[axis] = random.uniform(-1.0F, 1.0F);
    const float norm = v.norm();
    if (norm > 0.1F && norm <= 1.0F) return v / norm;
  }
}

SE3 perturb(const SE3& world_from_camera, const StartKind& kind, Random& random) {
  Tangent6 tangent;
  const float angle_rad = random.uniform() * kind.rotation_deg / kDegPerRad;
  tangent.head<3>() = random_direction(random) * angle_rad;
  const float distance_m = random.uniform() * kind.translation_m;
  tangent.tail<3>() = random_direction(random) * distance_m;
  SE3 result = world_from_camera * se3_exp(tangent);
  result.rotation = nearest_rotation(result.rotation);
  return result;
}

Spoilage draw_spoilage(float spoilt_part, Random& random) {
  if (random.uniform() >= spoilt_part) return Spoilage::kNone;
  constexpr Spoilage kKinds[] = {Spoilage::kDark, Spoilage::kCovered, Spoilage::kNoise};
  return kKinds[random.below(3)];
}

/// How the result of a trial is called.
enum class Verdict {
  kByError,     ///< right if near the truth, wrong if far from it
  kNeverRight,  ///< wrong if far from the truth, else nothing is learnt
  kWrong        ///< whatever it is
};

Verdict verdict_of(Spoilage spoilage) {
  switch (spoilage) {
    case Spoilage::kNone:
    case Spoilage::kDark:
      return Verdict::kByError;
    case Spoilage::kNoise:
      return Verdict::kNeverRight;
    case Spoilage::kCovered:
      return Verdict::kWrong;
  }
  return Verdict::kWrong;
}

/// How bad a recording is, of three grades: 0 for none of what settings allow, 1 for all of it.
float grade_of(int group) { return 0.5F * static_cast<float>(group % 3); }

class Collector {
 public:
  Collector(const Context& context, const FusionSettings& fusion, const QualityExampleSettings& settings, int group, Random random,
            QualityExamples& examples)
      : fusion_(fusion),
        settings_(settings),
        group_(group),
        grade_(grade_of(group)),
        camera_(grade_ * settings.wear, random),
        drift_(grade_ * settings.drift_m, grade_ * settings.drift_deg, random),
        examples_(examples),
        volume_(context, fusion.volume),
        raycaster_(context),
        icp_(context, IcpLevels::for_divisor(fusion.render_divisor), fusion.volume.depth_range()),
        mining_icp_(context, IcpLevels{kMinedLevel, kMinedLevel}, fusion.volume.depth_range()),
        comparer_(context, fusion.volume.depth_range()),
        refiner_(context, fusion.refiner, fusion.volume.depth_range()),
        map_(context.memory()) {}

  bool has_map() const { return !mapped_.empty(); }

  /// Takes a frame of the map's recording as the camera and its tracker would have seen it.
  void prepare_mapped(RgbdFrame& frame, int frame_index, Random& random) {
    camera_.wear(frame, random);
    frame.world_from_camera = drift_.apply(*frame.world_from_camera, frame_index);
  }

  void fuse(const RgbdFrame& frame, Random& random) {
    const StartKind noise = {4.0F * grade_ * settings_.map_noise_deg, 4.0F * grade_ * settings_.map_noise_m};
    volume_.integrate(frame.view(), perturb(*frame.world_from_camera, noise, random));
    mapped_.push_back(*frame.world_from_camera);
  }

  /// Takes a frame of another recording by the same camera.
  void prepare_other(RgbdFrame& frame, Random& random) {
    camera_.wear(frame, random);
    add_strangers(frame, grade_ * settings_.strangers, random);
  }

  /// Tries a frame of the map's world.
  void try_frame(RgbdFrame frame, Random& random) {
    const Spoilage spoilage = draw_spoilage(settings_.spoilt_part, random);
    spoil(frame, spoilage, random);
    const Verdict verdict = verdict_of(spoilage);
    begin(frame);
    for (int i = 0; i < settings_.starts_per_frame; ++i) {
      const int kind = static_cast<int>(random.below(kNumStartKinds + 1));
      const SE3 start = kind < kNumStartKinds ? perturb(*frame.world_from_camera, kStartKinds[kind], random) : draw_mapped(random);
      try_tracking(frame, start, verdict);
      try_acceptance(frame, start, verdict);
    }
    for (const SE3& start : mine(frame, random)) try_acceptance(frame, start, verdict);
  }

  /// Whether a part of a frame is mapped, and a part is not.
  bool is_partly_mapped(const RgbdFrame& frame) {
    if (!has_map()) return false;
    comparer_.set_frame(frame.view());
    render(frame, *frame.world_from_camera, fusion_.render_divisor);
    const float overlap = comparer_.compare(map_, *frame.world_from_camera).overlap;
    return overlap > settings_.least_partial_overlap && overlap < settings_.most_partial_overlap;
  }

  /// Tries a frame of another world, where everything is wrong.
  void try_foreign(RgbdFrame frame, Random& random) {
    spoil(frame, draw_spoilage(settings_.spoilt_part, random), random);
    begin(frame);
    for (const SE3& start : mine(frame, random)) {
      try_tracking(frame, draw_mapped(random), Verdict::kWrong);
      try_acceptance(frame, start, Verdict::kWrong);
    }
  }

 private:
  void begin(const RgbdFrame& frame) {
    icp_.set_frame(frame.view());
    mining_icp_.set_frame(frame.view());
    comparer_.set_frame(frame.view());
  }

  const SE3& draw_mapped(Random& random) const { return mapped_[random.below(static_cast<std::uint32_t>(mapped_.size()))]; }

  void render(const RgbdFrame& frame, const SE3& world_from_camera, int divisor) {
    const RenderCamera camera{frame.calibration.depth, frame.depth.width(), frame.depth.height(), world_from_camera};
    raycaster_.render(volume_, camera.reduced(divisor), map_, true);
  }

  /// Poses somewhere in the map that look most like the frame.
  std::vector<SE3> mine(const RgbdFrame& frame, Random& random) {
    std::vector<std::pair<float, SE3>> found;
    for (int i = 0; i < settings_.mined_from; ++i) {
      const SE3 start = perturb(draw_mapped(random), kMinedKind, random);
      render(frame, start, kMinedDivisor);
      const TrackingResult aligned = mining_icp_.track(map_, start);
      const ViewAgreement view = comparer_.compare(map_, aligned.world_from_camera);
      found.emplace_back(-view.overlap * view.agreement, aligned.world_from_camera);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<SE3> best;
    for (int i = 0; i < std::min(settings_.mined_starts, settings_.mined_from); ++i)
      best.push_back(found[static_cast<std::size_t>(i)].second);
    return best;
  }

  void try_tracking(const RgbdFrame& frame, const SE3& start, Verdict verdict) {
    render(frame, start, fusion_.render_divisor);
    const TrackingResult tracked = icp_.track(map_, start);
    if (!tracked.measures.well_posed) return;  // has failed without a classifier
    const std::array<float, 4> values = quality_features(tracked.measures);
    add(examples_.tracking, {values.begin(), values.end()}, tracked.world_from_camera, frame, verdict);
    // The pipeline also asks the acceptance classifier about tracked poses, in the rendering from the pose before.
    const ViewAgreement agreement = comparer_.compare(map_, tracked.world_from_camera);
    if (agreement.overlap < kMinOverlap || agreement.colour_correlation == 0.0F) return;
    const std::array<float, kNumAcceptanceFeatures> view = acceptance_features(tracked.measures, agreement);
    add(examples_.acceptance, {view.begin(), view.end()}, tracked.world_from_camera, frame, verdict);
  }

  void try_acceptance(const RgbdFrame& frame, const SE3& start, Verdict verdict) {
    const RefinedPose refined = refiner_.refine_one(frame.view(), volume_, start);
    if (!refined.measures.well_posed || refined.agreement.overlap < kMinOverlap) return;  // refused without a classifier
    if (refined.agreement.colour_correlation == 0.0F) return;                             // so are poses in the dark
    const std::array<float, kNumAcceptanceFeatures> values = acceptance_features(refined.measures, refined.agreement);
    add(examples_.acceptance, {values.begin(), values.end()}, refined.world_from_camera, frame, verdict);
  }

  void add(std::vector<ClassifierExample>& examples, std::vector<float> values, const SE3& found, const RgbdFrame& frame,
           Verdict verdict) const {
    const SE3& truth = *frame.world_from_camera;
    const float distance_m = translation_distance_m(found, truth);
    const float angle_deg = rotation_distance_rad(found, truth) * kDegPerRad;
    const float drift_m = grade_ * settings_.drift_m;
    const float drift_deg = grade_ * settings_.drift_deg;
    const bool near = distance_m < settings_.right_m + drift_m && angle_deg < settings_.right_deg + drift_deg;
    const bool far = distance_m > settings_.wrong_m + drift_m || angle_deg > settings_.wrong_deg + drift_deg;
    const bool right = verdict == Verdict::kByError && near;
    if (right || far || verdict == Verdict::kWrong) examples.push_back({std::move(values), right, distance_m, angle_deg, group_});
  }

  const FusionSettings& fusion_;
  const QualityExampleSettings& settings_;
  int group_;
  float grade_;
  WornCamera camera_;
  PoseDrift drift_;
  QualityExamples& examples_;
  TsdfVolume volume_;
  Raycaster raycaster_;
  IcpTracker icp_;
  IcpTracker mining_icp_;
  ViewComparer comparer_;
  PoseRefiner refiner_;
  SurfaceMap map_;
  std::vector<SE3> mapped_;
};

}  // namespace

int num_example_frames(const QualityRecording& recording, const QualityExampleSettings& settings) {
  const auto count = [](const Sequence* sequence, int stride) {
    return sequence != nullptr ? (sequence->num_frames() + stride - 1) / stride : 0;
  };
  return count(recording.mapped, settings.frame_stride) + (settings.partial_maps + 1) * count(recording.views, settings.view_stride) +
         count(recording.foreign, settings.foreign_stride);
}

void collect_quality_examples(const Context& context, const QualityRecording& recording, const FusionSettings& fusion,
                              const QualityExampleSettings& settings, QualityExamples& examples, const std::function<bool(int)>& progress) {
  FOOTHOLD_EXPECTS(recording.mapped != nullptr);
  settings.validate();
  fusion.validate();
  const std::uint64_t seed = derive_seed(settings.seed, static_cast<std::uint64_t>(recording.group));
  constexpr std::uint64_t kCameraStream = 3;  // after those of the three kinds of frames
  constexpr std::uint64_t kFirstPartialStream = 4;
  Collector collector(context, fusion, settings, recording.group, Random(seed, kCameraStream), examples);
  int num_done = 0;
  bool stopped = false;
  // Goes through the frames with a true pose.
  const auto each = [&](const Sequence* sequence, int stride, std::uint64_t stream, const auto& take) {
    for (int i = 0; sequence != nullptr && !stopped && i < sequence->num_frames(); i += stride) {
      Random random(seed, derive_seed(stream, static_cast<std::uint64_t>(i)));
      RgbdFrame frame = sequence->load(i);
      if (frame.world_from_camera) take(std::move(frame), random, i);
      if (!stopped && progress && !progress(++num_done)) stopped = true;
    }
  };
  const auto try_views = [&](std::uint64_t stream, const auto& is_tried) {
    each(recording.views, settings.view_stride, stream, [&](RgbdFrame frame, Random& random, int) {
      if (!is_tried(frame)) return;
      collector.prepare_other(frame, random);
      collector.try_frame(std::move(frame), random);
    });
  };
  const auto num_parts_before = [&](int index) { return index * (settings.partial_maps + 1) / recording.mapped->num_frames(); };
  each(recording.mapped, settings.frame_stride, 0, [&](RgbdFrame frame, Random& random, int index) {
    collector.prepare_mapped(frame, index, random);
    if (collector.has_map() && index / settings.frame_stride % settings.try_stride == 0) collector.try_frame(frame, random);
    collector.fuse(frame, random);
    const int next = std::min(index + settings.frame_stride, recording.mapped->num_frames() - 1);
    for (int part = num_parts_before(index); part < num_parts_before(next); ++part)
      try_views(kFirstPartialStream + static_cast<std::uint64_t>(part),
                [&](const RgbdFrame& view) { return collector.is_partly_mapped(view); });
  });
  if (stopped || !collector.has_map()) return;
  try_views(1, [](const RgbdFrame&) { return true; });
  each(recording.foreign, settings.foreign_stride, 2, [&](RgbdFrame frame, Random& random, int) {
    collector.prepare_other(frame, random);
    collector.try_foreign(std::move(frame), random);
  });
}

}  // namespace foothold
