// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The rooms themselves. Each function returns a room without name or seed; make_room() adds them.
#pragma once

#include <cstdint>
#include <string>

#include "foothold/synthetic/room.h"

namespace foothold::synthetic_detail {

/// Rows of near-identical desks with monitors and chairs.
Room make_office();
/// A staircase of identical steps between bare walls.
Room make_stairs();
/// Cabinets, worktops, machines, tiles and a table.
Room make_kitchen();
/// Plain walls and plain boxes under faint shading.
Room make_textureless();
/// Workbenches, tools, shelves and crates.
Room make_workshop();
/// A library.
Room make_bookshelf();
/// Sofas, plants and posters.
Room make_lounge();
/// Equal doors along both sides, equal lamps, and little that tells one from the next.
Room make_corridor();
/// The K-th room to train on: everything about it is drawn from K.
Room make_training_room(std::uint64_t k);

/// @throws InvalidSettings listing the known rooms unless make_room() knows the name.
void check_room_name(const std::string& name);

}  // namespace foothold::synthetic_detail
