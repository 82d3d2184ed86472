// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Files that stand beside another until they take its place.
#pragma once

#include <string>

namespace foothold {

/// Creates an empty file beside `path` that nobody else writes, and deletes what writers of `path` that are dead left there.
///
/// Its name is path.N.tmp with the first free N. Its writer holds a lock (flock) for as long as the descriptor is open, so that a file
/// without a lock belongs to nobody; the lock of a process that was killed goes with it.
/// @return The descriptor, for writing; -1 with errno if there is none.
int create_temporary(const std::string& path, std::string& temporary_path);

/// Follows symbolic links, of which the last may lead to nothing. @return Empty if they go round in circles.
std::string follow_links(std::string path);

}  // namespace foothold
