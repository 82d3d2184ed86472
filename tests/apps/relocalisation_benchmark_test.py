# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""relocalisation_benchmark from the outside."""

import csv
import json
import math
import os
import unittest
import unittest.mock

import app_support

ROOM = "synthetic:kitchen?frames=12&width=160&height=120"  # fast, but too coarse for the forest's settings to find much
FULL_SIZE_ROOM = "synthetic:kitchen?frames=12"
# What may differ between two equal runs: durations and memory of the process.
UNSTABLE_KEYS = {"train_ms", "train_cpu_ms", "relocalise_ms", "relocalise_cpu_ms", "update_ms", "stages_ms", "peak_mb"}


def stable_part(results):
    return {name: {k: v for k, v in method.items() if k not in UNSTABLE_KEYS} for name, method in results["methods"].items()}


class LossTest(app_support.AppTest):
    def run_loss(self, *arguments):
        self.check_success("loss", "--json", "results.json", *arguments)
        return json.loads((self.folder / "results.json").read_text())

    def test_json_holds_the_documented_keys(self):
        results = self.run_loss("--sequence", FULL_SIZE_ROOM, "--method", "forest,ferns")
        self.assertEqual(results["protocol"], "loss")
        self.assertEqual(results["sequence"], FULL_SIZE_ROOM)
        self.assertEqual(results["settings"]["gap"], 0)
        self.assertEqual(list(results["methods"]), ["forest", "ferns"])
        for method in results["methods"].values():
            self.assertEqual(method["num_tested"], 11)
            self.assertEqual(list(method["recall"]), ["1cm_1deg", "2cm_2deg", "5cm_5deg", "10cm_10deg"])
            rungs = list(method["recall"].values())
            self.assertEqual(rungs, sorted(rungs))
            for key in ["train_ms", "relocalise_ms"]:
                self.assertLessEqual(method[key]["median"], method[key]["p95"])
            self.assertGreater(method["state_mb"], 0)
            self.assertGreater(method["peak_mb"], method["state_mb"])
        self.assertEqual(results["methods"]["forest"]["first_success_frame"], 1)
        self.assertGreaterEqual(results["methods"]["forest"]["recall"]["5cm_5deg"], 0.9)
        self.assertIn("train/cluster", results["methods"]["forest"]["stages_ms"])
        self.assertEqual(results["methods"]["ferns"]["settings"]["num_ferns"], 500)

    def test_equal_options_give_equal_results_on_any_number_of_threads(self):
        runs = [self.run_loss("--sequence", ROOM, "--method", "forest,ferns", "--seed", 7, "--threads", n) for n in (1, 2)]
        runs.append(self.run_loss("--sequence", ROOM, "--method", "forest,ferns", "--seed", 7, "--threads", 2, "--exclusive-timing"))
        self.assertEqual(stable_part(runs[0]), stable_part(runs[1]))
        self.assertEqual(stable_part(runs[1]), stable_part(runs[2]))

    def test_estimates_and_csv_agree_with_the_json(self):
        results = self.run_loss("--sequence", ROOM, "--estimates", "poses.txt", "--csv", "frames.csv")
        lines = (self.folder / "poses.txt").read_text().splitlines()
        self.assertEqual([int(line.split(" ")[0]) for line in lines], list(range(1, 12)))
        for line in lines:
            words = line.split(" ")
            if words[1:] == ["lost"]:
                continue
            self.assertEqual(len(words), 18)
            matrix = [[float(words[1 + 4 * row + column]) for column in range(4)] for row in range(4)]
            self.assertEqual(matrix[3], [0, 0, 0, 1])
            self.assertAlmostEqual(math.hypot(*matrix[0][:3]), 1, places=4)
            self.assertTrue(0 <= float(words[17]) <= 1)
        with open(self.folder / "frames.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        found = [r for r in rows if r["answered"] == "1" and float(r["translation_error_m"]) <= 0.05 and float(r["rotation_error_deg"]) <= 5]
        self.assertAlmostEqual(len(found) / len(rows), results["methods"]["forest"]["recall"]["5cm_5deg"])

    def test_several_methods_write_their_poses_apart(self):
        self.run_loss("--sequence", ROOM, "--method", "forest,ferns", "--estimates", "poses.txt")
        self.assertEqual(sorted(p.name for p in self.folder.glob("poses*")), ["poses.ferns.txt", "poses.forest.txt"])

    def test_gap_stride_and_frames_choose_what_is_tested(self):
        self.run_loss("--sequence", ROOM, "--method", "ferns", "--frames", "2:12", "--stride", 2, "--gap", 1, "--estimates", "poses.txt")
        tested = [int(line.split(" ")[0]) for line in (self.folder / "poses.txt").read_text().splitlines()]
        self.assertEqual(tested, [6, 8, 10])

    def test_settings_come_from_preset_file_and_set_in_this_order(self):
        (self.folder / "settings.json").write_text('{"forest": {"pose": {"num_hypotheses": 64, "pool_size": 1000}}, "ferns": {"num_ferns": 64}}')
        arguments = ["--sequence", ROOM, "--frames", ":3", "--settings", "settings.json", "--set", "forest.pose.pool_size=2000"]
        results = self.run_loss("--method", "forest,ferns", "--preset", "paper", *arguments)
        pose = results["methods"]["forest"]["settings"]["pose"]
        self.assertEqual((pose["num_hypotheses"], pose["pool_size"]), (64, 2000))
        self.assertEqual(results["methods"]["forest"]["settings"]["reservoirs"]["capacity"], 1024)
        self.assertEqual(results["methods"]["ferns"]["settings"]["num_ferns"], 64)

    def test_table_is_markdown_with_a_row_per_method(self):
        lines = self.check_success("loss", "--sequence", ROOM, "--method", "ferns", "--frames", ":3").stdout.splitlines()
        rows = [line for line in lines if line.startswith("| ferns")]
        self.assertEqual(len(rows), 1)
        self.assertEqual(len({line.count("|") for line in lines[2:5]}), 1)

    def test_plot_is_a_png(self):
        self.run_loss("--sequence", ROOM, "--method", "ferns", "--plot", "recall.png")
        self.assertEqual((self.folder / "recall.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


class SplitTest(app_support.AppTest):
    def test_bins_hold_every_test_once(self):
        self.check_success("split", "--train", ROOM + "@0:6", "--train", ROOM + "@9:10", "--test", ROOM + "@6:9", "--test", ROOM + "@10:12",
                           "--method", "ferns,forest", "--settle", 3, "--json", "results.json", "--estimates", "poses.txt")
        results = json.loads((self.folder / "results.json").read_text())
        self.assertEqual(results["protocol"], "split")
        self.assertEqual(len(results["training"]), 2)
        self.assertEqual(results["sequence"], [ROOM + "@6:9", ROOM + "@10:12"])
        for method in results["methods"].values():
            self.assertEqual((method["num_trained"], method["num_tested"]), (7, 5))
            self.assertEqual([b["bin"] for b in method["novelty"]][::10], ["5cm_5deg", "rest"])
            self.assertEqual(sum(b["num_frames"] for b in method["novelty"]), 5)
        lines = (self.folder / "poses.forest.txt").read_text().splitlines()
        self.assertEqual([line.split(" ")[0] for line in lines], ["#", "6", "7", "8", "#", "10", "11"])


class BadInputTest(app_support.AppTest):
    outputs = ["--json", "results.json", "--csv", "frames.csv", "--plot", "plot.png", "--estimates", "poses.txt"]

    def test_wrong_arguments(self):
        self.check_refused(says="subcommand")
        self.check_refused("loss", says="--sequence")
        self.check_refused("split", "--train", ROOM, says="--test")
        loss = ["loss", "--sequence", ROOM]
        self.check_refused(*loss, "--method", "forrest", says=["forrest", "forest", "ferns"])
        self.check_refused(*loss, "--method", "ferns,ferns", says="twice")
        self.check_refused(*loss, "--preset", "fast", says=["fast", "tuned", "paper"])
        self.check_refused(*loss, "--device", "tpu", says=["tpu", "cuda"])
        self.check_refused(*loss, "--device", "cuda:x", says=["cuda:x", "cuda:N"])
        with unittest.mock.patch.dict(os.environ, {"CUDA_VISIBLE_DEVICES": ""}):  # hides GPUs where there are any
            self.check_refused(*loss, "--device", "cuda", says="CUDA")
        self.check_refused(*loss, "--threads", -1, says="-1")
        self.check_refused(*loss, "--stride", 0, says="--stride")
        self.check_refused(*loss, "--gap", -1, says="--gap")
        self.check_refused(*loss, "--gap", 11, says=["12 frames", "at least 13"])
        self.check_refused(*loss, "--seed", "x", says="--seed")
        for frames in ["5", "7:3", "a:b", "3:3", "-1:5", "0:13"]:
            self.check_refused(*loss, f"--frames={frames}", says=["expected"])

    def test_wrong_settings(self):
        loss = ["loss", "--sequence", ROOM, *self.outputs]
        self.check_refused(*loss, "--set", "forest.pose.num_hypothesis=64", says=["num_hypothesis", "did you mean 'forest.pose.num_hypotheses'"])
        self.check_refused(*loss, "--set", "forest.pose.num_hypotheses=1", says=["num_hypotheses", "[16, 65536]"])
        self.check_refused(*loss, "--set", "forest.pose.num_hypotheses", says="path=value")
        self.check_refused(*loss, "--settings", "missing.json", says="missing.json")
        (self.folder / "broken.json").write_text('{"forest": ')
        self.check_refused(*loss, "--settings", "broken.json", says="broken.json")
        (self.folder / "unknown.json").write_text('{"forest": {"trees": 5}}')
        self.check_refused(*loss, "--settings", "unknown.json", says=["unknown.json", "forest.trees"])

    def test_wrong_outputs_are_refused_before_the_run(self):
        for option in ["--json", "--csv", "--plot", "--estimates"]:
            self.check_refused("loss", "--sequence", ROOM, option, "nowhere/file.png", says="nowhere")
        self.check_refused("loss", "--sequence", ROOM, "--plot", "plot.jpg", says=["plot.jpg", ".png"])

    def test_wrong_sequences(self):
        self.check_refused("loss", "--sequence", "missing", says="missing")
        self.check_refused("loss", "--sequence", "", says="sequence")
        self.check_refused("loss", "--sequence", "synthetic:castle", says=["castle", "kitchen"])
        self.check_refused("loss", "--sequence", "synthetic:kitchen?frame=3", says=["frame", "frames"])
        (self.folder / "empty").mkdir()
        self.check_refused("loss", "--sequence", "empty", says="empty")

    def test_wrong_forests(self):
        loss = ["loss", "--sequence", ROOM, *self.outputs, "--forest"]
        self.check_refused(*loss, "missing.forest", says="missing.forest")
        (self.folder / "bad.forest").write_bytes(b"not a forest at all, but long enough to hold a header of some kind" * 4)
        self.check_refused(*loss, "bad.forest", says="bad.forest")
        # A bad forest is found before another method runs.
        refused = self.check_refused(*loss, "bad.forest", "--method", "ferns,forest", says="bad.forest")
        self.assertNotIn("ferns:", refused.stderr)

    def check_damaged(self, damage, says):
        """Damages a good recording, then restores the folder."""
        recording = self.folder / "recording"
        app_support.write_seven_scenes(recording, 4)
        damage(recording)
        self.check_refused("loss", "--sequence", "recording", "--method", "ferns", *self.outputs, says=says)
        for file in recording.iterdir():
            file.unlink()
        recording.rmdir()

    def test_damaged_recordings(self):
        def truncate(name):
            return lambda folder: (folder / name).write_bytes((folder / name).read_bytes()[:60])

        def write_pose(text):
            return lambda folder: (folder / "frame-000002.pose.txt").write_text(text)

        def write_intrinsics(text):
            return lambda folder: (folder / "camera-intrinsics.txt").write_text(text)

        def smaller_colour(folder):
            app_support.write_png(folder / "frame-000002.color.png", 40, 30, [b"\x10\x20\x30" * 40] * 30, 8, 3)

        for kind in ["color.png", "depth.png"]:  # an image in the middle makes a frame without depth; the first must be there
            name = f"frame-000000.{kind}"
            self.check_damaged(lambda folder, n=name: (folder / n).unlink(), says="frame-000000")
            self.check_damaged(truncate(name), says=name)
        self.check_damaged(write_pose("1 0 0\n"), says="frame-000002.pose.txt")
        self.check_damaged(write_pose("2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"), says="frame-000002.pose.txt")
        self.check_damaged(write_intrinsics("0 0 40\n0 73 30\n0 0 1\n"), says="camera-intrinsics.txt")
        self.check_damaged(write_intrinsics("-73 0 40\n0 73 30\n0 0 1\n"), says="camera-intrinsics.txt")
        self.check_damaged(smaller_colour, says="frame-000002")


if __name__ == "__main__":
    app_support.main()
