# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""sequence_info from the outside."""

import json
import os
import unittest

import app_support


class SequenceInfoTest(app_support.AppTest):
    def setUp(self):
        super().setUp()
        app_support.write_seven_scenes(self.folder / "take", 6)

    def test_tells_layout_cameras_depth_and_poses(self):
        (self.folder / "take" / "frame-000003.pose.txt").write_text("-inf\n" * 16)
        result = self.check_success("take", "--json", "info.json", "--picture", "sheet.png")
        for words in ["7-Scenes", "6 frames", "80x60", "camera-intrinsics.txt", "1/1000 m", "5 of 6 frames", "registered"]:
            self.assertIn(words, result.stdout)
        self.assertIn("1 of its 6 frames have no pose", result.stderr)
        info = json.loads((self.folder / "info.json").read_text())
        self.assertEqual(info["frames"], 6)
        self.assertEqual(info["depth"]["units_per_m"], 1000)
        self.assertEqual(info["poses"]["frames"], 5)
        self.assertAlmostEqual(info["poses"]["path_m"], 0.05, places=4)
        self.assertGreater(info["poses"]["agreement"], 0.9)
        self.assertEqual(len(info["warnings"]), 1)
        self.assertGreater((self.folder / "sheet.png").stat().st_size, 10000)

    def test_warns_of_a_wrong_unit_until_the_right_one_is_remembered(self):
        result = self.check_success("take", "--depth-scale", 10000)
        self.assertIn("unit of depth looks wrong", result.stderr)
        self.assertIn("--depth-scale 1000", result.stderr)
        self.check_success("take", "--depth-scale", 1000, "--pose-convention", "as-is", "--intrinsics", "73,73,40,30", "--remember")
        self.assertEqual((self.folder / "take" / "depth-scale.txt").read_text().split(), ["1000"])
        self.assertEqual((self.folder / "take" / "pose-convention.txt").read_text().split(), ["as-is"])
        result = self.check_success("take")
        self.assertIn("depth-scale.txt", result.stdout)
        self.assertIn("73 73 40 30", result.stdout)

    def test_draws_frames_that_cannot_be_read_as_empty(self):
        (self.folder / "take" / "frame-000002.depth.png").write_bytes(b"damaged")
        self.check_success("take", "--picture", "sheet.png")

    def test_depth_of_another_kind_is_refused_and_a_damaged_frame_warned_of(self):
        (self.folder / "take" / "frame-000001.depth.png").write_bytes(b"damaged")
        result = self.check_success("take")
        self.assertIn("frames looked at cannot be read", result.stderr)
        self.assertIn("frame-000001.depth.png", result.stderr)
        grey = [bytes(80)] * 60
        for path in (self.folder / "take").glob("*.depth.png"):
            app_support.write_png(path, 80, 60, grey, 8, 1)
        self.check_refused("take", says=["frame-000000.depth.png", "8 bits", "one channel of 16 bits"])

    def test_pipes_instead_of_files_do_not_hang(self):
        for name in ["camera-intrinsics.txt", "frame-000000.depth.png", "frame-000001.pose.txt"]:
            with self.subTest(name):
                path = self.folder / "take" / name
                content = path.read_bytes()
                path.unlink()
                os.mkfifo(path)
                self.check_refused("take", says=[name, "a pipe or device"])
                path.unlink()
                path.write_bytes(content)
        os.mkfifo(self.folder / "pipe")
        self.check_refused("take", "--intrinsics", "pipe", says=["pipe", "a pipe or device"])

    def test_what_is_no_recording_is_refused(self):
        (self.folder / "other").mkdir()
        (self.folder / "other" / "a.txt").write_text("")
        self.check_refused("other", says=["another kind", "a.txt", "7-Scenes", "ScanNet"])
        self.check_refused("absent", says="no such folder")
        self.check_refused("take", "--pose-convention", "left", says=["'left'", "opengl"])
        self.check_refused("take", "--intrinsics", "1,2", says="2 numbers")
        self.check_refused("take", "--depth-scale", "-1", says="-1")
        self.check_refused("take", "--picture", "nowhere/sheet.png", says="nowhere/sheet.png")


if __name__ == "__main__":
    app_support.main()
