// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// What the sanitizers find in OpenNI2 itself. Include it in one source file of a program.
#pragma once

#ifdef __SANITIZE_ADDRESS__
/// OpenNI2 never frees the descriptions of its cameras.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOpenNI2\n"; }  // NOLINT(bugprone-reserved-identifier)
#endif
#ifdef __SANITIZE_THREAD__
/// OpenNI2 unlocks mutexes that it has not locked when the process ends, shuts down under a lock that connecting cameras take the other way
/// round (the virtual camera waits there for a bounded time), and hands new mutexes to other threads unguarded. Its locks still count, so
/// that whatever passes through it is checked.
extern "C" const char* __tsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "mutex:libOpenNI2\ndeadlock:libOpenNI2\nrace_top:pthread_mutex_lock\n";
}
#endif
