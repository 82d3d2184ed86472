#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
#
# Prints the registers, spills, stack and shared memory of every kernel, as ptxas reports them, as the table in docs/cuda.md.
# Needs nvcc, but no GPU. Fails if a kernel of Foothold's own spills registers.
#
#   scripts/kernel_resources.sh [ARCHITECTURE]      default: 90
set -euo pipefail
cd "$(dirname "$0")/.."

architecture=${1:-90}
log=build/kernel-resources/ptxas.log
read -r -a words <<<"${FOOTHOLD_CMAKE:-}"
cmake -S . -B build/kernel-resources -DCMAKE_BUILD_TYPE=Release -DFOOTHOLD_CUDA=ON -DFOOTHOLD_IO=OFF -DFOOTHOLD_OPENNI=OFF -DBUILD_TESTING=OFF \
  -DFOOTHOLD_CUDA_ARCHITECTURES="$architecture" -DCMAKE_CUDA_FLAGS=-Xptxas=-v ${FOOTHOLD_DEPS:+-DCMAKE_PREFIX_PATH="$FOOTHOLD_DEPS"} "${words[@]}" >/dev/null
# ptxas speaks only where it runs, so everything is compiled anew; a compiler cache repeats what it said.
cmake --build build/kernel-resources --parallel "$(nproc)" --clean-first --target foothold_relocalisation foothold_fusion >"$log" 2>&1 ||
  { cat "$log" >&2; exit 1; }
python3 - "$log" "$architecture" <<'PYTHON'
import re
import subprocess
import sys

path, architecture = sys.argv[1:]
text = subprocess.run(["c++filt"], input=open(path, encoding="utf-8").read(), capture_output=True, text=True, check=True).stdout
kernels = {}
for block in re.split(r"ptxas info\s*: Compiling entry function '", text)[1:]:
    name = block.split("' for '")[0]
    stack, stores, loads = map(int, re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", block).groups())
    registers = int(re.search(r"Used (\d+) registers", block).group(1))
    shared = re.search(r"(\d+) bytes smem", block)
    kernels[name] = (registers, stores + loads, stack, int(shared.group(1)) if shared else 0)


def short(name):
    ours = re.search(r"for_each(_team)?_kernel<(.*)>\(", name.replace("foothold::", "").replace("detail::", ""))
    if ours:
        team, arguments = ours.groups()
        body = arguments.split(", ", 1)[1] if team else arguments
        body = re.sub(r"<CudaExecutor>|\(int\)|\s+$", "", body).strip()
        return (0, body, "`" + body + "`", "team" if team else "item")
    name = name.replace("(anonymous namespace)::", "")
    library = re.search(r"(Device\w+Kernel|EmptyKernel|static_kernel)", name)
    label = library.group(1) if library else re.sub(r"\(.*", "", name).split("::")[-1]
    return (1, label, "`" + label + "` (CUB)" if "cub" in name else "`" + label + "`", "library" if "cub" in name else "item")


print(f"| Kernel (sm_{architecture}) | by | registers | spilled [B] | stack [B] | shared [B] |\n|---|---|---:|---:|---:|---:|")
rows = sorted((short(name), numbers) for name, numbers in kernels.items())
for (_, _, label, kind), (registers, spilled, stack, shared) in rows:
    print(f"| {label} | {kind} | {registers} | {spilled} | {stack} | {shared} |")
spilling = [label for (library, _, label, _), numbers in rows if library == 0 and numbers[1] > 0]
if spilling:
    sys.exit("spills registers: " + ", ".join(spilling))
PYTHON
