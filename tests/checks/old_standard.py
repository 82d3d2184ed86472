#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Checks what a host of an older C++ is told: for every public header, one sentence that says what to configure, and nothing
else; unless a header is so plain that it compiles all the same.

    old_standard.py REPOSITORY COMPILER INCLUDE_FOLDER...
"""

import pathlib
import subprocess
import sys

SENTENCE = "Foothold needs C++17"


def errors_of(compiler, standard, includes, header):
    command = [compiler, f"-std={standard}", "-fsyntax-only", "-x", "c++", *[f"-I{folder}" for folder in includes], "-"]
    result = subprocess.run(command, input=f'#include "{header}"\n', capture_output=True, text=True, check=False)
    return [line for line in result.stderr.splitlines() if "error: " in line]


def main(arguments):
    repository, compiler, *includes = arguments[1:]
    roots = sorted(pathlib.Path(repository).glob("modules/*/include"))
    violations = []
    for root in roots:
        for header in sorted(root.rglob("*.h")):
            name = header.relative_to(root)
            errors = errors_of(compiler, "c++11", [*roots, *includes], name)
            # The sentence, and the include that ends the compilation.
            if errors and (len(errors) != 2 or SENTENCE not in errors[0]):
                violations.append(f"{name}: expected '{SENTENCE}...' alone, got\n  " + "\n  ".join(errors[:3]))
    print("\n".join(violations) if violations else "old standards: told what to configure")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
