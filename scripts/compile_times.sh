#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Compiles from scratch without a compiler cache, and prints what each file and each folder costs in processor seconds of the compiler.
#
#   scripts/compile_times.sh [PRESET] [-DOPTION=VALUE...] [TARGET...]      default: release relocalisation_benchmark, which scripts/demo.sh builds
#
# Builds into build/compile-times/PRESET. TOP=N lists the N slowest files (default: 25). Processor time is hardly disturbed by other programs.
# Sources that are compiled as one are listed as TARGET/unity_N; -DFOOTHOLD_UNITY=OFF compiles and lists each by itself.
set -euo pipefail

# As the compiler's launcher: runs the compiler, and appends "USER SYSTEM OBJECT" to the log, in seconds.
if [[ ${1:-} == --launch ]]; then
  log=$2
  shift 2
  command=$*
  object=${command##* -o }
  TIMEFORMAT="%U %S ${object%% *}"
  { time "$@" 2>&3; } 3>&2 2>>"$log"
  exit
fi

cd "$(dirname "$0")/.."
preset=release
source scripts/preset_arguments.sh
[[ ${#others[@]} -gt 0 ]] || others=(relocalisation_benchmark)

build=build/compile-times/$preset
log=$PWD/$build/compile_times.log
launcher="$PWD/scripts/compile_times.sh;--launch;$log"
rm -rf "$build"
export CCACHE_DISABLE=1
cmake --preset "$preset" -B "$build" "${options[@]}" -DFOOTHOLD_CCACHE=OFF -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_CUDA_COMPILER_LAUNCHER="$launcher" >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target "${others[@]}" >/dev/null

# modules/io/CMakeFiles/foothold_io.dir/src/text_file.cpp.o is src/text_file.cpp of modules/io; .../foothold_io.dir/Unity/unity_0_cxx.cxx.o is
# foothold_io/unity_0.
awk -v top="${TOP:-25}" '
  {
    split($3, path, "/CMakeFiles/|[.]dir/")
    folder = path[1]
    is_unity = sub(/^Unity\//, "", path[3]) && sub(/_cxx[.]cxx/, "", path[3])
    file = folder "/" (is_unity ? path[2] "/" : "") path[3]
    sub(/\.o$/, "", file)
    seconds[file] = $1 + $2; sum[folder] += $1 + $2; total += $1 + $2; count[folder]++
  }
  function print_table(head, values, num_rows,    name, command) {
    print head
    command = "sort -rn | head -n " num_rows
    for (name in values) printf "%9.1f  %s%s\n", values[name], name, (name in count) ? sprintf(" (%d)", count[name]) : "" | command
    close(command)
  }
  END {
    print_table("  seconds  file", seconds, top)
    print ""
    print_table("  seconds  folder (files)", sum, 1000)
    printf "\n%9.1f  in all, %d files\n", total, NR
  }' "$log"
