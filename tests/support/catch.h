// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Foothold authors
/// One include for Catch2's version 2 (Debian 12) and 3 (Ubuntu 24.04).
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
