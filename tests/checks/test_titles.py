#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Checks that no title of a test holds a semicolon.

    test_titles.py REPOSITORY

CMake's test discovery splits titles at semicolons. CTest then asks for a test that does not exist, runs nothing, and reports success.
"""

import os
import re
import sys

ENDINGS = (".h", ".cpp", ".cu", ".cuh")
LITERAL = r'"(?:\\.|[^"\\\n])*"'
# The macros of Catch2, with a class first in TEST_CASE_METHOD, and the title in one or several literals.
TEST = re.compile(rf"\b(?:\w*TEST_CASE\w*|SCENARIO\w*)\s*\(\s*(?:[\w:]+\s*,\s*)?({LITERAL}(?:\s*{LITERAL})*)")


def bad_titles(text):
    """(line, title) of each title with a semicolon."""
    for found in TEST.finditer(text):
        title = "".join(literal[1:-1] for literal in re.findall(LITERAL, found.group(1)))
        if ";" in title:
            yield text.count("\n", 0, found.start()) + 1, title


def sources(repository):
    for folder, folders, names in os.walk(os.path.join(repository, "tests")):
        folders.sort()
        yield from (os.path.join(folder, name) for name in sorted(names) if name.endswith(ENDINGS))


def main(arguments):
    if len(arguments) != 2:
        print("usage: test_titles.py REPOSITORY", file=sys.stderr)
        return 2
    violations = []
    for path in sources(arguments[1]):
        with open(path, encoding="utf-8") as file:
            for line, title in bad_titles(file.read()):
                name = os.path.relpath(path, arguments[1])
                violations.append(f"{name}:{line}: the title '{title}' has a semicolon, at which CMake's test discovery cuts it; use 'and' or a comma")
    print("\n".join(violations) if violations else "test_titles: no semicolons")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
