# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""The subcommands of relocalisation_benchmark that learn many places in one world."""

import csv
import json
import unittest

import app_support

ROOMS = ["scale", "--frames", 6, "--test-frames", 3, "--size", "160x120", "--settle", 2]
SCENES = ["--scene", "kitchen=synthetic:kitchen?frames=6&width=160&height=120", "--scene", "office=synthetic:office?frames=6&width=160&height=120"]


def without_timing(value):
    """A document without what may differ between two equal runs."""
    if isinstance(value, dict):
        return {key: without_timing(part) for key, part in value.items() if key not in ("timing", "machine", "threads")}
    return [without_timing(part) for part in value] if isinstance(value, list) else value


class PlacesTest(app_support.AppTest):
    def run_json(self, *arguments):
        self.check_success(*arguments, "--json", "results.json")
        return json.loads((self.folder / "results.json").read_text())


class ScaleTest(PlacesTest):
    def test_a_point_for_each_number_of_places(self):
        results = self.run_json(*ROOMS, "--rooms", "1,2", "--method", "forest,ferns", "--tested", 1, "--csv", "points.csv")
        self.assertEqual(results["protocol"], "scale")
        self.assertEqual([(p["name"], p["num_training"], p["num_tests"]) for p in results["places"]], [("training-100", 6, 3), ("training-101", 6, 0)])
        self.assertEqual([p["origin_m"] for p in results["places"]], [[0, 0, 0], [9, 0, 0]])
        for method in results["methods"].values():
            self.assertEqual([(p["places"], p["num_trained"], p["num_tested"]) for p in method["points"]], [(1, 6, 3), (2, 12, 3)])
            for point in method["points"]:
                self.assertEqual(sum(point["beliefs"].values()), point["num_tested"])
                self.assertEqual(point["beliefs"]["wrong_here"] + point["beliefs"]["wrong_place"], point["confidence"]["false_accepts"])
        with open(self.folder / "points.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual([(line["method"], line["places"]) for line in lines], [("forest", "1"), ("forest", "2"), ("ferns", "1"), ("ferns", "2")])

    def test_a_point_does_not_depend_on_the_others(self):
        both = self.run_json(*ROOMS, "--rooms", "1,2")["methods"]["forest"]["points"]
        alone = self.run_json(*ROOMS, "--rooms", 2)["methods"]["forest"]["points"]
        self.assertEqual(without_timing(both[1:]), without_timing(alone))

    def test_equal_options_give_equal_accuracy_on_any_number_of_threads(self):
        runs = [self.run_json(*ROOMS, "--rooms", "1,2", "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_recordings_are_moved_to_places_of_their_own(self):
        results = self.run_json("scale", *SCENES, "--rooms", "2", "--spacing", 20, "--settle", 2)
        self.assertEqual([(p["name"], p["origin_m"]) for p in results["places"]], [("kitchen", [0, 0, 0]), ("office", [20, 0, 0])])
        self.assertEqual(results["methods"]["forest"]["points"][0]["num_tested"], 12)
        self.assertNotIn("first_room", results["settings"])

    def test_wrong_arguments(self):
        self.check_refused("scale", "--size", "320", says=["--size", "320", "WIDTHxHEIGHT"])
        self.check_refused("scale", "--rooms", "0", says="--rooms")
        self.check_refused("scale", *SCENES, "--rooms", "3", says=["--rooms", "3", "2"])
        self.check_refused("scale", "--method", "none", says=["none", "forest"])

    def test_identical_rooms_differ_in_furniture_alone(self):
        results = self.run_json(*ROOMS, "--rooms", 2, "--identical", "office", "--differing", 0.3)
        self.assertEqual([p["name"] for p in results["places"]], ["office-0", "office-1"])
        self.assertEqual((results["settings"]["identical"], results["settings"]["differing"]), ("office", 0.3))
        self.check_refused(*ROOMS, "--identical", "castle", says=["castle", "office"])

    def test_laps_learn_the_same_places_again_with_fresh_noise(self):
        points = self.run_json(*ROOMS, "--rooms", "2", "--laps", "1,3", "--csv", "points.csv")["methods"]["forest"]["points"]
        self.assertEqual([(p["laps"], p["num_trained"], p["num_tested"]) for p in points], [(1, 12, 6), (3, 36, 6)])
        once = self.run_json(*ROOMS, "--rooms", "2")["methods"]["forest"]["points"][0]
        self.assertEqual(without_timing([once])[0]["recall"], without_timing(points[:1])[0]["recall"])
        self.assertGreater(points[1]["state_mb"], points[0]["state_mb"])  # another noise falls into other leaves
        self.assertLess(points[1]["state_mb"], 3 * points[0]["state_mb"])
        self.check_refused(*ROOMS, "--rooms", "1,2", "--laps", "2", says=["--laps", "--rooms"])

    def test_every_place_is_also_learnt_alone(self):
        method = self.run_json(*ROOMS, "--rooms", "2", "--plot", "plot.png")["methods"]["forest"]
        self.assertEqual((method["alone"]["num_trained"], method["alone"]["num_tested"]), (12, 6))
        self.assertEqual(method["alone"]["beliefs"]["wrong_place"], 0)
        self.assertEqual((self.folder / "plot.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


class DwellTest(PlacesTest):
    arguments = ["dwell", "--sequence", "synthetic:kitchen?frames=24&width=160&height=120", "--stay", "0:3", "--learn", "12:18"]

    def test_a_point_for_each_number_of_standing_frames(self):
        results = self.run_json(*self.arguments, "--test", "18:24", "--standing", "0,9", "--method", "forest,ferns", "--csv", "points.csv", "--plot", "plot.png")
        self.assertEqual(results["protocol"], "dwell")
        for method in results["methods"].values():
            self.assertEqual([(p["standing_frames"], p["num_trained"], p["num_tested"]) for p in method["points"]], [(0, 6, 6), (9, 15, 6)])
            self.assertIsNone(method["points"][0]["timing"]["first_train_ms"]["median"])
            self.assertIsNotNone(method["points"][1]["timing"]["first_train_ms"]["median"])
        self.assertEqual(len((self.folder / "points.csv").read_text().splitlines()), 1 + 4)
        self.assertEqual((self.folder / "plot.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_equal_options_give_equal_accuracy_on_any_number_of_threads(self):
        runs = [self.run_json(*self.arguments, "--test", "18:24", "--standing", 5, "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_wrong_arguments(self):
        self.check_refused("dwell", says="--sequence")
        self.check_refused(*self.arguments, "--test", "18:30", says=["18:30", "24 frames"])
        self.check_refused(*self.arguments, "--test", "18:24", "--standing", "-1", says="--standing")


if __name__ == "__main__":
    app_support.main()
