// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/forest_relocaliser.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "clustering/leaf_modes.h"
#include "foothold/base/binary_stream.h"
#include "foothold/base/checksum.h"
#include "foothold/base/contract.h"
#include "forest/device_forest.h"
#include "pose/confidence.h"
#include "pose/explain.h"
#include "pose/pose_estimator.h"
#include "reservoirs/leaf_reservoirs.h"

namespace foothold {
namespace {

constexpr std::uint64_t kSceneMagic = 0x454e454353484fULL;
constexpr std::uint32_t kSceneVersion = 2;  // 2: checksummed
constexpr float kRigidTolerance = 1e-2F;

/// Reads the reservoirs' and modes' bytes, which stand behind their size and checksum, in bounded steps: a lying size must not exhaust
/// memory.
std::string read_body(std::istream& stream) {
  constexpr std::uint64_t kStep = 1U << 20U;
  const auto size = read_value<std::uint64_t>(stream, "size");
  const auto expected = read_value<std::uint64_t>(stream, "checksum");
  std::string body;
  while (body.size() < size) {
    const std::size_t old_size = body.size();
    const std::size_t step = std::min(kStep, size - old_size);
    body.resize(old_size + step);
    stream.read(&body[old_size], static_cast<std::streamsize>(step));
    if (!stream) throw FileError("the saved scene is truncated; expected " + std::to_string(size) + " bytes behind its header");
  }
  const std::uint64_t checksum = fnv1a(kFnvBasis, body.data(), body.size());
  if (checksum != expected) {
    throw FileError("the saved scene is damaged; its checksum is " + std::to_string(checksum) + ", expected " + std::to_string(expected));
  }
  return body;
}

/// True if a frame has at least one block of pixels to average; smaller ones hold nothing to learn or to find.
bool has_blocks(const Frame& frame, const FeatureSettings& settings) {
  return frame.depth.height >= scaled_to_width(settings.downscale, frame.depth.width);
}

void expect_usable(const Context& context, const Frame& frame) {
  FOOTHOLD_EXPECTS(describe_frame_error(frame).empty());
  FOOTHOLD_EXPECTS(frame.depth.memory == context.memory());
}

}  // namespace

struct ForestRelocaliser::State {
  State(const Context& the_context, Forest the_forest, const ForestRelocaliserSettings& the_settings)
      : context(the_context),
        forest(std::move(the_forest)),
        settings(the_settings),
        device_forest(context.memory(), forest, settings.num_rolls),
        image(context),
        examples(context.memory()),
        reservoirs(context, forest.num_leaves(), settings.reservoirs, settings.seed),
        modes(context, forest.num_leaves(), settings.clustering),
        estimator(context, SearchPlan(settings.pose, settings.seed)) {}

  /// @param explanation  Output: what the answer was made from; nullptr for none.
  std::vector<PoseEstimate> answer(const Frame& frame, Explanation* explanation);
  /// Rolls but the upright one from which an answer is to be expected, the most promising first.
  std::vector<int> promising_rolls(const PoseQuery& query);
  /// Estimates as seen by a camera with one of the forest's rolls.
  std::vector<PoseEstimate> attempt(const PoseQuery& query, int roll);
  bool is_sure(const std::vector<PoseEstimate>& estimates) const {
    return !estimates.empty() && estimates.front().confidence >= settings.sure_confidence;
  }

  Context context;
  Forest forest;
  ForestRelocaliserSettings settings;
  DeviceForest device_forest;
  FeatureImage image;
  TrainingExamples examples;
  LeafReservoirs reservoirs;
  LeafModes modes;
  PoseEstimator estimator;
};

std::vector<PoseEstimate> ForestRelocaliser::State::answer(const Frame& frame, Explanation* explanation) {
  expect_usable(context, frame);
  if (reservoirs.num_frames() == 0 || !has_blocks(frame, settings.features)) return {};
  {
    const ScopedStage stage(context, "relocalise/features");
    image.compute(context, frame, scaled_to_width(settings.features.downscale, frame.depth.width));
  }
  const PoseQuery query{frame, image, reservoirs.view(), modes.view()};
  estimator.prepare(context, query);
  std::vector<PoseEstimate> best;
  const auto try_roll = [&](int roll) {
    std::vector<PoseEstimate> estimates = attempt(query, roll);
    if (estimates.empty() || (!best.empty() && estimates.front().confidence <= best.front().confidence)) return;
    best = std::move(estimates);
    if (explanation != nullptr) *explanation = foothold::explain(estimator, best, reservoirs.origin_world());
  };
  try_roll(0);
  if (is_sure(best)) return best;
  for (const int roll : promising_rolls(query)) {
    try_roll(roll);
    if (is_sure(best)) break;
  }
  return best;
}

std::vector<int> ForestRelocaliser::State::promising_rolls(const PoseQuery& query) {
  std::vector<ForestView> forests;
  for (int roll = 1; roll < device_forest.num_rolls(); ++roll) forests.push_back(device_forest.view(roll));
  const std::vector<std::uint32_t> counts = estimator.count_hypotheses(context, query, forests);
  const auto count_of = [&](int roll) { return counts[static_cast<std::size_t>(roll) - 1]; };
  std::vector<int> rolls;
  for (int roll = 1; roll < device_forest.num_rolls(); ++roll) {
    if (count_of(roll) > 0) rolls.push_back(roll);
  }
  std::stable_sort(rolls.begin(), rolls.end(), [&](int a, int b) { return count_of(a) > count_of(b); });
  return rolls;
}

std::vector<PoseEstimate> ForestRelocaliser::State::attempt(const PoseQuery& query, int roll) {
  std::vector<PoseEstimate> estimates;
  for (const PoseCandidate& candidate : estimator.estimate(context, query, device_forest.view(roll))) {
    SE3 world_from_camera = candidate.scene_from_camera;
    world_from_camera.rotation = nearest_rotation(world_from_camera.rotation);
    world_from_camera.translation += reservoirs.origin_world();
    // Candidates behind the best were not aligned, and must not appear surer than it is.
    const float confidence = confidence_of(candidate);
    estimates.push_back({world_from_camera, estimates.empty() ? confidence : std::min(confidence, estimates.front().confidence)});
  }
  return estimates;
}

ForestRelocaliser::ForestRelocaliser(const Context& context, Forest forest, const ForestRelocaliserSettings& settings) {
  settings.validate();
  state_ = std::make_unique<State>(context, std::move(forest), settings);
}

ForestRelocaliser::~ForestRelocaliser() = default;
ForestRelocaliser::ForestRelocaliser(ForestRelocaliser&&) noexcept = default;
ForestRelocaliser& ForestRelocaliser::operator=(ForestRelocaliser&&) noexcept = default;
ForestRelocaliser::ForestRelocaliser(const ForestRelocaliser& other)
    : Relocaliser(other), Persistent(other), state_(std::make_unique<State>(other.state())) {}
ForestRelocaliser& ForestRelocaliser::operator=(const ForestRelocaliser& other) {
  state_ = std::make_unique<State>(other.state());
  return *this;
}

ForestRelocaliser::State& ForestRelocaliser::state() const {
  const bool was_moved_from = state_ == nullptr;
  FOOTHOLD_EXPECTS(!was_moved_from);
  return *state_;
}

const Forest& ForestRelocaliser::forest() const { return state().forest; }
const ForestRelocaliserSettings& ForestRelocaliser::settings() const { return state().settings; }
float ForestRelocaliser::acceptance_threshold() const { return state().settings.acceptance_threshold; }
std::size_t ForestRelocaliser::state_bytes() const { return state().reservoirs.state_bytes() + state().modes.state_bytes(); }

void ForestRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  State& s = state();
  expect_usable(s.context, frame);
  FOOTHOLD_EXPECTS(is_rigid(world_from_camera, kRigidTolerance));
  if (!has_blocks(frame, s.settings.features)) return;
  {
    const ScopedStage stage(s.context, "train/features");
    s.image.compute(s.context, frame, scaled_to_width(s.settings.features.downscale, frame.depth.width));
    s.reservoirs.sample(s.context, frame, s.image, world_from_camera, s.examples);
    s.examples.leaves.resize(s.examples.pixels.size() * static_cast<std::size_t>(s.forest.num_trees()));
    find_leaves(s.context, s.image, s.device_forest.view(), Span<const SampledPixel>(s.examples.pixels),
                Span<std::uint32_t>(s.examples.leaves));
  }
  {
    const ScopedStage stage(s.context, "train/insert");
    s.reservoirs.insert(s.context, s.examples);
  }
  const ScopedStage stage(s.context, "train/cluster");
  s.modes.update(s.context, s.reservoirs);
}

void ForestRelocaliser::update() {
  const ScopedStage stage(state().context, "update/cluster");
  state().modes.update(state().context, state().reservoirs);
}

std::vector<PoseEstimate> ForestRelocaliser::relocalise(const Frame& frame) { return state().answer(frame, nullptr); }

Explanation ForestRelocaliser::explain(const Frame& frame) {
  Explanation explanation;
  state().answer(frame, &explanation);
  return explanation;
}

void ForestRelocaliser::reset() {
  state().reservoirs.clear();
  state().modes.clear();
}

void ForestRelocaliser::save(std::ostream& stream) const {
  const State& s = state();
  write_value(stream, kSceneMagic);
  write_value(stream, kSceneVersion);
  write_value(stream, s.forest.fingerprint());
  write_value(stream, s.settings.reservoirs.capacity);
  write_value(stream, s.settings.clustering.max_modes);
  std::ostringstream body_stream;
  s.reservoirs.save(body_stream);
  s.modes.save(body_stream);
  const std::string body = body_stream.str();
  write_value(stream, static_cast<std::uint64_t>(body.size()));
  write_value(stream, fnv1a(kFnvBasis, body.data(), body.size()));
  stream.write(body.data(), static_cast<std::streamsize>(body.size()));
  if (!stream) throw FileError("the relocaliser's scene could not be written: the stream failed");
}

void ForestRelocaliser::load(std::istream& stream) {
  State& s = state();
  if (read_value<std::uint64_t>(stream, "magic") != kSceneMagic) throw FileError("the saved scene is not one of a forest relocaliser");
  const auto version = read_value<std::uint32_t>(stream, "version");
  if (version != kSceneVersion) {
    throw FileError("the saved scene has version " + std::to_string(version) + ", expected " + std::to_string(kSceneVersion));
  }
  if (read_value<std::uint64_t>(stream, "forest fingerprint") != s.forest.fingerprint()) {
    throw FileError("the saved scene was learnt with another forest; load that forest first");
  }
  const auto capacity = read_value<int>(stream, "reservoir capacity");
  const auto max_modes = read_value<int>(stream, "number of modes");
  if (capacity != s.settings.reservoirs.capacity || max_modes != s.settings.clustering.max_modes) {
    throw FileError("the saved scene has reservoirs.capacity = " + std::to_string(capacity) +
                    " and clustering.max_modes = " + std::to_string(max_modes) + ", expected " +
                    std::to_string(s.settings.reservoirs.capacity) + " and " + std::to_string(s.settings.clustering.max_modes));
  }
  LeafReservoirs reservoirs(s.context, s.forest.num_leaves(), s.settings.reservoirs, s.settings.seed);
  LeafModes modes(s.context, s.forest.num_leaves(), s.settings.clustering);
  std::istringstream body(read_body(stream));
  reservoirs.load(body);
  modes.load(body);
  s.reservoirs = std::move(reservoirs);
  s.modes = std::move(modes);
}

}  // namespace foothold
