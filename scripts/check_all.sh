#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Everything that is checked before a release. Takes hours; goes on after a failure, and lists what failed at the end.
#
#   scripts/check_all.sh [FUZZ-MINUTES]      default: 20
#
# The logs are build/check_all/STEP.txt. What the sanitizers find in libraries of others is suppressed, with the reason, in
# tests/sanitizers.
set -uo pipefail
cd "$(dirname "$0")/.."

fuzz_minutes=${1:-20}
if [[ $# -gt 1 || ! $fuzz_minutes =~ ^[0-9]+$ ]]; then
  echo "usage: scripts/check_all.sh [FUZZ-MINUTES]; got '$*'" >&2
  exit 2
fi

logs=build/check_all
mkdir -p "$logs"
failed=()
check() { # STEP COMMAND...
  local step=$1 begin=$SECONDS
  shift
  if "$@" >"$logs/$step.txt" 2>&1; then
    echo "$step: passed, $((SECONDS - begin)) s"
  else
    echo "$step: FAILED, $((SECONDS - begin)) s, see $logs/$step.txt"
    failed+=("$step")
  fi
}

scripts/install_packages.sh --developer || exit 1
check format python3 tests/checks/format.py .
check tests .ci/run                                # with CUDA where nvcc is, faults, corpora of the fuzz targets, and the short soak
check release scripts/build.sh release             # modules and apps as users build them
check tidy scripts/tidy.sh
check asan scripts/test.sh asan                    # apps and the virtual camera, too
check tsan scripts/test.sh tsan --tests-regex '^(base|api|fusion|relocalisation|reconstruction|openni|app_view|apps|soak)/'
check fuzz scripts/fuzz.sh "$fuzz_minutes"

if [[ ${#failed[@]} -gt 0 ]]; then
  echo "check_all: failed: ${failed[*]}" >&2
  exit 1
fi
echo "check_all: all passed"
