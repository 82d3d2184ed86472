// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Preconditions on the host: what a correct program never violates.
#pragma once

#include <string>

#include "foothold/base/platform.h"

namespace foothold {

/// Receives the text of a broken precondition, its condition or what is wrong with the argument, with its file and line. It may throw, log
/// or end the process.
using ContractHandler = void (*)(const char* condition, const char* file, int line);

/// Replaces the handler of broken preconditions and returns the former one; nullptr restores the default, which throws ContractViolation.
/// Thread-safe.
ContractHandler set_contract_handler(ContractHandler handler);

namespace detail {
void contract_violated(const char* condition, const char* file, int line);
}  // namespace detail

}  // namespace foothold

/// Calls the contract handler unless the condition holds. Host code only; stays on in release builds.
#define FOOTHOLD_EXPECTS(condition)                                          \
  do {                                                                       \
    if (!(condition)) {                                                      \
      ::foothold::detail::contract_violated(#condition, __FILE__, __LINE__); \
    }                                                                        \
  } while (false)

/// Calls the contract handler with what is wrong, such as describe_frame_error() returns it, unless that is empty.
#define FOOTHOLD_EXPECTS_NO_ERROR(description)                                           \
  do {                                                                                   \
    if (const std::string& foothold_error = (description); !foothold_error.empty()) {    \
      ::foothold::detail::contract_violated(foothold_error.c_str(), __FILE__, __LINE__); \
    }                                                                                    \
  } while (false)
