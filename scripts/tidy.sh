#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Runs clang-tidy 14 with .clang-tidy over C++ files; slow, so name the ones that matter.
#
#   scripts/tidy.sh [FILE...]        default: every .cpp file of modules and apps
set -euo pipefail
caller=$PWD
cd "$(dirname "$0")/.."

files=()
for file in "$@"; do files+=("$(realpath --relative-to . "$caller/$file")"); done
if [[ ${#files[@]} -eq 0 ]]; then mapfile -t files < <(find modules apps -name '*.cpp' | sort); fi

scripts/install_packages.sh --developer
cmake --preset dev >/dev/null
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p build/dev --quiet --warnings-as-errors='*' 2>/dev/null
