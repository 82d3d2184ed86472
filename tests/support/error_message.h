// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#pragma once

#include <string>

#include "foothold/base/error.h"

namespace foothold::test {

/// What an exception of the given type says that `action` throws; empty if it throws none.
template <class Exception, class Action>
std::string error_message(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return {};
}

/// The message of the exception that a call throws; something else than a message if it throws none.
template <class Exception = FileError, class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "(nothing was thrown)";
}

/// True if a text holds a part.
inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace foothold::test
