// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/synthetic/room.h"

#include <algorithm>

#include "foothold/base/error.h"
#include "foothold/base/random.h"
#include "rooms.h"

namespace foothold {
namespace {

using namespace synthetic_detail;

struct NamedRoom {
  const char* name;
  Room (*make)();
};
constexpr NamedRoom kRooms[] = {{"office", make_office},           {"stairs", make_stairs},     {"kitchen", make_kitchen},
                                {"textureless", make_textureless}, {"workshop", make_workshop}, {"bookshelf", make_bookshelf},
                                {"lounge", make_lounge},           {"corridor", make_corridor}};

constexpr char kTrainingPrefix[] = "training-";

/// K of "training-K".
bool parse_training_room(const std::string& name, std::uint64_t& k) {
  const std::string prefix = kTrainingPrefix;
  if (name.compare(0, prefix.size(), prefix) != 0) return false;
  const std::string digits = name.substr(prefix.size());
  constexpr std::size_t kMostDigits = 18;
  if (digits.empty() || digits.size() > kMostDigits ||
      !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return false;
  k = std::stoull(digits);
  return true;
}

const NamedRoom* find_room(const std::string& name) {
  return std::find_if(std::begin(kRooms), std::end(kRooms), [&](const NamedRoom& room) { return name == room.name; });
}

}  // namespace

void synthetic_detail::check_room_name(const std::string& name) {
  std::uint64_t k = 0;
  if (find_room(name) != std::end(kRooms) || parse_training_room(name, k)) return;
  std::string message = "unknown synthetic room '" + name + "'; known are ";
  for (const NamedRoom& room : kRooms) message += std::string(room.name) + ", ";
  throw InvalidSettings(message + "and training-K for K = 0, 1, 2, ...");
}

std::vector<std::string> synthetic_room_names() {
  std::vector<std::string> names;
  for (const NamedRoom& room : kRooms) names.emplace_back(room.name);
  return names;
}

Room make_room(const std::string& name) {
  check_room_name(name);
  std::uint64_t k = 0;
  Room room;
  if (parse_training_room(name, k)) {
    room = make_training_room(k);
    room.seed = derive_seed(k, 1);
  } else {
    const NamedRoom* known = find_room(name);
    room = known->make();
    room.seed = derive_seed(static_cast<std::uint64_t>(known - kRooms), 2);
  }
  room.name = name;
  return room;
}

}  // namespace foothold
