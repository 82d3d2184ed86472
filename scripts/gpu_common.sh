# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Sourced by test_gpu.sh and bench_gpu.sh: the modules that need no OpenCV, built with CUDA into build/gpu.

usage() { sed -n '/^# Copyright/,/^set /p' "$0" | sed '1d;$d;s/^#\( \|$\)//'; }

# build_for_gpu TARGET...
build_for_gpu() {
  local options=(-DCMAKE_BUILD_TYPE=Release -DFOOTHOLD_CUDA=ON -DFOOTHOLD_IO=OFF -DFOOTHOLD_OPENNI=OFF -DFOOTHOLD_WERROR=OFF)
  if [[ -n ${FOOTHOLD_DEPS:-} ]]; then
    [[ -d $FOOTHOLD_DEPS/lib/cmake ]] || { echo "FOOTHOLD_DEPS=$FOOTHOLD_DEPS: expected the folder that scripts/pack_gpu_deps.sh packed" >&2; exit 2; }
    options+=(-DCMAKE_PREFIX_PATH="$(cd "$FOOTHOLD_DEPS" && pwd)")
  fi
  # The architecture of the GPU that is here, so that no other code is built; 90 (H100, H200) where there is none.
  local architecture=${FOOTHOLD_CUDA_ARCHITECTURES:-}
  if [[ -z $architecture ]] && command -v nvidia-smi >/dev/null; then
    architecture=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2>/dev/null | head -1 | tr -d . || true)
  fi
  [[ $architecture =~ ^[0-9] ]] && options+=(-DFOOTHOLD_CUDA_ARCHITECTURES="$architecture")
  local generator=()
  command -v ninja >/dev/null && generator=(-G Ninja)
  cmake -S . -B build/gpu "${generator[@]}" "${options[@]}" "${FOOTHOLD_CMAKE_ARGS[@]}"
  cmake --build build/gpu --parallel "$(nproc)" --target "$@"
}

# Words from the environment for CMake's command line, e.g. FOOTHOLD_CMAKE="-DCMAKE_CUDA_COMPILER=/opt/cuda/bin/nvcc".
read -r -a FOOTHOLD_CMAKE_ARGS <<<"${FOOTHOLD_CMAKE:-}"

# The name of the GPU, or why there is none.
gpu_name() {
  if command -v nvidia-smi >/dev/null; then
    nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null || echo "no GPU (nvidia-smi fails)"
  else
    echo "no GPU (no nvidia-smi)"
  fi
}
