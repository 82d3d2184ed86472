#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Checks that no call has become slower: instructions are counted, not time, so that a busy machine changes nothing.

    instruction_budget.py BUDGET [--update] COMMAND...

Runs the command under Valgrind and counts the instructions of each function that the budget lists, with all that it calls. Fails if one
needs more than its budget and a tenth. --update writes what was counted as the new budget. Waiting for memory is not seen.

A line of the budget holds a function and its instructions. Compilers differ: the budget is that of g++ 12 for x86-64-v3, optimised.
Exits with 77 (CTest: skipped) where Valgrind is absent.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

SLACK = 0.10
SKIPPED = 77


def read_budget(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.rsplit(maxsplit=1) for line in file if line.strip() and not line.startswith("#")]
    return {function: int(instructions.replace(",", "")) for function, instructions in lines}


def count_instructions(command, functions):
    """The instructions of each function and all that it calls; 0 if it never ran."""
    with tempfile.TemporaryDirectory() as folder:
        profile = os.path.join(folder, "profile")
        run = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}", *command]
        result = subprocess.run(run, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if result.returncode != 0:
            raise RuntimeError(f"{' '.join(run)}\n{result.stdout}failed with {result.returncode}")
        annotate = ["callgrind_annotate", "--inclusive=yes", "--threshold=100", profile]
        table = subprocess.run(annotate, capture_output=True, text=True, check=True).stdout
    counted = dict.fromkeys(functions, 0)
    for line in table.splitlines():
        row = re.match(r"\s*([\d,]+) \(.*?\)\s+\S*?:(foothold::.*)", line)
        if not row:
            continue
        for function in functions:
            if row.group(2).startswith(function + "("):
                counted[function] = max(counted[function], int(row.group(1).replace(",", "")))
    return counted


def write_budget(path, counted):
    with open(path, encoding="utf-8") as file:
        head = [line for line in file if line.startswith("#")]
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(head)
        file.writelines(f"{function} {instructions:,}\n" for function, instructions in counted.items())


def main(arguments):
    if len(arguments) < 3:
        print("usage: instruction_budget.py BUDGET [--update] COMMAND...", file=sys.stderr)
        return 2
    if not shutil.which("valgrind"):
        print("Valgrind is not installed; scripts/install_packages.sh --developer installs it")
        return SKIPPED
    path, command = arguments[1], arguments[2:]
    update = command[0] == "--update"
    budget = read_budget(path)
    counted = count_instructions(command[1:] if update else command, budget)
    if update:
        write_budget(path, counted)
    too_many = 0
    for function, instructions in counted.items():
        change = instructions / budget[function] - 1
        verdict = "never ran" if instructions == 0 else "over budget" if change > SLACK else "within budget"
        too_many += verdict != "within budget"
        print(f"{function}: {instructions:,} instructions, budget {budget[function]:,}, {100 * change:+.1f} %: {verdict}")
    if too_many and not update:
        print(f"If the work is worth it, write a new budget: {arguments[0]} {path} --update {' '.join(command)}")
    return 1 if too_many and not update else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
