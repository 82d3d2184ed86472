#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
# Trains the classifiers that grade tracking and accept relocalised poses, on rendered rooms alone, and tests them on the seven rooms that are
# kept aside. About a quarter of an hour on one processor core.
#
#   scripts/train_quality_gate.sh [FOLDER OF THE BUILD'S PROGRAMS] [FOLDER FOR THE RESULTS] [MORE OPTIONS OF train_quality_gate]
set -euo pipefail
cd "$(dirname "$0")/.."

programs=${1:-build/release/bin}
folder=${2:-quality-gate}
shift $(($# > 2 ? 2 : $#))
if [[ ! -x "$programs/train_quality_gate" ]]; then
  echo "$programs/train_quality_gate: not found; build first (scripts/build.sh), or give the folder of the built programs" >&2
  exit 2
fi

recordings=()
for room in 0 1 2 3 4 5 6 7 8 9 10 11 12 13; do
  noise=$((1 + room % 4 / 3))
  recordings+=(--sequence "synthetic:training-$room?noise=$noise" --views "synthetic:training-$room?trajectory=test&noise=$noise")
done
for room in office stairs kitchen textureless workshop bookshelf lounge; do
  recordings+=(--test-sequence "synthetic:$room" --test-views "synthetic:$room?trajectory=test")
done
"$programs/train_quality_gate" "${recordings[@]}" --out "$folder" "$@"
