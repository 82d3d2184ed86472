#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Installs what is missing, configures and builds.
#
#   scripts/build.sh [PRESET] [-DOPTION=VALUE...] [TARGET...]      e.g.  scripts/build.sh release -DFOOTHOLD_CUDA=OFF
#
# PRESET (default: release) is a name from CMakePresets.json; results lie in build/PRESET, apps in build/PRESET/bin.
# Options are those of CMake. They are kept in build/PRESET/options.txt: later runs configure with them, too, until they get another value.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=release
source scripts/preset_arguments.sh
for target in "${others[@]}"; do
  if [[ $target == -* ]]; then
    echo "build: got '$target', expected -DOPTION=VALUE or a target" >&2
    exit 2
  fi
done

scripts/install_packages.sh

# One compiler per core, but not more than memory holds: a translation unit with Eigen needs up to 1.5 GB.
jobs=$(nproc)
if [[ -r /proc/meminfo ]]; then
  fitting=$(($(awk '/^MemAvailable:/ {print $2}' /proc/meminfo) / 1500000))
  ((fitting < 1)) && fitting=1
  ((jobs > fitting)) && jobs=$fitting
fi

# CMake remembers options by itself, but a preset sets its own values again. Of several values of an option the last counts.
kept=build/$preset/options.txt
if [[ -f $kept ]]; then
  mapfile -t earlier <"$kept"
  options=("${earlier[@]}" "${options[@]}")
fi
cmake --preset "$preset" "${options[@]}"
if [[ ${#options[@]} -gt 0 ]]; then
  printf '%s\n' "${options[@]}" | tac | awk -F '[:=]' '!seen[$1]++' | tac >"$kept"
fi

targets=()
[[ ${#others[@]} -eq 0 ]] || targets=(--target "${others[@]}")
cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}"
