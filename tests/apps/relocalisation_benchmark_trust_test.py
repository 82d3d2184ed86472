# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""relocalisation_benchmark trust: many maps, many questions, counted by how they ended."""

import csv
import json
import unittest

import app_support

FEW = ["trust", "--rooms", 2, "--frames", 8, "--own", 6, "--strangers", 4, "--spoilt", 2, "--settle", 2]
DESK = "desk=synthetic:workshop?frames=8&width=160&height=120,synthetic:workshop?frames=8&width=160&height=120&trajectory=test"
ENDINGS = ["right_believed", "right_unbelieved", "wrong_believed", "wrong_unbelieved", "unanswered"]


def without_timing(value):
    if isinstance(value, dict):
        return {key: without_timing(part) for key, part in value.items() if key not in ("timing", "machine", "threads")}
    return [without_timing(part) for part in value] if isinstance(value, list) else value


class TrustTest(app_support.AppTest):
    def run_json(self, *arguments):
        self.check_success(*arguments, "--json", "results.json")
        return json.loads((self.folder / "results.json").read_text())

    def check_counts(self, counts):
        self.assertEqual(sum(counts[ending] for ending in ENDINGS), counts["num_questions"])
        for name, ending in [("right_believed_95", "right_believed"), ("wrong_believed_95", "wrong_believed")]:
            low, high = counts[name]
            self.assertLessEqual(low, counts[ending] / max(1, counts["num_questions"]) + 1e-9)
            self.assertGreaterEqual(high + 1e-9, counts[ending] / max(1, counts["num_questions"]))

    def test_questions_are_counted_once_by_kind_and_by_map(self):
        results = self.run_json(*FEW, "--csv", "trust.csv", "--plot", "trust.png", "--pictures", "wrong")
        self.assertEqual(results["protocol"], "trust")
        method = results["methods"]["forest"]
        self.assertEqual(list(method["maps"]), ["office", "stairs", "alike offices"])
        for counts in [method["all"], method["elsewhere"], *method["kinds"].values(), *method["maps"].values()]:
            self.check_counts(counts)
        for group in ("kinds", "maps"):
            for ending in ["num_questions", *ENDINGS]:
                self.assertEqual(sum(counts[ending] for counts in method[group].values()), method["all"][ending])
        kinds = method["kinds"]
        self.assertEqual(kinds["another scene"]["num_questions"], 8)
        self.assertEqual(kinds["mirrored"]["num_questions"], 12)
        self.assertEqual(kinds["moved 50 %"]["num_questions"], 4)
        self.assertEqual(kinds["alike rooms, learnt"]["num_questions"], 4 * 6)
        for kind in ("another scene", "mirrored"):
            self.assertEqual(kinds[kind]["right_believed"] + kinds[kind]["right_unbelieved"], 0)
        self.assertEqual(method["elsewhere"]["num_questions"], 8 + 12)
        self.assertEqual(len(method["wrong_beliefs"]), method["all"]["wrong_believed"])
        coverages = [point["coverage"] for point in method["risk_coverage"]]
        self.assertEqual(coverages, sorted(coverages))
        self.assertEqual(sum(b["num_answers"] for b in method["reliability"]), method["all"]["num_questions"] - method["all"]["unanswered"])
        self.assertEqual((self.folder / "trust.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        for wrong in method["wrong_beliefs"][:24]:
            self.assertTrue((self.folder / wrong["picture"]).exists())
        with open(self.folder / "trust.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(len(lines), len(kinds) + len(method["maps"]))

    def test_equal_options_give_equal_counts_on_any_number_of_threads(self):
        few = ["trust", "--rooms", 1, "--frames", 6, "--own", 4, "--strangers", 4, "--spoilt", 1, "--settle", 2]
        runs = [self.run_json(*few, "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_recordings_are_maps_and_strangers_too(self):
        kitchen = DESK.replace("workshop", "kitchen").replace("desk=", "kitchen=")
        results = self.run_json("trust", "--rooms", 0, "--scene", DESK, "--scene", kitchen, "--own", 4, "--strangers", 3, "--spoilt", 2, "--settle", 2)
        method = results["methods"]["forest"]
        self.assertEqual(list(method["maps"]), ["desk", "kitchen"])
        self.assertEqual(method["kinds"]["another scene"]["num_questions"], 2 * 3)
        self.assertEqual(method["kinds"]["rolled"]["num_questions"], 2 * 2)
        self.assertNotIn("moved 10 %", method["kinds"])  # nobody has moved the recordings' furniture

    def test_wrong_arguments(self):
        self.check_refused("trust", "--rooms", 0, says=["--rooms", "--scene"])
        self.check_refused("trust", "--own", 0, says="--own")
        self.check_refused("trust", "--scene", "missing", says="missing")
        self.check_refused("trust", "--pictures", "nowhere/wrong", says=["nowhere", "--pictures"])


if __name__ == "__main__":
    app_support.main()
