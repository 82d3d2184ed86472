#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Builds the fuzz targets with clang, and runs them one after another, each for its share of the time.
#
#   scripts/fuzz.sh MINUTES [--coverage] [TARGET...]      e.g.  scripts/fuzz.sh 60        scripts/fuzz.sh 5 forest map
#
# TARGET is NAME of tests/fuzz/NAME_fuzz.cpp; without any, all run. Inputs that reached something new are kept in build/fuzz/corpus/NAME, and
# the next run begins with them. Inputs that crash, take more than 20 s or 2 GB are findings: they lie in build/fuzz/findings/NAME, with the
# log in build/fuzz/logs/NAME.txt, and the script ends with 1. To see one again: build/fuzz/bin/fuzz_NAME FILE.
#
# --coverage then replays all kept inputs, and lists how much of every file that parses they reach.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  echo "usage: scripts/fuzz.sh MINUTES [--coverage] [TARGET...]; $1" >&2
  exit 2
}
[[ ${1:-} =~ ^[0-9]+$ ]] || usage "got '${1:-}', expected a number of minutes"
minutes=$1
shift
coverage=false
targets=()
for argument in "$@"; do
  case $argument in
    --coverage) coverage=true ;;
    *) [[ -f tests/fuzz/${argument}_fuzz.cpp ]] || usage "there is no tests/fuzz/${argument}_fuzz.cpp"
      targets+=("$argument") ;;
  esac
done
if [[ ${#targets[@]} -eq 0 ]]; then
  for source in tests/fuzz/*_fuzz.cpp; do
    name=$(basename "$source")
    targets+=("${name%_fuzz.cpp}")
  done
fi

scripts/install_packages.sh --developer
scripts/build.sh fuzz foothold_fuzzers

seconds=$((minutes * 60 / ${#targets[@]}))
mkdir -p build/fuzz/logs
num_findings=0
printf '\n| target | seconds | executions | edges | features | findings |\n|---|---:|---:|---:|---:|---:|\n'
for name in "${targets[@]}"; do
  kept=build/fuzz/corpus/$name findings=build/fuzz/findings/$name log=build/fuzz/logs/$name.txt
  rm -rf "$findings"
  mkdir -p "$kept" "$findings"
  status=0
  build/fuzz/bin/fuzz_"$name" -max_total_time=$((seconds > 0 ? seconds : 1)) -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$findings/" "$kept" "tests/fuzz/corpus/$name" >"$log" 2>&1 || status=$?
  found=$(find "$findings" -type f ! -name 'slow-unit-*' | wc -l)
  if [[ $status -ne 0 && $found -eq 0 ]]; then found=1; fi
  num_findings=$((num_findings + found))
  last=$(grep -E '^#[0-9]+.* cov: ' "$log" | tail -n 1 || true)
  printf '| %s | %d | %s | %s | %s | %d |\n' "$name" "$seconds" \
    "$(awk '/^stat::number_of_executed_units/ {print $2}' "$log")" \
    "$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' <<<"$last")" "$(sed -n 's/.* ft: \([0-9]*\).*/\1/p' <<<"$last")" "$found"
done

if $coverage; then scripts/fuzz_coverage.py "${targets[@]}"; fi
if [[ $num_findings -gt 0 ]]; then
  echo "fuzz: $num_findings findings in build/fuzz/findings" >&2
  exit 1
fi
