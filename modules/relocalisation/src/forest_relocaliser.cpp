// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/relocalisation/forest_relocaliser.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "examples/training_examples.h"
#include "foothold/base/binary_stream.h"
#include "foothold/base/checksum.h"
#include "foothold/base/contract.h"
#include "foothold/base/random.h"
#include "forest/device_forest.h"
#include "places/place_search.h"
#include "places/scene_places.h"

namespace foothold {
namespace {

constexpr std::uint64_t kSceneMagic = 0x454e454353484fULL;
constexpr std::uint32_t kSceneVersion = 3;  // 3: place by place
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
        places(context, forest.num_leaves(), settings),
        search(context, settings) {}

  /// @param explanation  Output: what the answer was made from; nullptr for none.
  std::vector<PoseEstimate> answer(const Frame& frame, Explanation* explanation);
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

bool ForestRelocaliser::State::learn(const Frame& frame, const SE3& world_from_camera) {
  learning_place = places.learning(world_from_camera.translation);
  Place& place = places[learning_place];
  {
    const ScopedStage stage(context, "train/sample");
    constexpr std::uint64_t kSamplingStream = 0;
    const std::uint64_t frame_seed = derive_seed(derive_seed(settings.seed, kSamplingStream), num_frames);
    const SE3 place_from_camera = place.place_from_camera(world_from_camera);
    sample_examples(context, frame, settings.reservoirs, place_from_camera, frame_seed, examples);
    place.learnt.keep_new(context, place_from_camera.translation, settings.reservoirs.examples_per_view, examples);
  }
  if (examples.pixels.empty()) {
    places.drop_unused(learning_place);
    return false;
  }
  ++num_frames;
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
  FOOTHOLD_EXPECTS(is_rigid(world_from_camera, kRigidTolerance));
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
}

void ForestRelocaliser::save(std::ostream& stream) const {
  const State& s = state();
  write_value(stream, kSceneMagic);
  write_value(stream, kSceneVersion);
  write_value(stream, s.forest.fingerprint());
  write_value(stream, s.settings.reservoirs.capacity);
  write_value(stream, s.settings.clustering.max_modes);
  std::ostringstream body_stream;
  write_value(body_stream, s.num_frames);
  s.places.save(body_stream);
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
  ScenePlaces places(s.context, s.forest.num_leaves(), s.settings);
  std::istringstream body(read_body(stream));
  const auto num_frames = read_value<std::uint64_t>(body, "frame count");
  places.load(body);
  s.places = std::move(places);
  s.num_frames = num_frames;
  s.learning_place = 0;
}

}  // namespace foothold
