#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Looks at every CUDA kernel without a GPU, and prints the two tables of docs/cuda.md.

    scripts/inspect_kernels.py [ARCHITECTURE]      default: 90

The first table holds what ptxas says of a kernel: registers, spills, stack, shared memory. The second holds what its PTX shows: local memory,
64-bit divisions, double precision, and how the 32 lanes of a warp address global memory, side by side:

    one         all at one address
    side by side    each behind its neighbour: coalesced
    strided     a fixed distance apart that is more than they read: part of what the memory fetches goes unused
    scattered   as the data has it

Needs nvcc, CMake and Ninja, but no GPU. Fails if a kernel of Foothold's own spills registers, or divides 64-bit integers or computes in
double precision without being listed below as one that is meant to.
"""

import json
import os
import re
import shlex
import subprocess
import sys

BUILD = "build/kernels"
# Few threads solve 6x6 systems or invert covariances, whose condition needs it.
MAY_USE_DOUBLE = {"AlignByProjection", "AlignWithPoints", "ClusterLeaf", "EndIcp", "RefineHypothesis", "SolveStep", "TotalTiles"}
# Once for each leaf, of a product that does not fit 32 bits.
MAY_DIVIDE_LONG = {"MakePriorityKey"}

ENTRY = re.compile(r"\.(?:entry|func)\s+(?:\([^)]*\)\s*)?([\w$]+)\s*\(.*?\)[^{;]*\{(.*?)^\}", re.DOTALL | re.MULTILINE)
INSTRUCTION = re.compile(r"^\s*(?:@!?(%p\d+)\s+)?([a-z][\w.]*)\s+([^;]*);", re.MULTILINE)
DEPOT = re.compile(r"\.local\s+\.align\s+\d+\s+\.b8\s+__local_depot\w+\[(\d+)\]")
OPERAND = re.compile(r"[^,\[\]{}]+")
WIDTHS = {"8": 1, "16": 2, "32": 4, "64": 8, "128": 16}
SCATTERED = None  # in place of a stride


def integer(text):
    try:
        return int(text, 0)
    except ValueError:
        return None


class Lanes:
    """How far the values of each register lie apart from one lane to the next: 0 for one value, None for no fixed distance."""

    def __init__(self, instructions):
        self.strides = {}
        changed = True
        while changed:  # registers that loops assign again settle at what all assignments agree on
            changed = False
            for opcode, operands in instructions:
                changed |= self.assign(opcode, operands)

    def of(self, operand):
        operand = re.match(r"[\[\s]*([^\s+\]]*)", operand).group(1)
        if operand == "%tid.x" or operand == "%laneid":
            return 1
        return self.strides.get(operand, "unknown") if re.fullmatch(r"%[a-z]+\d+", operand) else 0

    def assign(self, opcode, operands):
        kind = opcode.split(".")[0]
        if kind in ("st", "bra", "ret", "bar", "barrier", "red", "call", "exit", "membar", "fence") or not operands:
            return False
        targets = re.findall(r"%[a-z]+\d+", operands[0])
        stride = self.result(kind, opcode, operands)
        if stride == "unknown":
            return False
        changed = False
        for target in targets:
            before = self.strides.get(target, "unknown")
            after = stride if before in ("unknown", stride) else SCATTERED
            changed |= after != before
            self.strides[target] = after
        return changed

    def result(self, kind, opcode, operands):
        sources = [self.of(operand) for operand in operands[1:]]
        known = [stride for stride in sources if stride != "unknown"]
        if not known:
            return "unknown" if sources else 0
        if "unknown" in sources and kind not in ("add", "sub", "mad"):
            return "unknown"
        if kind == "ld":
            return 0 if ".param" in opcode or (known[0] == 0 and ".local" not in opcode) else SCATTERED
        if all(stride == 0 for stride in known):
            return "unknown" if "unknown" in sources else 0
        if any(stride is SCATTERED for stride in known) or "unknown" in sources or ".f" in opcode:
            return SCATTERED if "unknown" not in sources else "unknown"
        return self.affine(kind, operands, sources)

    @staticmethod
    def affine(kind, operands, sources):
        factors = [integer(operand.strip()) for operand in operands[1:]]
        if kind in ("mov", "cvt", "cvta"):
            return sources[0]
        if kind == "add":
            return sources[0] + sources[1]
        if kind == "sub":
            return sources[0] - sources[1]
        if kind == "shl" and factors[1] is not None:
            return sources[0] << factors[1]
        if kind in ("mul", "mad") and (factors[0] is not None or factors[1] is not None):
            product = sources[1] * factors[0] if factors[0] is not None else sources[0] * factors[1]
            return product + (sources[2] if kind == "mad" else 0)
        return SCATTERED


def operands_of(text):
    """Splits at commas outside of braces and brackets."""
    return [part.strip() for part in re.findall(r"\{[^}]*\}|\[[^\]]*\]|[^,{}\[\]\s][^,{}\[\]]*", text)]


class Kernel:
    """What the PTX of one entry shows."""

    def __init__(self, body):
        instructions = [(opcode, operands_of(operands)) for _, opcode, operands in INSTRUCTION.findall(body)]
        opcodes = [opcode for opcode, _ in instructions]
        depot = DEPOT.search(body)
        self.local_bytes = int(depot.group(1)) if depot else 0
        self.local_accesses = sum(bool(re.match(r"(?:ld|st)\.local", opcode)) for opcode in opcodes)
        self.long_divisions = sum(bool(re.match(r"(?:div|rem)\.[su]64", opcode)) for opcode in opcodes)
        self.doubles = sum(".f64" in opcode and not opcode.startswith(("mov", "ld", "st")) for opcode in opcodes)
        self.accesses = {"one": 0, "side by side": 0, "strided": 0, "scattered": 0}
        self.widest_stride = 0
        lanes = Lanes(instructions)
        for opcode, operands in instructions:
            if re.match(r"(?:ld|st|red|atom)\.(?:\w+\.)*?global", opcode):
                self.count(opcode, operands, lanes)

    def count(self, opcode, operands, lanes):
        address = next(operand for operand in operands if operand.startswith("["))
        stride = lanes.of(address)
        vector = re.search(r"\.v(\d)\b", opcode)
        num_bytes = WIDTHS[re.search(r"\.[a-z](\d+)$", opcode).group(1)] * (int(vector.group(1)) if vector else 1)
        if stride == 0:
            kind = "one"
        elif stride is SCATTERED or stride == "unknown":
            kind = "scattered"
        else:
            kind = "side by side" if abs(stride) <= num_bytes else "strided"
            if kind == "strided":
                self.widest_stride = max(self.widest_stride, abs(stride))
        self.accesses[kind] += 1


def kernels_of(ptx):
    return {name: Kernel(body) for name, body in ENTRY.findall(ptx)}


def resources_of(log):
    """Registers, spilled bytes, stack and shared memory by kernel, from what ptxas -v prints."""
    kernels = {}
    for block in re.split(r"ptxas info\s*: Compiling entry function '", log)[1:]:
        stack, stores, loads = map(int, re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", block).groups())
        registers = int(re.search(r"Used (\d+) registers", block).group(1))
        shared = re.search(r"(\d+) bytes smem", block)
        kernels[block.split("' for '")[0]] = (registers, stores + loads, stack, int(shared.group(1)) if shared else 0)
    return kernels


def label_of(mangled):
    """Whether a kernel is a library's, its short name, and what one thread block or thread works on."""
    name = subprocess.run(["c++filt", mangled], capture_output=True, text=True, check=True).stdout.strip()
    ours = re.search(r"for_each(_team)?(?:_with_scratch)?_kernel<(.*)>\(", name.replace("foothold::", "").replace("detail::", ""))
    if ours:
        team, arguments = ours.groups()
        body = re.sub(r"^(?:[\w:]+::)?\w+(?:Scratch|Shared)\w*, ", "", arguments) if team else arguments
        return False, re.sub(r"<CudaExecutor>|\(int\)|\(Device\)|\(IcpResiduals\)|\s+$", "", body).strip(), "team" if team else "item"
    library = re.search(r"(Device\w+Kernel|EmptyKernel|static_kernel)", name)
    short = library.group(1) if library else re.sub(r"\(.*", "", name.replace("(anonymous namespace)::", "")).split("::")[-1]
    return "cub" in name, short, "library" if "cub" in name else "item"


def compile_commands(architecture):
    """The command for each CUDA source of the modules."""
    words = shlex.split(os.environ.get("FOOTHOLD_CMAKE", ""))
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DFOOTHOLD_CUDA=ON", "-DFOOTHOLD_IO=OFF", "-DFOOTHOLD_OPENNI=OFF", "-DBUILD_TESTING=OFF"]
    subprocess.run(["cmake", "-S", ".", "-B", BUILD, "-G", "Ninja", f"-DFOOTHOLD_CUDA_ARCHITECTURES={architecture}", *options, *words], check=True, stdout=subprocess.DEVNULL)
    with open(f"{BUILD}/compile_commands.json", encoding="utf-8") as file:
        return [entry for entry in json.load(file) if entry["file"].endswith(".cu")]


def compile_to_ptx(entry, architecture):
    """The path of the PTX of a source."""
    words = shlex.split(entry["command"])
    words = words[next(i for i, word in enumerate(words) if os.path.basename(word) == "nvcc") :]
    kept = [word for word in words if not word.startswith(("--generate-code", "-gencode"))]
    output = kept.index("-o")
    ptx = os.path.join(os.path.abspath(BUILD), os.path.basename(entry["file"]) + ".ptx")
    kept = [word for word in kept[:output] + kept[output + 2 :] if word != "-c"]
    subprocess.run([*kept, f"-arch=compute_{architecture}", "-ptx", "-o", ptx], cwd=entry["directory"], check=True)
    return words[0], ptx


def inspect(architecture):
    resources, kernels = {}, {}
    for entry in compile_commands(architecture):
        nvcc, ptx = compile_to_ptx(entry, architecture)
        ptxas = os.path.join(os.path.dirname(os.path.realpath(nvcc)), "ptxas")
        log = subprocess.run([ptxas, "-v", f"-arch=sm_{architecture}", ptx, "-o", os.devnull], check=True, capture_output=True, text=True)
        resources.update(resources_of(log.stderr + log.stdout))
        with open(ptx, encoding="utf-8") as file:
            kernels.update(kernels_of(file.read()))
    return {label_of(name): (numbers, kernels[name]) for name, numbers in resources.items()}


def print_tables(found, architecture):
    print(f"| Kernel (sm_{architecture}) | by | registers | spilled [B] | stack [B] | shared [B] |\n|---|---|---:|---:|---:|---:|")
    for (library, name, kind), (numbers, _) in found:
        print(f"| `{name}`{' (CUB)' if library else ''} | {kind} | " + " | ".join(map(str, numbers)) + " |")
    print("\n| Kernel | local [B] | 64-bit divisions | double | one | side by side | strided (by up to [B]) | scattered |\n|---|---:|---:|---:|---:|---:|---:|---:|")
    for (library, name, _), (_, kernel) in found:
        if library:
            continue
        accesses = kernel.accesses
        strided = f"{accesses['strided']} ({kernel.widest_stride})" if accesses["strided"] else "0"
        print(f"| `{name}` | {kernel.local_bytes} | {kernel.long_divisions} | {kernel.doubles} | {accesses['one']} | {accesses['side by side']} | {strided} | {accesses['scattered']} |")


def complaints_about(found):
    for (library, name, _), (numbers, kernel) in found:
        if library:
            continue
        if numbers[1] > 0:
            yield f"{name}: spills registers"
        if kernel.long_divisions > 0 and name not in MAY_DIVIDE_LONG:
            yield f"{name}: divides 64-bit integers, which costs some hundred instructions"
        if kernel.doubles > 0 and name not in MAY_USE_DOUBLE:
            yield f"{name}: computes in double precision, at 1/64 of the speed on most GPUs"


def main(arguments):
    if len(arguments) > 2 or (len(arguments) == 2 and not arguments[1].isdigit()):
        print("usage: scripts/inspect_kernels.py [ARCHITECTURE]", file=sys.stderr)
        return 2
    os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
    architecture = arguments[1] if len(arguments) == 2 else "90"
    found = sorted(inspect(architecture).items(), key=lambda item: item[0])
    print_tables(found, architecture)
    complaints = list(complaints_about(found))
    print("\n".join(complaints), file=sys.stderr)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
