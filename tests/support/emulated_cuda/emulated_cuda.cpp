// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
#include "support/emulated_cuda/emulated_cuda.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>

namespace foothold::test {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr int kGarbage = 0xA5;

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return size;
}

std::size_t round_up(std::size_t value, std::size_t step) { return (value + step - 1) / step * step; }

[[noreturn]] void fail(const char* what, const char* place) {
  std::fprintf(stderr, "emulated CUDA: %s (%s)\n", what, place);
  std::abort();
}

}  // namespace

EmulatedCuda& EmulatedCuda::instance() {
  static EmulatedCuda device;
  return device;
}

void* EmulatedCuda::allocate(std::size_t num_bytes) {
  ++counts_.num_allocations;
  const std::size_t num_used = round_up(num_bytes, kAlignment);
  const std::size_t num_pages_bytes = round_up(num_used, page_size());
  void* const pages = ::mmap(nullptr, num_pages_bytes + page_size(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  auto* const begin = static_cast<unsigned char*>(pages);
  ::mprotect(begin, num_pages_bytes, PROT_READ | PROT_WRITE);
  std::memset(begin, kGarbage, num_pages_bytes);
  ::mprotect(begin, num_pages_bytes, PROT_NONE);
  allocations_.push_back({begin, num_pages_bytes, begin + (num_pages_bytes - num_used)});
  return allocations_.back().pointer;
}

void EmulatedCuda::free(void* pointer) noexcept {
  wait();
  ++counts_.num_frees;
  const auto found =
      std::find_if(allocations_.begin(), allocations_.end(), [&](const Allocation& allocation) { return allocation.pointer == pointer; });
  if (found == allocations_.end()) fail("freed what was not allocated", "free");
  ::munmap(found->begin, found->num_bytes + page_size());
  allocations_.erase(found);
}

void EmulatedCuda::launch(std::function<void()> kernel) {
  ++counts_.num_launches;
  queue_.push_back(std::move(kernel));
}

void EmulatedCuda::wait() {
  if (queue_.empty()) return;
  run_now([] {});
}

void EmulatedCuda::run_now(const std::function<void()>& work) {
  std::vector<std::function<void()>> queue;
  queue.swap(queue_);
  unlock();
  for (const auto& kernel : queue) kernel();
  work();
  lock();
}

void EmulatedCuda::unlock() {
  for (const Allocation& allocation : allocations_) ::mprotect(allocation.begin, allocation.num_bytes, PROT_READ | PROT_WRITE);
}

void EmulatedCuda::lock() {
  for (const Allocation& allocation : allocations_) ::mprotect(allocation.begin, allocation.num_bytes, PROT_NONE);
}

void LaneBarrier::wait(const char* place) {
  constexpr std::chrono::seconds kLongest{120};
  std::unique_lock<std::mutex> lock(mutex_);
  if (num_arrived_ == 0) place_ = place;
  if (std::strcmp(place_, place) != 0) fail("lanes of one team came to different places", place);
  if (++num_arrived_ == num_lanes_) {
    num_arrived_ = 0;
    ++generation_;
    changed_.notify_all();
    return;
  }
  const long generation = generation_;
  if (!changed_.wait_for(lock, kLongest, [&] { return generation_ != generation; })) fail("a lane never came", place);
}

void run_lanes(int num_lanes, const std::function<void(int)>& lane) {
  std::vector<std::thread> threads;
  for (int i = 1; i < num_lanes; ++i) threads.emplace_back(lane, i);
  lane(0);
  for (std::thread& thread : threads) thread.join();
}

}  // namespace foothold::test
