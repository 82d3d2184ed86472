// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/forest_relocaliser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "examples/training_examples.h"
#include "foothold/base/checked_stream.h"
#include "foothold/base/contract.h"
#include "foothold/base/random.h"
#include "forest/device_forest.h"
#include "places/place_search.h"
#include "places/scene_limits.h"
#include "places/scene_places.h"

namespace foothold {
namespace {

constexpr BinaryFormat kSceneFormat{"scene of a forest relocaliser", "FHFSCENE",
                                    5};  // 3: place by place; 4: in pieces; 5: with the latest view

/// True if a frame has at least one block of pixels to average; smaller ones hold nothing to learn or to find.
bool has_blocks(const Frame& frame, const FeatureSettings& settings) {
  return frame.depth.height >= scaled_to_width(settings.downscale, frame.depth.width);
}

void expect_usable(const Context& context, const Frame& frame) {
  FOOTHOLD_EXPECTS_NO_ERROR(describe_frame_error(frame));
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
        places(context, forest.num_leaves(), settings),
        search(context, settings),
        limits(settings) {}

  /// @param explanation  Output: what the answer was made from; nullptr for none.
  std::vector<PoseEstimate> answer(const Frame& frame, Explanation* explanation);
  /// Makes room for a frame where memory is bounded, and says how much of it may be learnt.
  Detail detail(const Frame& frame);
  /// Chooses the examples of a frame that are new to a place.
  void sample(const Frame& frame, const SE3& world_from_camera, int examples_per_view, Place& place);
  /// @return True if the frame taught anything.
  bool learn(const Frame& frame, const SE3& world_from_camera);
  /// Spends one frame's budget of clustering on the place that learnt last. With nothing new, finds out whether anything was left to do.
  void cluster(bool has_learnt);

  Context context;
  Forest forest;
  ForestRelocaliserSettings settings;
  DeviceForest device_forest;
  FeatureImage image;
  TrainingExamples examples;
  ScenePlaces places;
  PlaceSearch search;
  SceneLimits limits;
  std::uint64_t num_frames = 0;    ///< learnt
  std::size_t learning_place = 0;  ///< the one that learnt last
};

std::vector<PoseEstimate> ForestRelocaliser::State::answer(const Frame& frame, Explanation* explanation) {
  expect_usable(context, frame);
  if (places.empty() || !has_blocks(frame, settings.features)) return {};
  {
    const ScopedStage stage(context, "relocalise/features");
    image.compute(context, frame, scaled_to_width(settings.features.downscale, frame.depth.width));
  }
  return search.find(context, {frame, image}, device_forest, places, explanation);
}

Detail ForestRelocaliser::State::detail(const Frame& frame) {
  if (!limits.bounds_memory()) return Detail::kFull;
  std::size_t bytes = places.count_bytes(learning_place);  // other places are as they were
  while (limits.is_full(bytes) && places.thin_largest()) {
    limits.watch_thinning(context, bytes, frame.index);
    bytes = places.count_bytes(learning_place);
  }
  return limits.detail(context, bytes, frame.index);
}

void ForestRelocaliser::State::sample(const Frame& frame, const SE3& world_from_camera, int examples_per_view, Place& place) {
  const ScopedStage stage(context, "train/sample");
  constexpr std::uint64_t kSamplingStream = 0;
  const std::uint64_t frame_seed = derive_seed(derive_seed(settings.seed, kSamplingStream), num_frames);
  const SE3 place_from_camera = place.place_from_camera(world_from_camera);
  sample_examples(context, frame, settings.reservoirs, place_from_camera, frame_seed, examples);
  const std::size_t num_offered = examples.pixels.size();
  place.learnt.keep_new(context, place_from_camera.translation, examples_per_view, examples);
  limits.watch_reach(context, place.learnt.num_beyond_reach(), num_offered, frame.index);
}

bool ForestRelocaliser::State::learn(const Frame& frame, const SE3& world_from_camera) {
  const Detail allowed = detail(frame);
  if (allowed == Detail::kNone) return false;
  learning_place = places.learning(world_from_camera.translation);
  Place& place = places[learning_place];
  sample(frame, world_from_camera, limits.examples_per_view(allowed), place);
  if (examples.pixels.empty()) {
    places.drop_unused(learning_place);
    return false;
  }
  ++num_frames;
  place.learnt.swap_offered(place.latest);
  {
    const ScopedStage stage(context, "train/features");
    image.compute(context, frame, scaled_to_width(settings.features.downscale, frame.depth.width));
    colour_examples(context, image, examples);
    examples.leaves.resize(examples.pixels.size() * static_cast<std::size_t>(forest.num_trees()));
    find_leaves(context, image, device_forest.view(), Span<const SampledPixel>(examples.pixels), Span<std::uint32_t>(examples.leaves));
  }
  const ScopedStage stage(context, "train/insert");
  place.reservoirs.insert(context, examples);
  place.is_used = true;
  place.is_settled = false;
  place.is_thin = false;
  return true;
}

void ForestRelocaliser::State::cluster(bool has_learnt) {
  if (learning_place >= places.size() || places[learning_place].is_settled) return;
  Place& place = places[learning_place];
  place.modes.update(context, place.reservoirs);
  place.is_settled = !has_learnt && place.modes.was_idle(context);
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
std::size_t ForestRelocaliser::state_bytes() const { return state().places.state_bytes(); }

void ForestRelocaliser::train(const Frame& frame, const SE3& world_from_camera) {
  State& s = state();
  expect_usable(s.context, frame);
  FOOTHOLD_EXPECTS_NO_ERROR(describe_pose_error(world_from_camera));
  if (!has_blocks(frame, s.settings.features)) return;
  const bool has_learnt = s.learn(frame, world_from_camera);
  const ScopedStage stage(s.context, "train/cluster");
  s.cluster(has_learnt);
}

void ForestRelocaliser::update() {
  const ScopedStage stage(state().context, "update/cluster");
  state().cluster(false);
}

std::vector<PoseEstimate> ForestRelocaliser::relocalise(const Frame& frame) { return state().answer(frame, nullptr); }

Explanation ForestRelocaliser::explain(const Frame& frame) {
  Explanation explanation;
  state().answer(frame, &explanation);
  return explanation;
}

void ForestRelocaliser::reset() {
  state().places.clear();
  state().num_frames = 0;
  state().learning_place = 0;
  state().limits = SceneLimits(state().settings);
}

void ForestRelocaliser::save(std::ostream& stream) const {
  const State& s = state();
  CheckedWriter writer(stream, kSceneFormat);
  writer.write(s.forest.fingerprint());
  writer.write(s.settings.reservoirs.capacity);
  writer.write(s.settings.clustering.max_modes);
  writer.write(s.num_frames);
  s.places.save(writer);
  writer.finish();
}

void ForestRelocaliser::load(std::istream& stream) {
  State& s = state();
  CheckedReader reader(stream, kSceneFormat);
  if (reader.read<std::uint64_t>("forest fingerprint") != s.forest.fingerprint()) {
    reader.refuse("learnt with another forest; load that forest first");
  }
  const auto capacity = reader.read<int>("reservoir capacity");
  const auto max_modes = reader.read<int>("number of modes");
  if (capacity != s.settings.reservoirs.capacity || max_modes != s.settings.clustering.max_modes) {
    reader.refuse("has reservoirs.capacity = " + std::to_string(capacity) + " and clustering.max_modes = " + std::to_string(max_modes) +
                  ", expected " + std::to_string(s.settings.reservoirs.capacity) + " and " +
                  std::to_string(s.settings.clustering.max_modes));
  }
  const auto num_frames = reader.read<std::uint64_t>("frame count");
  ScenePlaces places(s.context, s.forest.num_leaves(), s.settings);
  places.load(reader, num_frames);
  reader.finish();
  s.places = std::move(places);
  s.num_frames = num_frames;
  s.learning_place = 0;
  s.limits = SceneLimits(s.settings);
}

}  // namespace foothold
