#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Packs all that a visit to a GPU machine needs: programs with the libraries that they use, recordings, and gpu_visit.sh. Nothing is compiled,
# installed or downloaded there: the machine needs an x86-64 Linux with glibc 2.39 or later (Ubuntu 24.04) and the NVIDIA driver.
#
#   scripts/pack_gpu_run.sh [--recording NAME=FOLDER]... [--frames N] [--architectures LIST] [--out ARCHIVE]
#
# --recording       a recording that this machine can read (docs/sequences.md), for tests of accuracy and speed: its first N frames (200),
#                   depth in millimetres, colour in steps of 8. A rendered room is tested in any case; the programs render it themselves.
# --architectures   GPUs to compile for, as CMAKE_CUDA_ARCHITECTURES has them (75-virtual;90-real: H100 and H200, all since Turing by PTX)
# --out             default: build/foothold_gpu_run.tar.gz
#
# There: tar -xzf foothold_gpu_run.tar.gz && OUT=FOLDER foothold_gpu_run/gpu_visit.sh
set -euo pipefail
cd "$(dirname "$0")/.."

usage() { sed -n '/^# Copyright/,/^set /p' "$0" | sed '1d;$d;s/^#\( \|$\)//'; }
glibc_there=2.39
max_bytes=60000000

recordings=()
frames=200
architectures='75-virtual;90-real'
archive=build/foothold_gpu_run.tar.gz
while [[ $# -gt 0 ]]; do
  case $1 in
    --help) usage; exit 0 ;;
    --recording | --frames | --architectures | --out)
      [[ $# -gt 1 ]] || { echo "pack_gpu_run.sh: $1 needs a value; try --help" >&2; exit 2; } ;;&
    --recording)
      [[ $2 =~ ^[A-Za-z0-9_-]+=. ]] || { echo "pack_gpu_run.sh: --recording: got '$2', expected NAME=FOLDER" >&2; exit 2; }
      recordings+=("$2") ;;
    --frames) frames=$2 ;;
    --architectures) architectures=$2 ;;
    --out) archive=$2 ;;
    *) echo "pack_gpu_run.sh: unknown argument $1; try --help" >&2; exit 2 ;;
  esac
  shift 2
done

build=build/gpu-run
programs=(foothold_gpu_tests device_benchmark)
# The old kind of run path: it holds for the libraries' own libraries, too.
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DFOOTHOLD_CUDA=ON -DFOOTHOLD_IO=OFF -DFOOTHOLD_OPENNI=OFF \
  -DFOOTHOLD_CUDA_ARCHITECTURES="$architectures" -DCMAKE_BUILD_RPATH="\$ORIGIN/../lib" -DCMAKE_EXE_LINKER_FLAGS=-Wl,--disable-new-dtags >/dev/null
cmake --build "$build" --target "${programs[@]}"

staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
run=$staging/foothold_gpu_run
mkdir -p "$run/bin" "$run/lib" "$run/recordings" "$(dirname "$archive")"
for program in "${programs[@]}"; do
  strip -o "$run/bin/$program" "$build/bin/$program"
  # All libraries but those of glibc, whose parts must be of one version.
  ldd "$build/bin/$program" | awk '$3 ~ "^/" && $1 !~ "^(libc|libm|libdl|librt|libpthread)[.]so" {print $3}' |
    while read -r library; do cp --dereference --no-clobber "$library" "$run/lib/"; done
done

# What runs there must find every library in the pack or in glibc, and ask for no newer glibc than is there.
for file in "$run"/bin/* "$run"/lib/*; do
  if elsewhere=$(LD_LIBRARY_PATH="$run/lib" ldd "$file" | grep -v -E "^[[:space:]]*(linux-vdso|/lib64/ld-linux|(libc|libm|libdl|librt|libpthread)[.]so|$run/lib|[^ ]+ => $run/lib)"); then
    echo "pack_gpu_run.sh: $(basename "$file") needs what is not in the pack:" $elsewhere >&2
    exit 1
  fi
  newest=$(objdump -T "$file" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -1)
  if [[ $(printf '%s\n' "GLIBC_$glibc_there" "$newest" | sort -V | tail -1) != "GLIBC_$glibc_there" ]]; then
    echo "pack_gpu_run.sh: $(basename "$file") needs $newest, expected at most GLIBC_$glibc_there: pack on an older system" >&2
    exit 1
  fi
done
if readelf -d "$run"/bin/* | grep -E 'R(UN)?PATH' | grep -v -F "[\$ORIGIN/../lib]"; then
  echo "pack_gpu_run.sh: programs look for libraries outside of the pack" >&2
  exit 1
fi

if [[ ${#recordings[@]} -gt 0 ]]; then
  scripts/install_packages.sh  # OpenCV
  cmake -S . -B build/gpu-run-recordings -G Ninja -DCMAKE_BUILD_TYPE=Release -DFOOTHOLD_CUDA=OFF >/dev/null
  cmake --build build/gpu-run-recordings --target render_sequence
  for recording in "${recordings[@]}"; do
    raw=$staging/raw
    build/gpu-run-recordings/bin/render_sequence --sequence "${recording#*=}@0:$frames" --raw --out "$raw"
    "$run/bin/device_benchmark" pack --sequence "$raw" --frames "$frames" --out "$run/recordings/${recording%%=*}"
    rm "$raw"
  done
fi

cp scripts/gpu_visit.sh "$run/"
git describe --always --dirty >"$run/VERSION" 2>/dev/null || echo unknown >"$run/VERSION"
tar -C "$staging" --owner=0 --group=0 -czf "$archive" foothold_gpu_run
(cd "$run" && du --bytes --total bin/* lib/* recordings/* 2>/dev/null)
num_bytes=$(stat --format=%s "$archive")
echo "packed $num_bytes bytes into $archive"
if ((num_bytes > max_bytes)); then
  echo "pack_gpu_run.sh: expected at most $max_bytes bytes: pack fewer --frames or recordings" >&2
  exit 1
fi
