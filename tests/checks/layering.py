#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Proves from the sources that the architecture is as drawn: who includes whom, and what stays out of where.

    layering.py REPOSITORY

Prints one line per violation, "file:line: what", and exits with 1 if there are any.
"""

import os
import re
import sys

# What each module may include besides itself. Arrows point down only, and the modules of one layer never see each other.
BOTTOM = ["base", "api"]
LAYER_2 = ["files", "frames", "relocalisation", "fusion", "evaluation", "synthetic"]
ALLOWED = {
    "base": [],
    "api": ["base"],
    **{module: BOTTOM for module in LAYER_2},
    "reconstruction": BOTTOM + ["files", "frames", "relocalisation", "fusion"],
    "io": BOTTOM + LAYER_2,
    "openni": BOTTOM,
    "learning": BOTTOM + LAYER_2,
    "infinitam": BOTTOM + ["frames"],
}
# The rooms of a module's private sources, and what each may include besides itself. Sources beside the rooms compose them.
ROOMS = {
    "relocalisation": {"forest": [], "features": [], "reservoirs": ["features"], "clustering": ["reservoirs"], "pose": ["features", "reservoirs", "clustering"], "keyframe": []},
    "fusion": {"tsdf": [], "raycast": ["tsdf"], "mesh": ["tsdf"], "icp": [], "view": [], "quality": [], "recovery": []},
}
# A program of its own that lives in a module's folder: the driver plug-in that plays sequences to OpenNI2.
ALLOWED_BELOW = {"modules/openni/virtual_camera": ["frames", "io"]}

# External libraries, by the includes that betray them, and the places that may have them. "modules/x" covers everything below it.
LIBRARIES = [
    ("OpenCV", r"opencv2?/", ["modules/io", "modules/learning", "apps", "tests/io", "tests/learning", "tests/apps"]),
    ("OpenEXR", r"OpenEXR/|Imath/", ["modules/io/src/exr_image.cpp", "tests/io"]),
    ("OpenNI2", r"(OpenNI|Oni[A-Z]\w*|PS1080|Driver/OniDriverAPI)\.h$|openni2/", ["modules/openni", "tests/openni"]),
    ("nlohmann-json", r"nlohmann/", ["modules/files", "apps/common/json.cpp"]),
    ("CLI11", r"CLI/", ["apps/common/command_line.cpp"]),
    ("oneTBB", r"(oneapi/)?tbb/", ["modules/base/include/foothold/base/exec", "modules/base/src", "tests/support"]),
    ("OpenMP", r"omp\.h$", []),
    ("Catch2", r"catch2/", ["tests"]),
]
CUDA_HEADER = re.compile(r"^(cuda(_runtime|_runtime_api|_fp16|_bf16|_profiler_api)?\.h|(cuda|cub|thrust|nv)/|cooperative_groups|curand|cublas|device_launch)")
CUDA_FILES = (".cu", ".cuh")

# Words that no module may use: a library neither ends its host's process nor writes to its terminal.
FORBIDDEN_IN_MODULES = [
    (re.compile(r"\b(?:exit|_Exit|quick_exit|abort|terminate)\s*\("), "ends the process; throw an Error"),
    (re.compile(r"\bstd::c(?:out|err|log)\b|\b(?:printf|puts|putchar|perror)\s*\("), "writes to the terminal; use Context::log()"),
]
THREADS = re.compile(r"\bstd::(?:thread|jthread|async)\b|\bpthread_create\b|#\s*pragma\s+omp\b")
THREAD_FREE = ["modules/api", "modules/files", "modules/frames", "modules/relocalisation", "modules/fusion", "modules/reconstruction", "modules/synthetic", "modules/evaluation"]
THREADS_EXCEPT = re.compile(r"/background_\w+\.(h|cpp)$")  # background training lives on a thread of its own
LAUNCH = re.compile(r"<<<")
LAUNCH_PLACE = "modules/base/include/foothold/base/exec/"
EXECUTOR_INCLUDE = re.compile(r"^foothold/base/exec/(?:cpu_executor|cuda_executor)")

SOURCE_ENDINGS = (".h", ".cpp", ".cu", ".cuh")
SCRIPT_ENDINGS = (".py", ".sh")
SPDX = ["SPDX-License-Identifier: MIT", "Copyright (c) 2026 The Foothold authors"]
TREES = ["modules", "apps", "tests", "scripts", "cmake"]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def below(path, places):
    return any(path == place or path.startswith(place.rstrip("/") + "/") for place in places)


def without_comments_and_strings(text):
    """Blanks comments and literals, keeping lines where they are."""
    return COMMENT_OR_STRING.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


class Checker:
    def __init__(self, repository):
        self.repository = repository
        self.violations = []

    def report(self, path, line, what):
        self.violations.append(f"{path}:{line}: {what}")

    def run(self):
        for tree in TREES:
            for folder, folders, names in os.walk(os.path.join(self.repository, tree)):
                folders[:] = sorted(name for name in folders if not name.startswith((".", "__")))
                for name in sorted(names):
                    path = os.path.relpath(os.path.join(folder, name), self.repository)
                    if name.endswith(SOURCE_ENDINGS + SCRIPT_ENDINGS):
                        self.check_file(path)
        return self.violations

    def check_file(self, path):
        with open(os.path.join(self.repository, path), encoding="utf-8") as file:
            text = file.read()
        lines = text.split("\n")
        self.check_spdx(path, lines)
        if not path.endswith(SOURCE_ENDINGS):
            return
        if path.endswith((".h", ".cuh")) and "#pragma once" not in lines:
            self.report(path, 1, "a header without #pragma once")
        for number, line in enumerate(lines, 1):
            include = INCLUDE.match(line)
            if include:
                self.check_include(path, number, include.group(1) == '"', include.group(2))
        for number, line in enumerate(without_comments_and_strings(text).split("\n"), 1):
            self.check_words(path, number, line)

    def check_spdx(self, path, lines):
        mark = "// " if path.endswith(SOURCE_ENDINGS) else "# "
        first = 1 if lines[0].startswith("#!") else 0
        if lines[first : first + 2] != [mark + line for line in SPDX]:
            self.report(path, first + 1, "expected the two lines of the SPDX header")

    def check_include(self, path, number, quoted, included):
        parts = path.split("/")
        if parts[0] == "modules":
            self.check_module_include(path, number, parts[1], quoted, included)
        for name, pattern, places in LIBRARIES:
            if re.match(pattern, included) and not below(path, places):
                self.report(path, number, f"{name} ({included}) belongs in {', '.join(places) or 'no file'}")
        if CUDA_HEADER.match(included) and not path.endswith(CUDA_FILES):
            self.report(path, number, f"a CUDA header ({included}) belongs in .cu and .cuh files")

    def check_module_include(self, path, number, module, quoted, included):
        public = "/include/" in path
        if module not in ALLOWED:
            self.report(path, number, f"module {module} has no place in the layers; give it one in tests/checks/layering.py")
            return
        if included.startswith("foothold/"):
            other = included.split("/")[1]
            allowed = ALLOWED[module] + [extra for place in ALLOWED_BELOW if below(path, [place]) for extra in ALLOWED_BELOW[place]]
            if other != module and other not in allowed:
                self.report(path, number, f"{module} must not see {other} ({included})")
            if EXECUTOR_INCLUDE.match(included) and public and not path.startswith(LAUNCH_PLACE):
                self.report(path, number, f"an executor ({included}) must stay out of public headers")
        elif quoted:
            folder = os.path.dirname(path)
            candidates = [os.path.join(folder, included), os.path.join("modules", module, "src", included)]
            if public:
                self.report(path, number, f"a public header includes a private one ({included})")
            elif not any(os.path.exists(os.path.join(self.repository, candidate)) for candidate in candidates):
                self.report(path, number, f"{included} is not a private header of module {module}")
            self.check_room(path, number, module, included)

    def check_room(self, path, number, module, included):
        rooms = ROOMS.get(module, {})
        room = path.split("/")[3]  # modules/NAME/src/ROOM/FILE
        other = included.split("/")[0]
        if room in rooms and other in rooms and other != room and other not in rooms[room]:
            self.report(path, number, f"{room} must not see {other} ({included})")

    def check_words(self, path, number, line):
        if path.startswith("modules/"):
            for pattern, why in FORBIDDEN_IN_MODULES:
                for match in pattern.finditer(line):
                    self.report(path, number, f"'{match.group().strip()}' {why}")
        if THREADS.search(line) and below(path, THREAD_FREE) and not THREADS_EXCEPT.search(path):
            self.report(path, number, "a thread outside the executors; write the loop with an executor's verbs")
        if LAUNCH.search(line) and not path.startswith(LAUNCH_PLACE):
            self.report(path, number, f"a kernel launch outside {LAUNCH_PLACE}")


def main(arguments):
    if len(arguments) != 2 or not os.path.isdir(os.path.join(arguments[1], "modules")):
        print("usage: layering.py REPOSITORY", file=sys.stderr)
        return 2
    violations = Checker(arguments[1]).run()
    print("\n".join(violations) if violations else "layering: as drawn")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
