#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Checks that the documents agree with the repository.

    documents.py REPOSITORY

Links lead somewhere, sections included; files named in `code` exist; cited papers are in REFERENCES.md.
Every module, app and preset is named on its page, and docs/README.md lists every page.
The README is short, and its example is the one that tests compile.
"""

import json
import os
import re
import sys

LINK = re.compile(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)")
HEADING = re.compile(r"^#+ +(.*?) *$", re.MULTILINE)
CODE_PATH = re.compile(r"`((?:scripts|docs|modules|apps|tests|cmake|data|\.ci)/[\w./-]*\w)`")
CITATION = re.compile(r"\[([A-Z][a-z]+(?:[A-Z][a-z]+)*\d{4}[a-z]?)\]")
EXAMPLE = "tests/consumer/project/example.cpp"  # compiled by the consumer test, shown by the README
PLACEHOLDER = re.compile(r"(^|/)[A-Z]{4,}\b(?!\.md)")  # modules/NAME
NOT_APPS = {"common"}
PAGES = {"modules": "docs/using-the-library.md", "apps": "docs/programs.md"}  # where each is named
PRESETS = "docs/building.md"
INDEX = "docs/README.md"
MAX_README_LINES = 95
LISTED = re.compile(r"^- \*\*\[(\w+)\]\*\*", re.MULTILINE)
SOURCE_ENDINGS = (".h", ".cpp", ".cu", ".cuh", ".py", ".md")


class Checker:
    def __init__(self, repository):
        self.repository = repository
        self.violations = []

    def read(self, path):
        with open(os.path.join(self.repository, path), encoding="utf-8") as file:
            return file.read()

    def exists(self, path):
        return os.path.exists(os.path.join(self.repository, path))

    def files(self, trees, endings):
        for tree in trees:
            for folder, folders, names in os.walk(os.path.join(self.repository, tree)):
                folders[:] = sorted(name for name in folders if not name.startswith((".", "__")))
                for name in sorted(names):
                    if name.endswith(endings):
                        yield os.path.relpath(os.path.join(folder, name), self.repository)

    def documents(self):
        yield from sorted(name for name in os.listdir(self.repository) if name.endswith(".md"))
        yield from self.files(["docs", "modules", "data"], (".md",))

    def leads_somewhere(self, document, target, section):
        path = os.path.normpath(os.path.join(os.path.dirname(document), target)) if target else document
        return self.exists(path) and (not section or not path.endswith(".md") or section in self.sections(path))

    def sections(self, document):
        """The anchors of a document's headings, as GitHub makes them."""
        return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in HEADING.findall(self.read(document))}

    def check_paths(self):
        for document in self.documents():
            for number, line in enumerate(self.read(document).split("\n"), 1):
                for target, section in LINK.findall(line):
                    if "://" not in target and not self.leads_somewhere(document, target, section):
                        self.violations.append(f"{document}:{number}: the link to {target}{'#' + section if section else ''} leads nowhere")
                for path in CODE_PATH.findall(line):
                    if not PLACEHOLDER.search(path) and not self.exists(path):
                        self.violations.append(f"{document}:{number}: {path} does not exist")

    def check_citations(self):
        listed = set(LISTED.findall(self.read("REFERENCES.md")))
        cited = {}
        for path in self.files(["modules", "apps", "tests", "docs"], SOURCE_ENDINGS):
            for key in CITATION.findall(self.read(path)):
                cited.setdefault(key, path)
        for document in ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"]:
            for key in CITATION.findall(self.read(document)):
                cited.setdefault(key, document)
        for key in sorted(set(cited) - listed):
            self.violations.append(f"{cited[key]}: cites [{key}], which REFERENCES.md does not list")

    def check_names(self):
        for kind, page in PAGES.items():
            text = self.read(page)
            folder = os.path.join(self.repository, kind)
            for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
                part = os.path.join(folder, name)
                built = os.path.exists(os.path.join(part, "CMakeLists.txt")) or os.path.exists(os.path.join(part, "main.cpp"))
                if built and name not in NOT_APPS and f"`{name}`" not in text:
                    self.violations.append(f"{page}: does not name {kind}/{name}")
        text = self.read(PRESETS)
        for preset in json.loads(self.read("CMakePresets.json"))["configurePresets"]:
            if not preset.get("hidden") and f"`{preset['name']}`" not in text:
                self.violations.append(f"{PRESETS}: does not name the preset {preset['name']}")

    def check_index(self):
        listed = {os.path.normpath(os.path.join("docs", target)) for target, _ in LINK.findall(self.read(INDEX))}
        for page in self.files(["docs"], (".md",)):
            if page not in listed | {INDEX}:
                self.violations.append(f"{INDEX}: does not list {page}")

    def check_readme(self):
        example = self.read(EXAMPLE).split("// [begin]\n")[1].split("// [end]\n")[0]
        if f"```cpp\n{example}```\n" not in self.read("README.md"):
            self.violations.append(f"README.md: its example differs from {EXAMPLE}")
        num_lines = len(self.read("README.md").splitlines())
        if num_lines > MAX_README_LINES:
            self.violations.append(f"README.md: has {num_lines} lines, at most {MAX_README_LINES} are wanted; details belong into docs/")

    def run(self):
        self.check_paths()
        self.check_readme()
        self.check_names()
        self.check_index()
        self.check_citations()
        return self.violations


def main(arguments):
    if len(arguments) != 2:
        print("usage: documents.py REPOSITORY", file=sys.stderr)
        return 2
    violations = Checker(arguments[1]).run()
    print("\n".join(violations) if violations else "documents: agree with the repository")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
