# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""The subcommands of relocalisation_benchmark that run on scenes, and how they explain a wrongly formatted one."""

import csv
import json
import unittest

import app_support

KITCHEN = "synthetic:kitchen?frames=8&width=160&height=120"
OFFICE = "synthetic:office?frames=8&width=160&height=120"
TIMING_KEY = "timing"


def without_timing(value):
    """A document without what may differ between two equal runs."""
    if isinstance(value, dict):
        return {key: without_timing(part) for key, part in value.items() if key not in (TIMING_KEY, "machine", "threads")}
    return [without_timing(part) for part in value] if isinstance(value, list) else value


class SceneTest(app_support.AppTest):
    def run_json(self, *arguments):
        self.check_success(*arguments, "--json", "results.json")
        return json.loads((self.folder / "results.json").read_text())

    def make_scene(self, name="desk", training=(1,), tests=(2,), num_frames=4):
        """The folder of a 7-Scenes scene."""
        scene = self.folder / name
        scene.mkdir()
        for number in {*training, *tests}:
            app_support.write_seven_scenes(scene / f"seq-{number:02d}", num_frames)
        (scene / "TrainSplit.txt").write_text("".join(f"sequence{n}\n" for n in training))
        (scene / "TestSplit.txt").write_text("".join(f"sequence{n}\n" for n in tests))
        return scene


class AdaptTest(SceneTest):
    arguments = ["adapt", "--scene", KITCHEN, "--scene", "desk=" + OFFICE, "--method", "forest,ferns", "--settle", 2]

    def test_a_run_for_each_forest_and_scene_and_averages_of_them(self):
        results = self.run_json(*self.arguments, "--forest", "default", "--forest", "coarse=random", "--csv", "frames.csv")
        self.assertEqual(results["protocol"], "adapt")
        self.assertEqual([scene["name"] for scene in results["scenes"]], ["kitchen", "desk"])
        self.assertEqual([(f["name"], f["file"]) for f in results["forests"]], [("default", "default"), ("coarse", "random")])
        rows = [(run["forest"], run["method"], run["scene"]) for run in results["runs"]]
        expected = [(f, m, s) for f, m in [("default", "forest"), ("coarse", "forest"), (None, "ferns")] for s in ["kitchen", "desk"]]
        self.assertEqual(rows, expected)
        for run in results["runs"]:
            self.assertEqual((run["num_trained"], run["num_tested"]), (8, 8))
            self.assertEqual(sum(b["num_frames"] for b in run["novelty"]), 8)
            self.assertLessEqual(run["timing"]["relocalise_ms"]["median"], run["timing"]["relocalise_ms"]["p95"])
        for average in results["averages"]:
            runs = [r for r in results["runs"] if (r["forest"], r["method"]) == (average["forest"], average["method"])]
            self.assertAlmostEqual(average["recall"]["5cm_5deg"], sum(r["recall"]["5cm_5deg"] for r in runs) / 2)
        with open(self.folder / "frames.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(len(lines), 6 * 8)
        self.assertEqual((lines[0]["scene"], lines[0]["forest"], lines[0]["method"]), ("kitchen", "default", "forest"))

    def test_equal_options_give_equal_accuracy_on_any_number_of_threads(self):
        runs = [self.run_json(*self.arguments, "--seed", 7, "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_recordings_may_make_a_scene(self):
        results = self.run_json("adapt", "--scene", f"half={KITCHEN}@0:4,{KITCHEN}@4:8,{KITCHEN}@2:4", "--method", "ferns")
        tests = [KITCHEN + "@4:8", KITCHEN + "@2:4"]
        self.assertEqual(results["scenes"], [{"name": "half", "training": [KITCHEN + "@0:4"], "tests": tests}])
        self.check_refused("adapt", "--scene", f"half={KITCHEN},", says=["sequence"])

    def test_seven_scenes_use_their_official_split(self):
        self.make_scene(training=(1, 3), tests=(2,))
        results = self.run_json("adapt", "--scene", "desk", "--method", "ferns")
        self.assertEqual(results["scenes"], [{"name": "desk", "training": ["desk/seq-01", "desk/seq-03"], "tests": ["desk/seq-02"]}])
        self.assertEqual((results["runs"][0]["num_trained"], results["runs"][0]["num_tested"]), (8, 4))

    def test_an_incomplete_official_scene_gets_a_warning(self):
        scene = self.make_scene("chess")
        warning = "4 test frames, but the official split of chess has 2000"
        self.assertNotIn(warning, self.check_success("adapt", "--scene", "chess", "--method", "ferns").stderr)
        for number in (1, 2):  # one level up, they are no sequence's own
            (scene / f"seq-0{number}" / "camera-intrinsics.txt").replace(scene / "camera-intrinsics.txt")
        self.assertIn(warning, self.check_success("adapt", "--scene", "chess", "--method", "ferns").stderr)


class NovelTest(SceneTest):
    def test_bins_add_up_over_scenes_and_areas_have_ratios(self):
        results = self.run_json("novel", "--scene", KITCHEN, "--scene", OFFICE, "--method", "forest,ferns", "--settle", 2)
        self.assertEqual(results["protocol"], "novel")
        for name, method in results["methods"].items():
            self.assertEqual([b["bin"] for b in method["novelty"]][::10], ["5cm_5deg", "rest"])
            for index, total in enumerate(method["novelty"]):
                parts = [run["novelty"][index] for run in results["runs"] if run["method"] == name]
                self.assertEqual(total["num_frames"], sum(p["num_frames"] for p in parts))
                self.assertEqual(total["num_found"], sum(p["num_found"] for p in parts))
                self.assertLessEqual(total["recall_95"][0], total["recall_95"][1])
            used = [b["recall"] for b in method["novelty"][:-1] if b["num_frames"] > 0]
            self.assertAlmostEqual(method["area"], sum(used) / len(used))
        self.assertEqual(list(results["area_ratios"]), ["forest / ferns", "ferns / forest"])


class ConfidenceTest(SceneTest):
    def test_curve_and_calibration(self):
        results = self.run_json("confidence", "--scene", KITCHEN, "--scene", OFFICE, "--method", "forest,ferns", "--settle", 2, "--csv", "curve.csv")
        for method in results["methods"].values():
            self.assertEqual((method["num_samples"], method["num_findable"]), (32, 16))
            for key in ["recall", "false_accept_rate", "num_accepted"]:
                values = [point[key] for point in method["curve"]]
                self.assertEqual(values, sorted(values))
            self.assertIsNone(method["curve"][0]["threshold"])
            self.assertEqual(method["curve"][-1]["num_accepted"], method["num_answered"])
            self.assertEqual(sum(b["num_answers"] for b in method["calibration"]), method["num_answered"])
            self.assertEqual(method["without_false_accepts"]["false_accepts"], 0)
        self.assertTrue((self.folder / "curve.csv").read_text().startswith("method,threshold,"))


class TimeTest(SceneTest):
    arguments = ["time", "--sequence", KITCHEN, "--train-frames", 4, "--test-frames", 2]

    def test_stages_and_sweeps(self):
        results = self.run_json(*self.arguments, "--method", "forest,ferns", "--sweep", "forest,ferns", "--csv", "sweeps.csv")
        self.assertEqual(results["protocol"], "time")
        for method in results["methods"].values():
            self.assertEqual((method["num_trained"], method["num_tested"]), (4, 2))
            self.assertLessEqual(method["timing"]["train_ms"]["median"], method["timing"]["train_ms"]["p95"])
        self.assertIn("train/cluster", results["methods"]["forest"]["timing"]["stages_ms"])
        swept = {(s["method"], s["quantity"]): [p["value"] for p in s["points"]] for s in results["sweeps"]}
        self.assertEqual(swept[("forest", "trained_frames")], [1, 2, 4])
        self.assertEqual(swept[("ferns", "image_width_px")], [40, 80, 160])
        self.assertEqual(swept[("forest", "hypotheses")], [64, 128, 256, 512, 1024, 2048])
        self.assertEqual(swept[("forest", "leaves")][0], 5 * 2**7)
        self.assertNotIn(("ferns", "leaves"), swept)
        points = sum(len(values) for values in swept.values())
        self.assertEqual(len((self.folder / "sweeps.csv").read_text().splitlines()), 1 + points)

    def test_accuracy_is_equal_where_time_is_not(self):
        runs = [self.run_json(*self.arguments, "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_wrong_arguments(self):
        self.check_refused("time", "--sequence", KITCHEN, "--train-frames", 7, "--test-frames", 2, says=["8 frames", "at least 9"])
        self.check_refused("time", "--sequence", KITCHEN, "--sweep", "trees", says=["trees", "forest"])
        self.check_refused("time", says="--sequence")
        self.assertEqual(self.run_json(*self.arguments, "--sweep", "none")["sweeps"], [])


class FailuresTest(SceneTest):
    # One desk learnt, and another that looks the same tested: what is answered is wrong, so there is something to look into.
    office = "synthetic:office?frames=300&width=320&height=240"
    scene = "--scene", f"wrong={office}@0:60,{office}@120:124"

    def test_wrong_answers_are_told_and_drawn(self):
        results = self.run_json("failures", *self.scene, "--settle", 2, "--pictures", "failure", "--csv", "wrong.csv")
        self.assertEqual(results["num_tested"], 4)
        self.assertEqual(results["num_wrong"] + results["num_unanswered"], 4)
        self.assertGreaterEqual(len(results["cases"]), 1)
        case = results["cases"][0]
        self.assertIsNone(case["first_right_candidate"])
        self.assertLessEqual(len(case["candidates"]), 16)
        self.assertEqual(case["candidates"][0]["confidence"], case["confidence"])
        for key in ["candidates_picture", "modes_picture"]:
            self.assertEqual((self.folder / case[key]).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(len((self.folder / "wrong.csv").read_text().splitlines()), 1 + results["num_wrong"])

    def test_equal_options_give_equal_answers(self):
        runs = [self.run_json("failures", *self.scene, "--settle", 2, "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_nothing_to_look_into_is_no_error(self):
        results = self.run_json("failures", "--scene", "same=synthetic:kitchen?frames=6,synthetic:kitchen?frames=6&seed=7", "--pictures", "failure")
        self.assertEqual(results["cases"], [])

    def test_wrong_arguments(self):
        self.check_refused("failures", *self.scene, "--method", "ferns", says="expected forest or paper")
        self.check_refused("failures", *self.scene, "--scene", KITCHEN, says="expected one")
        self.check_refused("failures", *self.scene, "--pictures", "nowhere/failure", says=["nowhere", "--pictures"])


class KidnapTest(SceneTest):
    arguments = ["kidnap", "--sequence", "synthetic:kitchen?frames=60&width=320&height=240", "--removed", 1, "--removed-length", 8, "--teleports", 1, "--judged", 8]

    def test_every_kidnap_is_judged_once(self):
        results = self.run_json(*self.arguments, "--method", "forest,ferns", "--csv", "kidnaps.csv")
        self.assertEqual(list(results["methods"]), ["forest", "ferns"])
        for method in results["methods"].values():
            self.assertEqual((method["num_kidnaps"], len(method["kidnaps"]), method["num_frames"]), (2, 2, 60))
            self.assertEqual(sorted(k["kind"] for k in method["kidnaps"]), ["removed", "teleport"])
            self.assertEqual(method["num_recovered"], sum(k["recovered"] for k in method["kidnaps"]))
            self.assertEqual(method["num_recovered"], sum(kind["num_recovered"] for kind in method["kinds"].values()))
            self.assertTrue(next(k for k in method["kidnaps"] if k["kind"] == "teleport")["seen_before"])
            for kidnap in method["kidnaps"]:
                self.assertEqual(kidnap["frames_to_recovery"] is not None, kidnap["recovered"])
        self.assertEqual(len((self.folder / "kidnaps.csv").read_text().splitlines()), 1 + 4)

    def test_equal_options_give_equal_outcomes(self):
        runs = [self.run_json(*self.arguments, "--method", "forest", "--threads", threads) for threads in (1, 2)]
        self.assertEqual(without_timing(runs[0]), without_timing(runs[1]))

    def test_wrong_arguments(self):
        self.check_refused("kidnap", "--sequence", KITCHEN, says="expected")
        self.check_refused("kidnap", "--sequence", KITCHEN, "--teleports", -1, says="num_teleports")
        self.check_refused(*self.arguments, "--method", "none", says=["none", "forest"])
        self.check_refused("kidnap", says="--sequence")


class WrongSceneTest(SceneTest):
    """Nothing runs, nothing is written, and the message says what is missing."""

    def check_scene(self, *scenes, says, command="adapt"):
        arguments = [argument for scene in scenes for argument in ("--scene", scene)]
        refused = self.check_refused(command, *arguments, "--method", "ferns", "--json", "results.json", says=says)
        self.assertNotIn("ferns on", refused.stderr, "a scene ran before the bad one was found")

    def test_wrong_arguments(self):
        self.check_refused("adapt", says="--scene")
        self.check_scene("desk=", says="[NAME=]FOLDER")
        self.check_scene("missing", says=["missing", "no such folder", "7-Scenes scene"])
        self.check_scene("synthetic:castle", says=["castle", "kitchen"])
        self.check_scene(KITCHEN, KITCHEN, says=["two scenes are called 'kitchen'", "NAME="])
        self.check_refused("adapt", "--scene", KITCHEN, "--forest", "a=", says="NAME=FILE")
        self.check_refused("adapt", "--scene", KITCHEN, "--forest", "missing.forest", says="missing.forest")
        self.check_refused("adapt", "--scene", KITCHEN, "--forest", "default", "--forest", "default", says="two forests")
        for command in ["novel", "confidence"]:
            self.check_scene("missing", says="missing", command=command)
            self.check_refused(command, "--scene", KITCHEN, "--json", "nowhere/file.json", says="nowhere")

    def test_missing_split_file(self):
        for name in ["TrainSplit.txt", "TestSplit.txt"]:
            scene = self.make_scene("scene" + name[:2])
            (scene / name).unlink()
            self.check_scene(KITCHEN, scene.name, says=[name, "no such file"])
        self.check_scene("sceneTe/seq-01", says=["TrainSplit.txt", "one of its sequences"])

    def test_split_file_with_other_words(self):
        scene = self.make_scene()
        (scene / "TestSplit.txt").write_text("seq-02\n")
        self.check_scene(KITCHEN, "desk", says=["TestSplit.txt", "'seq-02'", "sequenceN"])
        (scene / "TestSplit.txt").write_text("")
        self.check_scene("desk", says=["TestSplit.txt", "sequenceN"])

    def test_missing_sequence(self):
        scene = self.make_scene()
        (scene / "TestSplit.txt").write_text("sequence2\nsequence7\n")
        self.check_scene(KITCHEN, "desk", says=["seq-07", "no such folder", "TestSplit.txt lists it"])
        (scene / "seq-07.zip").write_bytes(b"PK")
        self.check_scene("desk", says=["seq-07.zip", "unpack"])

    def test_other_numbering_of_sequences(self):
        scene = self.make_scene()
        (scene / "seq-02").rename(scene / "seq2")
        self.check_scene(KITCHEN, "desk", says=["seq-02", "no such folder"])

    def test_missing_frames(self):
        for kind, number in [("depth.png", 0), ("color.png", 0)]:
            scene = self.make_scene("scene" + kind[:2])
            (scene / "seq-02" / f"frame-{number:06d}.{kind}").unlink()
            self.check_scene(KITCHEN, scene.name, says=[f"frame-{number:06d}.{kind}", "no such file"])
        scene = self.make_scene("gap")
        for number in (1, 2):
            for file in (scene / "seq-02").glob(f"frame-{number:06d}.*"):
                file.unlink()
        self.check_scene(KITCHEN, "gap", says=["frame-000001", "numbered from 0"])

    def test_frames_numbered_from_one(self):
        scene = self.make_scene()
        for number in reversed(range(4)):
            for file in (scene / "seq-02").glob(f"frame-{number:06d}.*"):
                file.rename(file.with_name(file.name.replace(f"{number:06d}", f"{number + 1:06d}")))
        self.check_scene(KITCHEN, "desk", says=["frame-000000", "numbered from 0"])

    def test_other_names_of_frames(self):
        scene = self.make_scene()
        for file in (scene / "seq-02").glob("frame-*"):
            file.rename(file.with_name(file.name.replace("frame-00", "frame-")))
        self.check_scene(KITCHEN, "desk", says=["seq-02"])

    def test_no_poses(self):
        scene = self.make_scene()
        for file in (scene / "seq-02").glob("*.pose.txt"):
            file.unlink()
        self.check_scene(KITCHEN, "desk", says=["seq-02", "no pose"])


if __name__ == "__main__":
    app_support.main()
