#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Installs what is missing, builds everything that this machine can run, and runs all tests.
#
#   scripts/test.sh [PRESET] [-DOPTION=VALUE...] [CTEST-ARGUMENT...]      e.g.  scripts/test.sh asan --tests-regex base/
#
# PRESET (default: ci) is one of the test presets of CMakePresets.json. Options go to scripts/build.sh, which keeps them.
# Ends with ctest's own summary and exit status.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=ci
source scripts/preset_arguments.sh

scripts/build.sh "$preset" "${options[@]}"
exec ctest --preset "$preset" "${others[@]}"
