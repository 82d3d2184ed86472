#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Builds what needs no OpenCV with CUDA, and runs every test labelled gpu: first as it is, then under compute-sanitizer.
#
#   scripts/test_gpu.sh [--allow-no-gpu] [--no-sanitizer]
#
# Needs nvcc, CMake and a C++ compiler; Ninja if it is there. Nothing is installed or downloaded: where Eigen, oneTBB and Catch2 are missing,
# set FOOTHOLD_DEPS to the unpacked folder of scripts/pack_gpu_deps.sh. FOOTHOLD_CMAKE adds words to CMake's command line.
#
# Fails where there is no GPU, unless --allow-no-gpu is given: then tests are skipped, and reported so.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/gpu_common.sh

allow_no_gpu=false
sanitizer=true
for argument in "$@"; do
  case $argument in
    --allow-no-gpu) allow_no_gpu=true ;;
    --no-sanitizer) sanitizer=false ;;
    --help) usage; exit 0 ;;
    *) echo "test_gpu.sh: unknown argument $argument; try --help" >&2; exit 2 ;;
  esac
done

echo "GPU: $(gpu_name)"
build_for_gpu foothold_gpu_tests
$allow_no_gpu || export FOOTHOLD_REQUIRE_GPU=1
# Other test programs are not built; CTest would report each as missing.
(cd build/gpu/tests/gpu && ctest --output-on-failure --no-tests=error --label-regex gpu --timeout 300)

$sanitizer || exit 0
tests=build/gpu/bin/foothold_gpu_tests
status=0
if ! compute_sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2>/dev/null); then
  echo "compute-sanitizer: not found; memory and races were not checked" >&2
  $allow_no_gpu && exit 0
  exit 1
fi
$tests "Context: two contexts*" >/dev/null || status=$?
if [[ $status == 77 ]]; then
  echo "compute-sanitizer: skipped, there is no GPU"
  exit 0
fi
# Errors in any kernel make these fail. Leaks are those of the process, device memory included.
"$compute_sanitizer" --tool memcheck --leak-check full --error-exitcode 99 $tests
# Races in shared memory: slow, so the tests with the most of it.
"$compute_sanitizer" --tool racecheck --error-exitcode 99 $tests "CudaExecutor*"
"$compute_sanitizer" --tool racecheck --error-exitcode 99 $tests "CUDA: reservoirs and modes*"
"$compute_sanitizer" --tool racecheck --error-exitcode 99 $tests "CUDA: poses*"
"$compute_sanitizer" --tool synccheck --error-exitcode 99 $tests
echo "test_gpu.sh: all tests passed, with and without compute-sanitizer"
