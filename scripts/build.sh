#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Installs what is missing, configures and builds.
#
#   scripts/build.sh [PRESET] [TARGET...]
#
# PRESET (default: release) is a name from CMakePresets.json; results lie in build/PRESET, apps in build/PRESET/bin.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-release}
shift || true

scripts/install_packages.sh

# One compiler per core, but not more than memory holds: a translation unit with Eigen needs up to 1.5 GB.
jobs=$(nproc)
if [[ -r /proc/meminfo ]]; then
  fitting=$(($(awk '/^MemAvailable:/ {print $2}' /proc/meminfo) / 1500000))
  ((fitting < 1)) && fitting=1
  ((jobs > fitting)) && jobs=$fitting
fi

cmake --preset "$preset"
if [[ $# -gt 0 ]]; then
  cmake --build --preset "$preset" --parallel "$jobs" --target "$@"
else
  cmake --build --preset "$preset" --parallel "$jobs"
fi
