// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Exceptions: one type per kind of user mistake, so that hosts can tell them apart. See docs/conventions.md, "Errors".
#pragma once

#include <stdexcept>
#include <string>

#include "foothold/base/platform.h"

namespace foothold {

/// Base of everything Foothold throws because a user or a device asked for the impossible.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A setting has an unknown name or a value outside its range.
class InvalidSettings : public Error {
 public:
  using Error::Error;
};

/// A file is missing, unreadable or damaged; the message names the file, the value and what was expected.
class FileError : public Error {
 public:
  using Error::Error;
};

/// The requested device does not exist here, or it failed.
class DeviceError : public Error {
 public:
  using Error::Error;
};

/// A call into CUDA failed; the message holds the call's text and CUDA's own words.
class CudaError : public DeviceError {
 public:
  using DeviceError::DeviceError;
};

/// A caller broke a documented precondition, and the default contract handler is in place.
class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace foothold
