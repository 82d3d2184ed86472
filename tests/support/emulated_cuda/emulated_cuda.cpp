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

void* EmulatedCuda::allocate(int device, std::size_t num_bytes) {
  ++counts_.num_allocations;
  const std::size_t num_used = round_up(num_bytes, kAlignment);
  const std::size_t num_pages_bytes = round_up(num_used, page_size());
  void* const pages = ::mmap(nullptr, num_pages_bytes + page_size(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  auto* const begin = static_cast<unsigned char*>(pages);
  ::mprotect(begin, num_pages_bytes, PROT_READ | PROT_WRITE);
  std::memset(begin, kGarbage, num_pages_bytes);
  ::mprotect(begin, num_pages_bytes, PROT_NONE);
  allocations_.push_back({device, begin, num_pages_bytes, begin + (num_pages_bytes - num_used)});
  return allocations_.back().pointer;
}

void EmulatedCuda::free(void* pointer) noexcept {
  ++counts_.num_frees;
  const auto is_it = [&](const Allocation& allocation) { return allocation.pointer == pointer; };
  const auto found = std::find_if(allocations_.begin(), allocations_.end(), is_it);
  if (found == allocations_.end()) fail("freed what was not allocated", "free");
  wait_device(found->device);
  ::munmap(found->begin, found->num_bytes + page_size());
  allocations_.erase(found);
}

std::shared_ptr<EmulatedStream> EmulatedCuda::stream(int device, const void* name) {
  std::shared_ptr<EmulatedStream>& stream = streams_[{device, name}];
  if (stream == nullptr) stream = std::make_shared<EmulatedStream>(EmulatedStream{device, {}, 0});
  return stream;
}

void EmulatedCuda::launch(EmulatedStream& stream, std::function<void()> kernel) {
  ++counts_.num_launches;
  stream.queue.push_back(std::move(kernel));
}

void EmulatedCuda::wait_for(EmulatedStream& stream, const std::shared_ptr<EmulatedStream>& other) {
  const long num_done = other->num_done + static_cast<long>(other->queue.size());
  stream.queue.emplace_back([this, other, num_done] { run(*other, num_done); });
}

void EmulatedCuda::wait(EmulatedStream& stream) { run(stream, stream.num_done + static_cast<long>(stream.queue.size())); }

void EmulatedCuda::wait_device(int device) {
  for (auto& [key, stream] : streams_) {
    if (stream->device == device) wait(*stream);
  }
}

void EmulatedCuda::run_now(int device, const std::function<void()>& work) {
  if (num_unlocked_[device]++ == 0) protect(device, PROT_READ | PROT_WRITE);
  work();
  if (--num_unlocked_[device] == 0) protect(device, PROT_NONE);
}

void EmulatedCuda::run(EmulatedStream& stream, long num_done) {
  if (stream.num_done >= num_done) return;
  run_now(stream.device, [&] {
    while (stream.num_done < num_done) {
      const std::function<void()> work = std::move(stream.queue.front());
      stream.queue.pop_front();
      ++stream.num_done;
      work();
    }
  });
}

void EmulatedCuda::protect(int device, int protection) {
  for (const Allocation& allocation : allocations_) {
    if (allocation.device == device) ::mprotect(allocation.begin, allocation.num_bytes, protection);
  }
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
