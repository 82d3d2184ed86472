#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Times training, relocalisation and fusion, whole and stage by stage, and prints Markdown tables for docs/cuda.md.
#
#   scripts/bench_gpu.sh [--device cuda|cpu] [--frames N] [RAW-RECORDING...]
#
# Without a recording: a rendered room. A recording is one file, made beforehand where OpenCV is, from any sequence with poses:
#   render_sequence --sequence FOLDER --out redkitchen.fhraw --raw
# Build needs are those of scripts/test_gpu.sh. With --device cpu it measures the same on the host, with one thread.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/gpu_common.sh

device=cuda
frames=300
recordings=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --device) device=${2:?}; shift 2 ;;
    --frames) frames=${2:?}; shift 2 ;;
    --help) usage; exit 0 ;;
    -*) echo "bench_gpu.sh: unknown argument $1; try --help" >&2; exit 2 ;;
    *) recordings+=(--sequence "$1"); shift ;;
  esac
done

build_for_gpu device_benchmark >&2
echo "GPU: $(gpu_name); CPU: $(sed -n 's/^model name\s*: //p' /proc/cpuinfo | head -1); $(date -u +%F); commit $(git rev-parse --short HEAD 2>/dev/null || echo unknown)"
warm_up=$((frames / 4 > 0 ? frames / 4 : 1))
benchmark=(build/gpu/bin/device_benchmark --device "$device" --frames "$frames" --warm-up "$warm_up")
for preset in tuned paper; do
  echo
  "${benchmark[@]}" --preset "$preset"
  for ((i = 0; i < ${#recordings[@]}; i += 2)); do
    echo
    "${benchmark[@]}" --preset "$preset" "${recordings[@]:i:2}"
  done
done
