// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// The linker sends calls of write() and its like here (--wrap); operator new is replaced.
#include "faults/failing_calls.h"

#include <fcntl.h>
#include <sys/types.h>

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace foothold::test {
namespace {

struct Plan {
  bool is_on = false;
  CallKind kind = CallKind::kFile;
  int num_before = 0;  ///< calls until the one that fails
  bool lasting = false;
  bool has_failed = false;
};
thread_local Plan plan;

bool must_fail(CallKind kind) {
  if (!plan.is_on || plan.kind != kind) return false;
  const bool fails = plan.num_before == 0 || (plan.lasting && plan.num_before < 0);
  --plan.num_before;
  plan.has_failed |= fails;
  return fails;
}

bool disk_is_full() {
  if (!must_fail(CallKind::kFile)) return false;
  errno = ENOSPC;
  return true;
}

}  // namespace

FailingCall::FailingCall(CallKind kind, int number, bool lasting) { plan = {true, kind, number, lasting, false}; }
FailingCall::~FailingCall() { plan.is_on = false; }
bool FailingCall::has_failed() const { return plan.has_failed; }

}  // namespace foothold::test

extern "C" {
ssize_t __real_write(int descriptor, const void* data, std::size_t num_bytes);
int __real_fsync(int descriptor);
int __real_rename(const char* from, const char* to);
int __real_open(const char* path, int flags, ...);
void* __real_aligned_alloc(std::size_t alignment, std::size_t num_bytes);

ssize_t __wrap_write(int descriptor, const void* data, std::size_t num_bytes) {
  return foothold::test::disk_is_full() ? -1 : __real_write(descriptor, data, num_bytes);
}
int __wrap_fsync(int descriptor) { return foothold::test::disk_is_full() ? -1 : __real_fsync(descriptor); }
int __wrap_rename(const char* from, const char* to) { return foothold::test::disk_is_full() ? -1 : __real_rename(from, to); }
int __wrap_open(const char* path, int flags, ...) {
  if ((flags & O_CREAT) == 0) return __real_open(path, flags);
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  return foothold::test::disk_is_full() ? -1 : __real_open(path, flags, mode);
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t num_bytes) {
  return foothold::test::must_fail(foothold::test::CallKind::kAllocation) ? nullptr : __real_aligned_alloc(alignment, num_bytes);
}
}

void* operator new(std::size_t num_bytes) {
  void* pointer = foothold::test::must_fail(foothold::test::CallKind::kAllocation) ? nullptr : std::malloc(num_bytes == 0 ? 1 : num_bytes);
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}
// The address sanitizer's own would ask for memory that free() refuses.
void* operator new(std::size_t num_bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(num_bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* pointer) noexcept { std::free(pointer); }
void operator delete(void* pointer, std::size_t) noexcept { std::free(pointer); }
