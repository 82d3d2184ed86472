#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
# Writes the forest that Foothold uses by default to a file: the same bytes on every machine of one kind.
#
#   scripts/train_default_forest.sh [FOLDER OF THE BUILD'S PROGRAMS] [FILE]
#
# The default is the data-free forest, because no trained one was better across scenes (docs/forest-training.md), so there is nothing to train: the
# library makes it from its settings when asked, and needs no file. With --trained as first argument, the best of the trained forests of that page is
# trained instead, on rendered rooms, in about two minutes of processor time.
set -euo pipefail

trained=false
if [[ "${1:-}" == --trained ]]; then
  trained=true
  shift
fi
programs=${1:-build/release/bin}
file=${2:-default.forest}

if [[ ! -x "$programs/train_forest" ]]; then
  echo "$programs/train_forest: not found; build first (scripts/build.sh), or give the folder of the built programs" >&2
  exit 2
fi

if ! $trained; then
  "$programs/train_forest" random --out "$file"
else
  rooms=()
  for ((room = 0; room < 20; ++room)); do
    rooms+=(--sequence "synthetic:training-$room?frames=1200")
  done
  "$programs/train_forest" "${rooms[@]}" --stride 40 --examples-per-frame 250 --depth 13 --resume \
    --set rolled_copies=1 --set variance_weight=0 --set agreement_weight=1 --out "$file"
fi
"$programs/train_forest" info "$file"
