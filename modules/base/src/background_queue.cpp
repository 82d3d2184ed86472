// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "foothold/base/background_queue.h"

#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <deque>
#include <exception>
#include <future>
#include <mutex>
#include <string>
#include <utility>

#include "foothold/base/exec/sanitized_loop.h"

namespace foothold {

#ifdef FOOTHOLD_THREAD_SANITIZER
/// A plain thread, which that tool understands (see sanitized_loop.h).
class BackgroundQueue::Worker {
 public:
  explicit Worker(const Context&) {}
  template <class Work>
  void start(const Work& work) {
    done_ = std::async(std::launch::async, work);
  }
  void wait() {
    if (done_.valid()) done_.get();
  }

 private:
  std::future<void> done_;
};
#else
/// One of the arena's threads: whichever is free first, or the one that waits.
class BackgroundQueue::Worker {
 public:
  explicit Worker(const Context& context) : arena_(*static_cast<oneapi::tbb::task_arena*>(context.arena())) {}
  template <class Work>
  void start(const Work& work) {
    arena_.execute([&] { group_.run(work); });
  }
  void wait() {
    arena_.execute([&] { group_.wait(); });
  }

 private:
  oneapi::tbb::task_arena& arena_;
  oneapi::tbb::task_group group_;
};
#endif

struct BackgroundQueue::State {
  explicit State(const Context& context) : worker(context) {}

  /// Makes calls until none is left. Never throws.
  void work() {
    const std::function<void()>* call = first();
    while (call != nullptr) {
      try {
        (*call)();
        call = next();
      } catch (...) {
        call = fail(std::current_exception());
      }
    }
  }

  const std::function<void()>* first() {
    const std::lock_guard<std::mutex> lock(mutex);
    return &calls.front();
  }
  const std::function<void()>* next() {
    const std::lock_guard<std::mutex> lock(mutex);
    calls.pop_front();
    return calls.empty() ? nullptr : &calls.front();
  }
  std::nullptr_t fail(std::exception_ptr exception) {
    const std::lock_guard<std::mutex> lock(mutex);
    calls.clear();
    failure = std::move(exception);
    return nullptr;
  }
  void throw_failure() {
    std::exception_ptr thrown;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      thrown.swap(failure);
    }
    if (thrown) std::rethrow_exception(thrown);
  }

  std::mutex mutex;                         // guards what follows
  std::deque<std::function<void()>> calls;  // of which the first is being made
  std::exception_ptr failure;
  Worker worker;  // last: what it does uses the rest
};

BackgroundQueue::BackgroundQueue(const Context& context) : context_(context), state_(std::make_unique<State>(context)) {}

BackgroundQueue::~BackgroundQueue() {
  try {
    wait();
  } catch (const std::exception& error) {
    context_.log(LogLevel::kWarning, std::string("work in the background failed, and nobody waited for it: ") + error.what());
  }
}

bool BackgroundQueue::is_beside() const {
  return context_.device() == Device::kCpu && context_.num_threads() > 1 && context_.trace() == nullptr;
}

void BackgroundQueue::add(std::function<void()> call) {
  if (!is_beside()) return call();
  state_->throw_failure();
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->calls.push_back(std::move(call));
    if (state_->calls.size() > 1) return;
  }
  const auto work = [state = state_.get()] { state->work(); };
  try {
    state_->worker.start(work);
  } catch (const std::exception&) {  // no thread, or no memory for one
    work();
  }
}

void BackgroundQueue::wait() {
  state_->worker.wait();
  state_->throw_failure();
}

}  // namespace foothold
