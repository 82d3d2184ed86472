#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Builds for 64-bit Arm with a cross-compiler, and runs the tests in QEMU.
#
#   scripts/test_aarch64.sh [-DOPTION=VALUE...] [CTEST-ARGUMENT...]      e.g.  scripts/test_aarch64.sh --tests-regex '^(base|relocalisation)/'
#
# Arguments are those of scripts/test.sh; results lie in build/aarch64. QEMU takes some twenty times as long as a processor, so all tests take hours.
# Left out are the tests that start programs by themselves.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh --aarch64
exec scripts/test.sh aarch64 "$@"
