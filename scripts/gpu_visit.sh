#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# A visit to a machine with an NVIDIA GPU, in less than eight minutes: is it right, and how fast is it? In the order of worth, each step with
# a time limit and a log of its own in the folder $OUT; a step that fails does not keep the others from running.
#
#   [OUT=FOLDER] gpu_visit.sh [--rehearse] [STEP...]
#
# Run it where scripts/pack_gpu_run.sh's archive is unpacked. Nothing is compiled; no setting of the GPU is changed. compute-sanitizer and ncu
# are used where they are found: in PATH, in /usr/local/cuda/bin, or as COMPUTE_SANITIZER and NCU say.
#
#   versions   the machine, and whether its GPU can be used; without one the visit ends here, with exit status 3
#   tests      all tests that need a GPU
#   memcheck   the executor, training, relocalisation and fusion under compute-sanitizer
#   racecheck  the kernels that share memory, and all barriers
#   time       whole calls and stages, 640x480, for each recording and a rendered room
#   compare    the same recordings on GPU and CPU: what is learnt, found, tracked and fused
#   ncu        the time of every kernel; a close look at the five that take most
#   soak       two minutes of the same frames: memory, times, and poses from lap to lap
#
# Without STEPs all are run. --rehearse goes on without a GPU, on the CPU where a step can, with little work: to see that the script works.
# The exit status is the number of steps that failed or ran out of time.
set -uo pipefail

here=$(cd "$(dirname "$0")" && pwd)
steps=(versions:15 tests:60 memcheck:50 racecheck:45 time:60 compare:50 ncu:60 soak:130)
budget_s=475
bin=$here/bin
room='synthetic:office'

usage() { sed -n '/^# Copyright/,/^set /p' "$0" | sed '1d;$d;s/^#\( \|$\)//'; }
find_tool() { command -v "$1" 2>/dev/null || ls "/usr/local/cuda/bin/$1" 2>/dev/null; }
recordings() { find "$here/recordings" -type f 2>/dev/null | sort; echo "$room"; }

# Runs a command; the step goes on if it fails, and has failed in the end.
failed=0
try() {
  "$@" && return
  failed=$?
  echo "gpu_visit: failed with status $failed: $*"
}

step_versions() {
  echo "foothold $(cat "$here/VERSION" 2>/dev/null || echo unknown), $(uname -srm), $(nproc) processors, $(date -u +%FT%TZ)"
  getconf GNU_LIBC_VERSION
  nvidia-smi || true
  nvidia-smi --query-gpu=name,driver_version,compute_cap,memory.total,clocks.sm,clocks.max.sm,clocks.mem --format=csv || true
  for tool in "${COMPUTE_SANITIZER:-$(find_tool compute-sanitizer)}" "${NCU:-$(find_tool ncu)}"; do
    timeout 3 "${tool:-false}" --version || echo "no version of '$tool'"
  done
  # Learns a frame or two: the first kernels.
  "$bin/device_benchmark" soak --device cuda --frames 2 --warm-up 1 --seconds 0 --sequence "$room?width=160&height=120"
}

step_tests() {
  [[ -n $rehearse ]] || export FOOTHOLD_REQUIRE_GPU=1
  "$bin/foothold_gpu_tests" --durations yes
}

sanitizer() {
  local tool=${COMPUTE_SANITIZER:-$(find_tool compute-sanitizer)}
  [[ -n $tool ]] || { echo "gpu_visit: compute-sanitizer is not here"; return 1; }
  "$tool" --error-exitcode 99 --tool "$@"
}

step_memcheck() {
  try sanitizer memcheck "$bin/foothold_gpu_tests" "CudaExecutor*,Array*,FrameUploader*"
  try sanitizer memcheck "$bin/foothold_gpu_tests" "CUDA: reservoirs*"
  try sanitizer memcheck "$bin/foothold_gpu_tests" "CUDA: poses*"
  try sanitizer memcheck "$bin/foothold_gpu_tests" "CUDA: a rendering*,CUDA: candidates*"
}

step_racecheck() {
  try sanitizer racecheck "$bin/foothold_gpu_tests" "CudaExecutor*"
  try sanitizer racecheck "$bin/foothold_gpu_tests" "CUDA: reservoirs*"
  try sanitizer racecheck "$bin/foothold_gpu_tests" "CUDA: poses*"
  try sanitizer racecheck "$bin/foothold_gpu_tests" "CUDA: tracking*,CUDA: comparing views*,CUDA: a map has*"
  try sanitizer synccheck "$bin/foothold_gpu_tests" "CudaExecutor*,CUDA: poses*"
}

step_time() {
  while read -r recording; do
    try "$bin/device_benchmark" time --device "$device" --sequence "$recording" --elsewhere "${room/office/stairs}" $little
  done < <(recordings)
}

step_compare() {
  while read -r recording; do try "$bin/device_benchmark" compare --threads 0 --sequence "$recording" $little; done < <(recordings)
}

# Sums column "gpu__time_duration.sum", in nanoseconds, by kernel: "total launches name", most first.
kernel_times() {
  awk -F'","' '
    /"Kernel Name"/ { for (i = 1; i <= NF; ++i) { gsub(/"/, "", $i); if ($i == "Kernel Name") name = i; if ($i ~ /^gpu__time_duration/) time = i } next }
    name && time && NF >= time { value = $time; gsub(/[",]/, "", value); if (value + 0 > 0) { total[$name] += value; ++count[$name] } }
    END { for (kernel in total) printf "%d %d %s\n", total[kernel], count[kernel], kernel }' "$1" | sort -rn
}

step_ncu() {
  local ncu=${NCU:-$(find_tool ncu)} times
  [[ -n $ncu ]] || { echo "gpu_visit: ncu is not here"; return 1; }
  times=$(mktemp)
  local program=("$bin/device_benchmark" soak --device cuda --frames 20 --warm-up 1 --seconds 0 --sequence "$(recordings | head -1)")
  # Ten frames behind the first lap; one of the ten is relocalised and refined as well.
  try "$ncu" --clock-control none --metrics gpu__time_duration.sum --csv --page raw --print-units base --launch-skip 2500 --launch-count 1200 \
    --log-file "$times" "${program[@]}"
  echo "kernels by time: [ns] in all, launches, name"
  kernel_times "$times" | tee "$times.sorted" | cut -c1-200
  # Names hold characters that mean something in patterns.
  head -5 "$times.sorted" | while read -r _ launches kernel; do
    kernel=${kernel//[^A-Za-z0-9_: ]/.}
    # Not the first launches, but one that there is: before those that were counted there were as many.
    local skipped=$((launches < 20 ? launches : 20))
    echo "=== $kernel"
    timeout 12 "$ncu" --clock-control none --kernel-name-base demangled --kernel-name "regex:^$kernel\$" --launch-skip "$skipped" --launch-count 1 \
      --section SpeedOfLight --section Occupancy --section LaunchStats --section MemoryWorkloadAnalysis --section WarpStateStats "${program[@]}" |
      grep -v '^==PROF=='
  done
  rm -f "$times" "$times.sorted"
}

step_soak() {
  while sleep 15; do nvidia-smi --query-gpu=memory.used,temperature.gpu,clocks.sm,power.draw --format=csv,noheader; done &
  local watching=$!
  try "$bin/device_benchmark" soak --device "$device" --sequence "$(recordings | head -1)" --seconds "$soak_s" $little
  kill $watching
}

rehearse=${GPU_VISIT_REHEARSE:-}
chosen=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --rehearse) rehearse=1 ;;
    --one) one=$2; shift ;;  # how the script calls itself, behind a time limit
    *) chosen+=("$1") ;;
  esac
  shift
done
device=cuda
little=
soak_s=120
if [[ -n $rehearse ]]; then
  device=cpu
  little='--frames 12 --warm-up 4'
  soak_s=0
  room='synthetic:office?width=160&height=120'
fi
if [[ -n ${one:-} ]]; then
  try "step_$one"
  exit $failed
fi
for step in "${chosen[@]}"; do
  [[ " ${steps[*]%%:*} " == *" $step "* ]] || { echo "gpu_visit.sh: no step is called '$step'; try --help" >&2; exit 2; }
done
if [[ ! -x $bin/device_benchmark ]]; then
  echo "gpu_visit.sh: $bin/device_benchmark is not there; run it where an archive of scripts/pack_gpu_run.sh is unpacked" >&2
  exit 2
fi

export GPU_VISIT_REHEARSE=$rehearse
OUT=${OUT:-gpu-visit}
mkdir -p "$OUT"
summary=()
num_failed=0
SECONDS=0
for entry in "${steps[@]}"; do
  step=${entry%%:*}
  limit_s=${entry##*:}
  [[ ${#chosen[@]} -eq 0 || $step == versions || " ${chosen[*]} " == *" $step "* ]] || continue
  ((limit_s > budget_s - SECONDS)) && limit_s=$((budget_s - SECONDS))
  if ((limit_s < 5)); then
    summary+=("$step: no time left")
    num_failed=$((num_failed + 1))
    continue
  fi
  began_s=$SECONDS
  status=0
  timeout --kill-after=5 "$limit_s" bash "$0" --one "$step" >"$OUT/$step.log" 2>&1 </dev/null || status=$?
  case $status in
    0) result=passed ;;
    77) result=skipped ;;
    124 | 137) result="stopped at its limit of $limit_s s" ;;
    *) result="failed with status $status" ;;
  esac
  [[ $status -eq 0 || $status -eq 77 ]] || num_failed=$((num_failed + 1))
  summary+=("$step: $result, after $((SECONDS - began_s)) s")
  echo "${summary[-1]}"
  if [[ $step == versions && $status -ne 0 && -z $rehearse ]]; then
    echo "gpu_visit: there is no GPU that can be used; what was said is in $OUT/versions.log:"
    tail -n 3 "$OUT/versions.log"
    exit 3
  fi
done

echo
for log in time compare; do
  [[ -e $OUT/$log.log ]] && grep -h -E '^\||preset|alike' "$OUT/$log.log"
done
echo
printf '%s\n' "${summary[@]}"
exit "$num_failed"
