#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Runs a camera and the library for hours, and fails if memory, file handles, threads or the time of a frame grow.
#
#   scripts/soak.sh HOURS      e.g.  scripts/soak.sh 1
#
# tests/soak/soak.py says what runs and what counts as flat. The report is build/soak/soak.html, with its logs beside it.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ $# -ne 1 || ! $1 =~ ^[0-9]+(\.[0-9]+)?$ ]]; then
  echo "usage: scripts/soak.sh HOURS; got '$*'" >&2
  exit 2
fi
scripts/build.sh ci foothold_soak
exec python3 -B tests/soak/soak.py --hours "$1" --bin build/ci/bin --out build/soak
