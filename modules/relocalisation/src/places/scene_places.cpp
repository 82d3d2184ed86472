// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "places/scene_places.h"

#include <string>

#include "foothold/base/binary_stream.h"
#include "foothold/base/random.h"

namespace foothold {

Place ScenePlaces::make_place(const Eigen::Vector3f& origin_world) const {
  const std::uint64_t seed = places_.empty() ? settings_.seed : derive_seed(settings_.seed, places_.size());
  return {origin_world, LearntViews(context_.memory()), LeafReservoirs(context_, num_leaves_, settings_.reservoirs, seed),
          LeafModes(context_, num_leaves_, settings_.clustering)};
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
  for (const Place& place : places_) sum += place.state_bytes();
  return sum;
}

void ScenePlaces::save(std::ostream& stream) const {
  write_value(stream, static_cast<std::uint32_t>(places_.size()));
  for (const Place& place : places_) {
    for (int k = 0; k < 3; ++k) write_value(stream, place.origin_world[k]);
    place.learnt.save(stream);
    place.reservoirs.save(stream);
    place.modes.save(stream);
  }
}

void ScenePlaces::load(std::istream& stream) {
  const auto num_places = read_value<std::uint32_t>(stream, "number of places");
  places_.clear();
  for (std::uint32_t i = 0; i < num_places; ++i) {
    Eigen::Vector3f origin_world;
    for (int k = 0; k < 3; ++k) origin_world[k] = read_value<float>(stream, "origin of a place");
    if (!origin_world.allFinite()) throw FileError("the saved scene has a place whose origin is not finite");
    Place place = make_place(origin_world);
    place.learnt.load(context_, stream);
    place.reservoirs.load(stream);
    place.modes.load(stream);
    place.is_used = true;
    place.is_settled = false;
    places_.push_back(std::move(place));
  }
}

}  // namespace foothold
