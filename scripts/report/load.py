# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Reads what report.sh left behind: a JSON document per experiment, named SUITE.EXPERIMENT[.PART].json."""

import csv
import json
import pathlib

SUITES = {"rooms": "Rendered rooms", "7scenes": "7-Scenes", "recordings": "Recordings"}
UNSTABLE = {"timing", "machine", "train_ms", "train_cpu_ms", "relocalise_ms", "relocalise_cpu_ms", "update_ms", "stages_ms", "peak_mb"}


class BadResults(Exception):
    """A results folder from which no report can be made; the message says why."""


def stable(value):
    """A document without what may differ between two equal runs."""
    if isinstance(value, dict):
        return {key: stable(part) for key, part in value.items() if key not in UNSTABLE}
    return [stable(part) for part in value] if isinstance(value, list) else value


class Results:
    """All experiments of a report."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.documents = {}
        if not self.folder.is_dir():
            raise BadResults(f"{folder}: no such folder; expected the results that report.sh writes")
        for path in sorted(self.folder.glob("*.json")):
            try:
                document = json.loads(path.read_text(encoding="utf-8"))
            except ValueError as error:
                raise BadResults(f"{path}: not JSON: {error}") from error
            if document.get("format") != "foothold-benchmark" or document.get("format_version") != 1:
                raise BadResults(f"{path}: expected a document of format foothold-benchmark, version 1")
            self.documents[path.stem] = document
        if not self.documents:
            raise BadResults(f"{folder}: holds no results; expected SUITE.EXPERIMENT.json")

    def get(self, suite, experiment):
        return self.documents.get(f"{suite}.{experiment}")

    def suites(self, experiment):
        """(suite, document) of every suite that ran the experiment."""
        return [(suite, self.get(suite, experiment)) for suite in SUITES if self.get(suite, experiment)]

    def parts(self, suite, experiment):
        """(part, document) of an experiment that ran once per scene."""
        prefix = f"{suite}.{experiment}."
        return [(name[len(prefix):], document) for name, document in self.documents.items() if name.startswith(prefix)]

    def frames(self, name):
        """The lines of an experiment's CSV file, by method."""
        path = self.folder / f"{name}.csv"
        methods = {}
        if path.exists():
            with open(path, newline="", encoding="utf-8") as file:
                for line in csv.DictReader(file):
                    methods.setdefault(line["method"], []).append(line)
        return methods

    def picture(self, name):
        path = self.folder / name
        return path.read_bytes() if path.exists() else None

    def seconds(self):
        """How long each step of the report took [s], including rendering."""
        steps = {}
        for path in sorted(self.folder.parent.glob("*/**/*.seconds")):
            steps[path.name.split(".stamp")[0]] = steps.get(path.name.split(".stamp")[0], 0) + int(path.read_text() or 0)
        return steps

    def machine(self):
        return next(iter(self.documents.values()))["machine"]

    def accuracy(self):
        return {name: stable(document) for name, document in self.documents.items()}


def found(line):
    """Whether a line of a CSV file is within 5 cm and 5 deg."""
    return line["answered"] == "1" and float(line["translation_error_m"]) <= 0.05 and float(line["rotation_error_deg"]) <= 5
