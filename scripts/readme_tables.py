#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Writes the tables of results in README.md and docs/results.md between their markers, from the JSON files of scripts/report.sh.

    readme_tables.py write RESULTS DOCUMENT... --commit COMMIT
    readme_tables.py check DOCUMENT...

There are two tables, `recordings` and `rooms`. Each stands once, in one of the documents. `check` finds tables that are missing or stale in form: markers, stamp,
columns. Numbers are not checked; they belong to the commit and machine of the stamp.
"""

import argparse
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "report"))
from load import BadResults, Results  # noqa: E402  (the path comes first)

BEGIN = "<!-- results {}: written by scripts/readme_tables.py, do not edit -->"
END = "<!-- results {}: end -->"
NAMES = ("recordings", "rooms")
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


def blocks(results, commit):
    """The lines between the markers of each table."""
    rooms, recordings = results.get("rooms", "adapt"), protocol_rows(results)
    if rooms is None or not recordings:
        raise BadResults("expected results of rooms.adapt and of recordings.loss; run scripts/report.sh with --recording")
    machine = results.machine()
    threads = machine["num_threads"]
    seed = rooms["settings"]["seed"]
    frames = sorted({run["num_tested"] for run in rooms["runs"]})
    tested = f"{frames[0]} frames" if len(frames) == 1 else f"{frames[0]} to {frames[-1]} frames"
    stamp = f"Commit {commit}, {machine['processor'] or 'unknown processor'}, {threads} hardware thread{'s' if threads != 1 else ''}, seed {seed}."
    return {"recordings": [stamp, "", "Tracking lost at every frame of a recording, one thread; found within 5 cm and 5 deg:", "",
                           *table(PROTOCOL_COLUMNS, recordings, 2)],
            "rooms": [stamp, "", f"Forests adapted to rendered rooms, {tested} tested in each, % within 5 cm and 5 deg:", "", *room_table(rooms)]}


def split(text, name):
    """A document before, between and behind the markers of a table. Raises ValueError with what is wrong."""
    begin, end = BEGIN.format(name), END.format(name)
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        raise ValueError(f"expected one line '{begin}' and behind it one line '{end}'")
    before, rest = text.split(begin)
    inside, behind = rest.split(end)
    return before, inside, behind


def homes(texts):
    """The document of each table: the one with a marker of it. Raises ValueError unless it is one."""
    found = {}
    for name in NAMES:
        holders = [path for path, text in texts.items() if BEGIN.format(name) in text or END.format(name) in text]
        if len(holders) != 1:
            raise ValueError(f"expected one line '{BEGIN.format(name)}' in one of {', '.join(map(str, texts))}; {len(holders)} have it")
        found[name] = holders[0]
    return found


def tables_of(lines):
    """Runs of lines that are rows."""
    tables = [[]]
    for text in lines:
        if text.startswith("|"):
            tables[-1].append([cell.strip() for cell in text.strip("|").split("|")])
        elif tables[-1]:
            tables.append([])
    return [rows for rows in tables if rows]


def right_columns(name, header):
    if name == "recordings":
        return header == PROTOCOL_COLUMNS
    return header[:2] == ROOM_COLUMNS and header[-1] == ROOM_LAST_COLUMN and len(header) >= 4


def complaints(text, name):
    """What is stale in the form of a table."""
    try:
        lines = split(text, name)[1].strip().split("\n")
    except ValueError as error:
        return [str(error)]
    found = []
    if not STAMP.match(lines[0]):
        found.append(f"the stamp '{lines[0]}' does not name commit, processor, threads and seed")
    tables = tables_of(lines)
    if len(tables) != 1:
        return found + [f"{len(tables)} tables between the markers of '{name}', expected 1"]
    rows = tables[0]
    if not right_columns(name, rows[0]):
        expected = PROTOCOL_COLUMNS if name == "recordings" else f"{ROOM_COLUMNS}, rooms and {ROOM_LAST_COLUMN}"
        found.append(f"columns {rows[0]}, expected {expected}")
    if len(rows) < 3 or any(len(row) != len(rows[0]) for row in rows):
        found.append(f"the table of '{rows[0][0]}' has no rows, or rows of different length")
    return found


def write(results_folder, texts, commit):
    """Writes nothing unless both tables can be written."""
    inside = blocks(Results(results_folder), commit)
    for name, path in homes(texts).items():
        before, _, behind = split(texts[path], name)
        texts[path] = before + BEGIN.format(name) + "\n\n" + "\n".join(inside[name]) + "\n\n" + END.format(name) + behind
    for path, text in texts.items():
        temporary = path.with_name(path.name + ".part")
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)


def check(texts):
    """What is stale, one line each."""
    try:
        return [f"{path}: {text}" for name, path in homes(texts).items() for text in complaints(texts[path], name)]
    except ValueError as error:
        return [str(error)]


def main():
    parser = argparse.ArgumentParser(prog="readme_tables.py", description="Writes or checks the tables of results in README.md and docs/results.md.")
    commands = parser.add_subparsers(dest="command", required=True)
    writing = commands.add_parser("write", help="write the tables from a report's results")
    writing.add_argument("results")
    writing.add_argument("documents", type=pathlib.Path, nargs="+")
    writing.add_argument("--commit", required=True)
    checking = commands.add_parser("check", help="check the tables' form")
    checking.add_argument("documents", type=pathlib.Path, nargs="+")
    options = parser.parse_args()
    try:
        texts = {path: path.read_text(encoding="utf-8") for path in options.documents}
        if options.command == "write":
            write(options.results, texts, options.commit)
            return 0
        found = check(texts)
    except (BadResults, OSError, ValueError) as error:
        print(f"readme_tables: {error}", file=sys.stderr)
        return 2
    print("\n".join(found) or "readme_tables: the form is up to date")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
