#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Checks that every C++ and CUDA file is as clang-format 14 would write it.

    format.py REPOSITORY [--fix]

Exits with 77 (CTest: skipped) where clang-format 14 is absent, since other versions format differently.
"""

import os
import re
import shutil
import subprocess
import sys

VERSION = 14
SKIPPED = 77
TREES = ["modules", "apps", "tests"]
ENDINGS = (".h", ".cpp", ".cu", ".cuh")


def find_clang_format():
    for name in [f"clang-format-{VERSION}", "clang-format"]:
        path = shutil.which(name)
        if path:
            text = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
            found = re.search(r"version (\d+)\.", text)
            if found and int(found.group(1)) == VERSION:
                return path
    return None


def sources(repository):
    for tree in TREES:
        for folder, folders, names in os.walk(os.path.join(repository, tree)):
            folders.sort()
            yield from (os.path.join(folder, name) for name in sorted(names) if name.endswith(ENDINGS))


def main(arguments):
    if len(arguments) < 2:
        print("usage: format.py REPOSITORY [--fix]", file=sys.stderr)
        return 2
    clang_format = find_clang_format()
    if clang_format is None:
        print(f"clang-format {VERSION} is not installed; scripts/install_packages.sh --developer installs it")
        return SKIPPED
    files = list(sources(arguments[1]))
    if "--fix" in arguments[2:]:
        return subprocess.run([clang_format, "-i", *files], check=False).returncode
    result = subprocess.run([clang_format, "--dry-run", *files], capture_output=True, text=True, check=False)
    wrong = sorted({line.split(":")[0] for line in result.stderr.splitlines() if "[-Wclang-format-violations]" in line})
    for path in wrong:
        print(f"{os.path.relpath(path, arguments[1])}: differs from what clang-format {VERSION} writes; run scripts/format.sh")
    return 1 if wrong or result.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
