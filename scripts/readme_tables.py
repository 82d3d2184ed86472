#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Writes the README's tables of results between their markers, from the JSON files of scripts/report.sh.

    readme_tables.py write RESULTS README --commit COMMIT
    readme_tables.py check README

`check` finds tables that are stale in form: markers, stamp, columns. Numbers are not checked; they belong to the commit and machine of the stamp.
"""

import argparse
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "report"))
from load import BadResults, Results  # noqa: E402  (the path comes first)

BEGIN = "<!-- results: written by scripts/readme_tables.py, do not edit -->"
END = "<!-- results: end -->"
STAMP = re.compile(r"^Commit [0-9a-f]{7,40}( with changes)?, .+, \d+ hardware threads?, seed \d+\.$")
PROTOCOL_COLUMNS = ["recording", "method", "found %", "first success", "median error", "learn, CPU ms", "relocalise, CPU ms", "scene, MB"]
ROOM_COLUMNS = ["forest trained on", "method"]  # then a column per room, and the average
ROOM_LAST_COLUMN = "average"


def line(cells):
    return "| " + " | ".join(cells) + " |"


def table(columns, rows, num_left):
    rule = "|" + "|".join("---" if i < num_left else "---:" for i in range(len(columns))) + "|"
    return [line(columns), rule, *map(line, rows)]


def protocol_rows(results):
    rows = []
    for experiment, words in (("loss", ""), ("gap", ", 30 frames ahead")):
        for name, document in results.parts("recordings", experiment):
            for method, numbers in document["methods"].items():
                first = numbers["first_success_frame"]
                translation = numbers["median_translation_error_m"]
                error = "–" if translation is None else f"{1000 * translation:.1f} mm, {numbers['median_rotation_error_deg']:.2f}°"
                rows.append([name + words, method, f"{100 * numbers['recall']['5cm_5deg']:.1f}", "–" if first is None else f"frame {first}", error,
                             f"{numbers['train_cpu_ms']['median']:.1f}", f"{numbers['relocalise_cpu_ms']['median']:.1f}", f"{numbers['state_mb']:.1f}"])
    return rows


def room_table(document):
    scenes = [scene["name"] for scene in document["scenes"]]
    rows = {}
    for run in document["runs"]:
        rows.setdefault((run["forest"] or "–", run["method"]), {})[run["scene"]] = 100 * run["recall"]["5cm_5deg"]
    lines = [[*names, *(f"{cells[s]:.1f}" for s in scenes), f"{sum(cells.values()) / len(cells):.1f}"] for names, cells in rows.items()]
    return table([*ROOM_COLUMNS, *scenes, ROOM_LAST_COLUMN], lines, 2)


def block(results, commit):
    """The text between the markers, as lines."""
    rooms, recordings = results.get("rooms", "adapt"), protocol_rows(results)
    if rooms is None or not recordings:
        raise BadResults("expected results of rooms.adapt and of recordings.loss; run scripts/report.sh with --recording")
    machine = results.machine()
    threads = machine["num_threads"]
    seed = rooms["settings"]["seed"]
    frames = sorted({run["num_tested"] for run in rooms["runs"]})
    tested = f"{frames[0]} frames" if len(frames) == 1 else f"{frames[0]} to {frames[-1]} frames"
    return [f"Commit {commit}, {machine['processor'] or 'unknown processor'}, {threads} hardware thread{'s' if threads != 1 else ''}, seed {seed}.", "",
            "Tracking lost at every frame of a recording, one thread; found within 5 cm and 5 deg:", "", *table(PROTOCOL_COLUMNS, recordings, 2), "",
            f"Forests adapted to rendered rooms, {tested} tested in each, % within 5 cm and 5 deg:", "", *room_table(rooms)]


def split(text):
    """README before, between and behind the markers. Raises ValueError with what is wrong."""
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise ValueError(f"expected one line '{BEGIN}' and behind it one line '{END}'")
    before, rest = text.split(BEGIN)
    inside, behind = rest.split(END)
    return before, inside, behind


def tables_of(lines):
    """Runs of lines that are rows."""
    tables = [[]]
    for text in lines:
        if text.startswith("|"):
            tables[-1].append([cell.strip() for cell in text.strip("|").split("|")])
        elif tables[-1]:
            tables.append([])
    return [rows for rows in tables if rows]


def complaints(text):
    """What is stale in the form of a README's tables."""
    try:
        lines = split(text)[1].strip().split("\n")
    except ValueError as error:
        return [str(error)]
    found = []
    if not STAMP.match(lines[0]):
        found.append(f"the stamp '{lines[0]}' does not name commit, processor, threads and seed")
    tables = tables_of(lines)
    if len(tables) != 2:
        return found + [f"{len(tables)} tables, expected 2"]
    if tables[0][0] != PROTOCOL_COLUMNS:
        found.append(f"columns {tables[0][0]}, expected {PROTOCOL_COLUMNS}")
    header = tables[1][0]
    if header[:2] != ROOM_COLUMNS or header[-1] != ROOM_LAST_COLUMN or len(header) < 4:
        found.append(f"columns {header}, expected {ROOM_COLUMNS}, rooms and {ROOM_LAST_COLUMN}")
    for rows in tables:
        if len(rows) < 3 or any(len(row) != len(rows[0]) for row in rows):
            found.append(f"the table of '{rows[0][0]}' has no rows, or rows of different length")
    return found


def write(results_folder, readme, commit):
    before, _, behind = split(readme.read_text(encoding="utf-8"))
    inside = "\n".join(block(Results(results_folder), commit))
    temporary = readme.with_name(readme.name + ".part")
    temporary.write_text(f"{before}{BEGIN}\n\n{inside}\n\n{END}{behind}", encoding="utf-8")
    temporary.replace(readme)


def main():
    parser = argparse.ArgumentParser(prog="readme_tables.py", description="Writes or checks the README's tables of results.")
    commands = parser.add_subparsers(dest="command", required=True)
    writing = commands.add_parser("write", help="write the tables from a report's results")
    writing.add_argument("results")
    writing.add_argument("readme", type=pathlib.Path)
    writing.add_argument("--commit", required=True)
    checking = commands.add_parser("check", help="check the tables' form")
    checking.add_argument("readme", type=pathlib.Path)
    options = parser.parse_args()
    try:
        if options.command == "write":
            write(options.results, options.readme, options.commit)
            return 0
        found = complaints(options.readme.read_text(encoding="utf-8"))
    except (BadResults, OSError, ValueError) as error:
        print(f"readme_tables: {error}", file=sys.stderr)
        return 2
    print("\n".join(f"{options.readme}: {text}" for text in found) or "readme_tables: the form is up to date")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
