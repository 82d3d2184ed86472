// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Faults of the machine: calls to the file system that fail as on a full disk, and memory that runs out.
#pragma once

namespace foothold::test {

enum class CallKind {
  kFile,       ///< open() that creates, write(), fsync() and rename(): fail with ENOSPC
  kAllocation  ///< operator new and aligned_alloc()
};

/// Makes one of the following calls of a kind fail, in this thread and for as long as it lives. One at a time.
class FailingCall {
 public:
  /// @param number   Of the call, counted from 0. @param lasting  All calls after it fail as well.
  FailingCall(CallKind kind, int number, bool lasting = false);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// False if there were not so many calls.
  bool has_failed() const;
};

}  // namespace foothold::test
