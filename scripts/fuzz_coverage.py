#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Which part of the files that parse fuzzing has reached; scripts/fuzz.sh --coverage calls it.

    scripts/fuzz_coverage.py TARGET...

Replays the corpora, and what scripts/fuzz.sh kept, of each TARGET in build/fuzz. Counts edges of the control flow, of which exceptions and
out-of-memory paths are many: no run covers all. A function that several targets have counts where most of it was covered.
"""

import pathlib
import re
import subprocess
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
LINE = re.compile(r"^(?:UN)?COVERED_FUNC: hits: \d+ edges: (\d+)/(\d+) (.*) \S*?(modules/[^:]*\.cpp):(\d+)$", re.MULTILINE)
# The sources whose work begins with bytes from outside.
PARSERS = {
    "base": "checked_stream input_file number_text",
    "files": "scene_file settings_file",
    "frames": "raw_sequence",
    "fusion": "classifier fusion_persistence tsdf_persistence",
    "io": "calibration_file camera_model image_decoding image_header keyed_numbers mesh_file ply_header pose_lists raw_image recorded_pose "
          "sens_file text_file time_unit trajectory tum_lists",
    "learning": "forest_checkpoint",
    "relocalisation": "forest forest_file keyframe_relocaliser leaf_modes leaf_reservoirs learnt_views scene_places",
}  # fmt: skip


def is_parser(path):
    parts = pathlib.Path(path).parts
    return pathlib.Path(path).stem in PARSERS.get(parts[1], "").split()


def covered(target):
    """{(file, line, function): (edges covered, edges)}"""
    kept = REPOSITORY / "build" / "fuzz" / "corpus" / target
    folders = [REPOSITORY / "tests" / "fuzz" / "corpus" / target] + ([kept] if kept.exists() else [])
    command = [REPOSITORY / "build" / "fuzz" / "bin" / f"fuzz_{target}", "-runs=0", "-print_coverage=1", *folders]
    result = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, errors="replace", check=True)
    return {
        (path, int(line), function): (int(hit), int(edges))
        for hit, edges, function, path, line in LINE.findall(result.stderr)
        if is_parser(path)
    }


def main():
    functions = {}
    for target in sys.argv[1:]:
        for function, (hit, edges) in covered(target).items():
            best = functions.get(function, (0, 0))
            functions[function] = (max(best[0], hit), max(best[1], edges))
    files = {}
    for (path, _, _), (hit, edges) in functions.items():
        total = files.setdefault(path, [0, 0, 0, 0])
        for i, number in enumerate([hit, edges, hit > 0, 1]):
            total[i] += number
    print("\n| file | functions | reached % | edges | covered % |\n|---|---:|---:|---:|---:|")
    files["all"] = [sum(total[i] for total in files.values()) for i in range(4)]
    for path in sorted(files, key=lambda name: (name == "all", name)):
        hit, edges, reached, count = files[path]
        print(f"| {path} | {count} | {100 * reached / max(1, count):.0f} | {edges} | {100 * hit / max(1, edges):.0f} |")


if __name__ == "__main__":
    main()
