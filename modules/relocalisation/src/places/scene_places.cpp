// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/scene_places.h"

#include <string>

#include "examples/surface_pieces.h"
#include "foothold/base/checked_stream.h"
#include "foothold/base/random.h"

namespace foothold {
namespace {
constexpr std::uint64_t kMostLatestPoints = std::uint64_t{1} << kExampleBits;
}  // namespace

Place ScenePlaces::make_place(const Eigen::Vector3f& origin_world) const {
  const std::uint64_t seed = places_.empty() ? settings_.seed : derive_seed(settings_.seed, places_.size());
  return {origin_world, LearntViews(context_.memory()), LeafReservoirs(context_, num_leaves_, settings_.reservoirs, seed),
          LeafModes(context_, num_leaves_, settings_.clustering), Array<ReservoirPoint>(context_.memory())};
}

std::size_t ScenePlaces::learning(const Eigen::Vector3f& camera_world) {
  std::size_t nearest = places_.size();
  float smallest = settings_.place_radius_m;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const float distance = (places_[i].origin_world - camera_world).norm();
    if (distance > smallest) continue;
    smallest = distance;
    nearest = i;
  }
  if (nearest == places_.size()) places_.push_back(make_place(camera_world));
  return nearest;
}

void ScenePlaces::drop_unused(std::size_t place) {
  if (!places_[place].is_used) places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(place));
}

std::size_t ScenePlaces::state_bytes() const {
  std::size_t sum = 0;
  for (const Place& place : places_) sum += place.state_bytes(context_);
  return sum;
}

std::size_t ScenePlaces::count_bytes(std::size_t place) {
  if (place < places_.size()) places_[place].counted_bytes = places_[place].state_bytes(context_);
  std::size_t sum = 0;
  for (const Place& each : places_) sum += each.counted_bytes;
  return sum;
}

bool ScenePlaces::thin_largest() {
  for (;;) {
    Place* largest = nullptr;
    for (Place& place : places_) {
      if (!place.is_thin && (largest == nullptr || place.counted_bytes > largest->counted_bytes)) largest = &place;
    }
    if (largest == nullptr) return false;
    largest->is_thin = !largest->reservoirs.thin(context_, settings_.clustering.min_cluster_size);
    if (largest->is_thin) continue;
    largest->counted_bytes = largest->state_bytes(context_);
    return true;
  }
}

void ScenePlaces::save(CheckedWriter& writer) const {
  writer.write(static_cast<std::uint64_t>(places_.size()));
  for (const Place& place : places_) {
    for (int k = 0; k < 3; ++k) writer.write(place.origin_world[k]);
    place.learnt.save(writer);
    place.reservoirs.save(writer);
    place.modes.save(writer);
    writer.write_array(place.latest.to_host());
  }
}

void ScenePlaces::load(CheckedReader& reader, std::uint64_t num_frames) {
  const auto num_places = reader.read<std::uint64_t>("number of places");
  reader.check_range("places", num_places, 0, num_frames);  // a frame begins one at most
  places_.clear();
  for (std::uint64_t i = 0; i < num_places; ++i) {
    Eigen::Vector3f origin_world;
    for (int k = 0; k < 3; ++k) origin_world[k] = reader.read<float>("origin of a place");
    if (!origin_world.allFinite()) reader.refuse("has a place whose origin is not finite");
    Place place = make_place(origin_world);
    place.learnt.load(context_, reader);
    place.reservoirs.load(reader);
    place.modes.load(reader);
    place.latest.assign(reader.read_array<ReservoirPoint>("latest points", 0, kMostLatestPoints));
    place.is_used = true;
    place.is_settled = false;
    place.counted_bytes = place.state_bytes(context_);
    places_.push_back(std::move(place));
  }
}

}  // namespace foothold
