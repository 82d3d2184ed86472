#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# From a fresh clone to a first result: installs what is missing, builds, renders a kitchen (no download), assumes the camera lost at every
# frame and finds it again with the adapted forest and, for comparison, with random ferns.
#
#   scripts/demo.sh [SEQUENCE]
#
# SEQUENCE: a recording's folder or synthetic:NAME?key=value; default: synthetic:kitchen?frames=200.
# Prints a table, and leaves a picture in build/demo/recall.png and the numbers in build/demo/results.json.
set -euo pipefail
caller=$PWD
cd "$(dirname "$0")/.."

sequence=${1:-synthetic:kitchen?frames=200}
if [[ $sequence != synthetic:* && $sequence != /* ]]; then
  sequence=$caller/$sequence
fi

# Shows only what is being built just now, on one line, and only to people.
show_progress() {
  local line
  while IFS= read -r line; do
    if [[ -t 2 && $line =~ ^\[[0-9]+/[0-9]+\] ]]; then
      printf '\r%s building ...' "${BASH_REMATCH[0]}" >&2
    fi
  done
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

scripts/install_packages.sh
mkdir -p build/demo

echo "Building (a few minutes the first time; details in build/demo/build.log)" >&2
if ! scripts/build.sh release relocalisation_benchmark 2>&1 | tee build/demo/build.log | show_progress; then
  tail -n 30 build/demo/build.log >&2
  echo "demo: the build failed; all that it said is in build/demo/build.log" >&2
  exit 1
fi

build/release/bin/relocalisation_benchmark loss --sequence "$sequence" --method forest,ferns --exclusive-timing \
  --plot "$PWD/build/demo/recall.png" --json "$PWD/build/demo/results.json"
