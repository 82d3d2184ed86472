#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Trains the forest that Foothold ships, data/default.forest, again: on rendered rooms alone, in about 80 s of processor time and 0.4 GB.
# The bytes are the same on every machine with the same compiler and mathematical library. Why these settings: docs/experiments/forest-objective.md.
#
#   scripts/train_default_forest.sh [PROGRAMS] [FILE]
#
# PROGRAMS: the folder of the built programs, default: build/release/bin. FILE: what to write, default: data/default.forest.
# Interrupted, it goes on where it was when called again.
set -euo pipefail
cd "$(dirname "$0")/.."

programs=${1:-build/release/bin}
file=${2:-data/default.forest}

if [[ ! -x "$programs/train_forest" ]]; then
  echo "$programs/train_forest: not found; build first (scripts/build.sh), or give the folder of the built programs" >&2
  exit 2
fi

# The commit whose trainer and rooms made the file, for its provenance; name a newer one when it is trained anew with changed ones. Named
# by hand because the file holds it: taken from the history, any later commit that touches the trainer, a comment even, would change the bytes.
commit=fd0d81d

rooms=()
for ((room = 0; room < 20; ++room)); do
  rooms+=(--sequence "synthetic:training-$room?frames=1200")
done
"$programs/train_forest" "${rooms[@]}" --stride 40 --examples-per-frame 250 --depth 13 --seed 42 --resume \
  --set rolled_copies=1 --set agreement_weight=4 --set covariance_prior_examples=8 --set min_child_fraction=0.2 \
  --note "commit = $commit" --out "$file"
"$programs/train_forest" info "$file"
