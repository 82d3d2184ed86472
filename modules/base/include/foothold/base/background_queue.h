// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// Work that is done beside the thread that asks for it, on the threads that a Context has anyway.
#pragma once

#include <functional>
#include <memory>

#include "foothold/base/context.h"

namespace foothold {

/// Makes calls one after another, in the order asked for, beside the thread that asks.
///
/// They run on the threads of the context's arena, of which they take one: no more are at work than num_threads() says, but for the caller
/// while it does other things. Where no thread is free, wait() makes them; where none can be had, add() does.
///
/// One queue serves one thread of control. Its calls may use the context and its copies beside that thread.
class BackgroundQueue {
 public:
  /// A queue on the threads of a context.
  explicit BackgroundQueue(const Context& context);
  /// Waits. What a call threw is told to the context's log as a warning.
  ~BackgroundQueue();
  BackgroundQueue(const BackgroundQueue&) = delete;
  BackgroundQueue& operator=(const BackgroundQueue&) = delete;

  /// Whether calls are made beside the caller. If not, add() makes them: with one thread; on a device, whose stream has one order; and with
  /// a trace, whose stages would overlap.
  bool is_beside() const;

  /// Has a call made after those before, and returns. If one throws, those behind it are forgotten.
  /// @throws What a call before threw, once, in place of adding this one.
  void add(std::function<void()> call);

  /// Returns once nothing is left to be done. @throws What a call threw, once.
  void wait();

 private:
  class Worker;
  struct State;

  Context context_;
  std::unique_ptr<State> state_;
};

}  // namespace foothold
