// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What can be saved and goes on another day.
#pragma once

#include <iosfwd>

#include "foothold/base/platform.h"

namespace foothold {

/// Whatever can write its scene to a stream and read it back.
class Persistent {
 public:
  virtual ~Persistent() = default;
  /// @throws FileError if writing fails.
  virtual void save(std::ostream& stream) const = 0;
  /// Replaces the scene. On failure the former scene stays. @throws FileError for a damaged stream or one of another kind or version.
  virtual void load(std::istream& stream) = 0;

 protected:
  Persistent() = default;
  /// Copies are made by derived classes.
  Persistent(const Persistent&) = default;
  /// Copies are made by derived classes.
  Persistent& operator=(const Persistent&) = default;
};

}  // namespace foothold
