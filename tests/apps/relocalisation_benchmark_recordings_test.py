# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""relocalisation_benchmark on recordings with ordinary defects."""

import json
import struct
import unittest

import app_support


class DefectsTest(app_support.AppTest):
    def setUp(self):
        super().setUp()
        app_support.write_seven_scenes(self.folder / "take", 10)

    def run_loss(self, *arguments):
        result = self.check_success("loss", "--sequence", "take", "--method", "ferns", "--json", "results.json", *arguments)
        return result, json.loads((self.folder / "results.json").read_text())

    def test_frames_without_pose_are_left_out_and_counted(self):
        (self.folder / "take" / "frame-000004.pose.txt").write_text("nan\n" * 16)
        (self.folder / "take" / "frame-000005.pose.txt").write_text("")
        (self.folder / "take" / "frame-000008.pose.txt").unlink()
        result, results = self.run_loss()
        self.assertEqual(results["methods"]["ferns"]["num_without_pose"], 3)
        self.assertEqual(results["methods"]["ferns"]["num_tested"], 6)
        self.assertIn("3 frames without a true pose left out", result.stdout)
        self.assertIn("3 of its 10 frames have no pose, the first of them frame 4", results["warnings"][0])
        self.assertEqual(result.stderr.count("have no pose"), 1)

    def test_frames_without_depth_count_as_not_found(self):
        empty = [struct.pack(">H", 0) * 80] * 60
        app_support.write_png(self.folder / "take" / "frame-000006.depth.png", 80, 60, empty, 16, 1)
        result, results = self.run_loss()
        self.assertEqual(results["methods"]["ferns"]["num_without_depth"], 1)
        self.assertEqual(results["methods"]["ferns"]["num_tested"], 9)
        self.assertEqual(results["methods"]["ferns"]["num_trained"], 9)
        self.assertIn("1 frame without depth", result.stdout)

    def test_images_that_cannot_be_read_count_as_frames_without_depth(self):
        (self.folder / "take" / "frame-000003.color.png").unlink()
        damaged = self.folder / "take" / "frame-000006.depth.png"
        damaged.write_bytes(damaged.read_bytes()[:-20])
        result, results = self.run_loss()
        self.assertEqual(results["methods"]["ferns"]["num_without_depth"], 2)
        self.assertEqual(results["methods"]["ferns"]["num_tested"], 9)
        self.assertEqual(len(results["warnings"]), 1)
        self.assertIn("2 of its 10 frames cannot be read", results["warnings"][0])
        self.assertIn("frame-000003.color.png", results["warnings"][0])
        self.assertEqual(result.stderr.count("cannot be read"), 1)

    def test_a_recording_of_which_half_cannot_be_read_is_refused(self):
        for index in range(4, 9):
            (self.folder / "take" / f"frame-{index:06d}.color.png").unlink()
        self.check_refused("loss", "--sequence", "take", "--method", "ferns", says=["frame-000004.color.png", "5 of its 10 frames"])

    def test_says_which_intrinsics_are_used(self):
        result, results = self.run_loss("--intrinsics", "70,70,39.5,29.5")
        self.assertIn("intrinsics 70 70 39.5 29.5 (as given)", result.stderr)
        self.assertEqual(results["settings"]["intrinsics"], "70,70,39.5,29.5")
        self.assertEqual(results["warnings"], [])

    def test_a_recording_without_any_pose_is_refused(self):
        for path in (self.folder / "take").glob("*.pose.txt"):
            path.write_text("")
        self.check_refused("loss", "--sequence", "take", "--method", "ferns", says="with a pose")


if __name__ == "__main__":
    app_support.main()
