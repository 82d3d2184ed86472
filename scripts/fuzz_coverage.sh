#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Lists the lines of the files that parse which fuzzing has reached. scripts/fuzz.sh --coverage calls it.
#
#   scripts/fuzz_coverage.sh TARGET...
#
# Replays the corpora and what scripts/fuzz.sh kept of each TARGET in a build of its own, build/fuzz-coverage.
set -euo pipefail
cd "$(dirname "$0")/.."

folder=build/fuzz-coverage
cmake --preset fuzz -B "$folder" -DFOOTHOLD_SANITIZE=fuzzer-no-link -DCMAKE_CXX_FLAGS="-fprofile-instr-generate -fcoverage-mapping" >/dev/null
cmake --build "$folder" --target foothold_fuzzers >"$folder/build.log"

# The sources whose work begins with bytes from outside.
parsers=(
  modules/base/src/{checked_stream,number_text,input_file}.cpp
  modules/files/src/{scene_file,settings_file}.cpp
  modules/frames/src/raw_sequence.cpp
  modules/fusion/src/{fusion_persistence,quality/classifier,tsdf/tsdf_persistence}.cpp
  modules/io/src/{calibration_file,camera_model,image_header,keyed_numbers,mesh_file,ply_header,pose_lists,raw_image,recorded_pose,sens_file}.cpp
  modules/io/src/{text_file,time_unit,trajectory,tum_lists}.cpp
  modules/learning/src/forest_checkpoint.cpp
  modules/relocalisation/src/forest/{forest,forest_file}.cpp
  modules/relocalisation/src/{clustering/leaf_modes,examples/learnt_views,keyframe/keyframe_relocaliser,places/scene_places}.cpp
  modules/relocalisation/src/reservoirs/leaf_reservoirs.cpp
  modules/synthetic/src/synthetic_sequence.cpp
)

profiles=()
objects=()
for name in "$@"; do
  inputs=("tests/fuzz/corpus/$name")
  [[ ! -d build/fuzz/corpus/$name ]] || inputs+=("build/fuzz/corpus/$name")
  LLVM_PROFILE_FILE=$folder/$name.profraw "$folder/bin/fuzz_$name" -runs=0 "${inputs[@]}" >/dev/null 2>&1
  profiles+=("$folder/$name.profraw")
  objects+=(-object "$folder/bin/fuzz_$name")
done
llvm-profdata merge -sparse "${profiles[@]}" -o "$folder/all.profdata"
printf '\n| file | lines | covered %% |\n|---|---:|---:|\n'
llvm-cov report "${objects[@]}" -instr-profile="$folder/all.profdata" "${parsers[@]}" 2>/dev/null |
  awk '/\.cpp/ {print "| " $1 " | " $8 " | " $10 " |"} /^TOTAL/ {print "| all | " $8 " | " $10 " |"}'
