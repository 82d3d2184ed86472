// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/contract.h"

#include <atomic>
#include <string>

#include "foothold/base/error.h"

namespace foothold {

namespace {
[[noreturn]] void throw_contract_violation(const char* condition, const char* file, int line) {
  throw ContractViolation(std::string("precondition violated: ") + condition + " at " + file + ":" + std::to_string(line));
}

std::atomic<ContractHandler>& current_handler() {
  static std::atomic<ContractHandler> handler{&throw_contract_violation};
  return handler;
}
}  // namespace

ContractHandler set_contract_handler(ContractHandler handler) {
  return current_handler().exchange(handler != nullptr ? handler : &throw_contract_violation);
}

void detail::contract_violated(const char* condition, const char* file, int line) { current_handler().load()(condition, file, line); }

}  // namespace foothold
