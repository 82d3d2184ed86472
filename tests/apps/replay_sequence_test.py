# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""replay_sequence from the outside."""

import json
import os
import shutil
import signal
import struct
import subprocess
import unittest
import unittest.mock

import app_support

ROOM = "synthetic:kitchen?frames=40&width=320&height=240"
BLACKOUT = ("--blackout", 1, "--blackout-length", 5, "--judged", 8)


def without_timing(value):
    """What equal options must reproduce."""
    if isinstance(value, dict):
        return {k: without_timing(v) for k, v in value.items() if k not in ("timing", "threads", "peak_mb", "ms", "median_ms")}
    return [without_timing(v) for v in value] if isinstance(value, list) else value


class ReplayTest(app_support.AppTest):
    def replay(self, *arguments, sequence=ROOM):
        self.check_success(sequence, *arguments, "--json", "result.json")
        return json.loads((self.folder / "result.json").read_text())

    def check_png(self, path):
        data = path.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (1280, 720))


class UndisturbedTest(ReplayTest):
    def test_tracks_and_writes_what_was_asked_for(self):
        result = self.replay("--save-trajectory", "trajectory.txt", "--save-mesh", "mesh.ply")
        self.assertEqual((result["format"], result["format_version"], result["complete"]), ("foothold-replay", 2, True))
        run = result["undisturbed"]
        self.assertEqual((run["frames"], run["lost"], run["ate_frames"]), (40, 0, 40))
        self.assertLess(run["ate"]["rmse_m"], 0.02)
        self.assertLessEqual(run["ate_aligned"]["rmse_m"], run["ate"]["rmse_m"] + 1e-6)
        self.assertEqual(result["kidnaps"], [])
        lines = [line for line in (self.folder / "trajectory.txt").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(len(lines), 40)
        self.assertEqual({len(line.split()) for line in lines}, {8})
        mesh = (self.folder / "mesh.ply").read_bytes()
        self.assertTrue(mesh.startswith(b"ply\nformat binary_little_endian"))
        self.assertIn(f"element vertex {run['vertices']}\n".encode(), mesh[:400])
        self.assertGreater(run["vertices"], 10000)

    def test_settings_reach_the_pipeline(self):
        (self.folder / "settings.json").write_text('{"fusion": {"volume": {"max_depth_m": 4}}}')
        result = self.replay("--voxel", 0.02, "--settings", "settings.json", "--set", "fusion.volume.max_depth_m=4", "--method", "none", "--stride", 2)
        volume = result["settings"]["fusion"]["volume"]
        self.assertAlmostEqual(volume["voxel_size_m"], 0.02, places=6)
        self.assertAlmostEqual(volume["truncation_m"], 0.08, places=6)
        self.assertEqual(volume["max_depth_m"], 4)
        self.assertEqual(result["undisturbed"]["frames"], 20)
        self.assertEqual(result["undisturbed"]["relocaliser_mb"], 0)

    def test_a_recording_without_true_poses_starts_at_the_identity(self):
        app_support.write_seven_scenes(self.folder / "recording", 4)
        for pose in (self.folder / "recording").glob("*.pose.txt"):
            pose.unlink()
        result = self.replay("--save-trajectory", "trajectory.txt", sequence="recording")
        self.assertNotIn("ate", result["undisturbed"])
        first = (self.folder / "trajectory.txt").read_text().splitlines()
        first = [line for line in first if not line.startswith("#")][0].split()
        self.assertEqual([float(word) for word in first[1:]], [0, 0, 0, 0, 0, 0, 1])


class DefectsTest(ReplayTest):
    def setUp(self):
        super().setUp()
        width, height = 160, 120
        app_support.write_seven_scenes(self.folder / "recording", 8, width, height)
        colour = (self.folder / "recording" / "frame-000000.color.png").read_bytes()
        for index in range(8):  # the camera stands still; two boxes before the wall hold the tracker
            (self.folder / "recording" / f"frame-{index:06d}.color.png").write_bytes(colour)
            rows = [b"".join(struct.pack(">H", 1500 + 10 * u + 3 * v - 400 * (40 < u < 80 and 30 < v < 70) - 300 * (100 < u < 130 and 60 < v < 100))
                             for u in range(width)) for v in range(height)]
            app_support.write_png(self.folder / "recording" / f"frame-{index:06d}.depth.png", width, height, rows, 16, 1)

    def test_frames_without_a_true_pose_are_used_all_the_same(self):
        (self.folder / "recording" / "frame-000003.pose.txt").write_text("-inf\n" * 16)
        (self.folder / "recording" / "frame-000004.pose.txt").unlink()
        run = self.replay("--method", "none", sequence="recording")["undisturbed"]
        self.assertEqual((run["frames"], run["without_true_pose"], run["ate_frames"]), (8, 2, 6))

    def test_error_is_told_where_only_later_frames_have_a_true_pose(self):
        (self.folder / "recording" / "frame-000000.pose.txt").write_text("")
        for pose in (self.folder / "recording").glob("*.pose.txt"):
            if pose.read_text():
                pose.write_text(pose.read_text().replace("0 1 0 0", "0 1 0 7"))  # seven metres from where the run begins
        run = self.replay("--method", "none", sequence="recording")["undisturbed"]
        self.assertEqual(run["ate_frames"], 7)
        self.assertLess(run["ate"]["rmse_m"], 0.1)

    def test_a_frame_whose_image_cannot_be_read_is_one_without_depth(self):
        (self.folder / "recording" / "frame-000005.depth.png").write_bytes(b"")
        result = self.replay("--method", "none", sequence="recording")
        self.assertEqual((result["undisturbed"]["frames"], result["undisturbed"]["without_depth"]), (8, 1))
        self.assertIn("frame-000005.depth.png", result["warnings"][0])

    def test_what_came_before_a_frame_of_another_size_is_saved(self):
        rows = [struct.pack(">H", 1500) * 80] * 60
        app_support.write_png(self.folder / "recording" / "frame-000005.depth.png", 80, 60, rows, 16, 1)
        result = self.run_app("recording", "--method", "none", "--json", "result.json", "--save-trajectory", "trajectory.txt")
        self.assertEqual(result.returncode, 2)
        self.assertIn("frame-000005.depth.png", result.stderr)
        report = json.loads((self.folder / "result.json").read_text())
        self.assertEqual((report["undisturbed"]["frames"], report["complete"]), (5, False))
        self.assertIn("frame-000005.depth.png", report["broken_off"])
        self.assertTrue((self.folder / "trajectory.txt").exists())

    def test_poses_far_from_the_origin_are_written_back_there(self):
        for index in range(8):
            (self.folder / "recording" / f"frame-{index:06d}.pose.txt").write_text(f"1 0 0 {481234 + 0.01 * index}\n0 1 0 5412345\n0 0 1 300\n0 0 0 1\n")
        self.replay("--method", "none", "--save-trajectory", "trajectory.txt", sequence="recording")
        first = (self.folder / "trajectory.txt").read_text().splitlines()[1].split()
        self.assertEqual([float(word) for word in first[1:4]], [481234, 5412345, 300])


class KidnapTest(ReplayTest):
    def test_recovers_from_a_covered_lens(self):
        result = self.replay(*BLACKOUT, "--video", "video", "--video-every", 20)
        self.assertEqual(result["summary"]["blackout"]["recovered"], 1)
        self.assertEqual(result["summary"]["blackout"]["wrong_poses_fused"], 0)
        self.assertGreaterEqual(result["kidnapped"]["lost"], 5)
        self.assertEqual(result["kidnaps"][0]["covered"], 5)
        self.assertGreater(result["kidnaps"][0]["mapped"], 0.5)
        surfaces = {(s["run"], s["reference"]): s for s in result["surfaces"]}
        self.assertEqual(len(surfaces), 3)
        accuracy = surfaces["kidnapped", "undisturbed"]["accuracy"]
        self.assertGreater(accuracy["within_a_voxel"], 0.95 * accuracy["vertices"])
        for run in ("kidnapped", "undisturbed"):
            surface = surfaces[run, "true poses"]
            self.assertGreater(surface["accuracy"]["within_a_voxel"], 0.95 * surface["accuracy"]["vertices"])
            self.assertGreater(surface["completeness"]["near"], 0.95 * surface["completeness"]["vertices"])
        pictures = sorted((self.folder / "video").iterdir())
        self.assertEqual([p.name for p in pictures], [f"view-{i:06d}.png" for i in range(0, 80, 20)])
        for picture in pictures:
            self.check_png(picture)

    def test_independent_kidnaps_are_the_same_on_any_number_of_threads(self):
        arguments = ["--independent", "--kidnap", 1, "--kidnap-length", 6, "--teleport", 2, *BLACKOUT, "--seed", 7]
        runs = [without_timing(self.replay(*arguments, "--threads", n)) for n in (1, 2)]
        self.assertEqual(runs[0], runs[1])
        self.assertEqual(sorted(k["kind"] for k in runs[0]["kidnaps"]), ["blackout", "removed", "teleport", "teleport"])
        self.assertEqual(runs[0]["undisturbed"], without_timing(self.replay("--seed", 7))["undisturbed"])

    def test_ferns_stand_in_for_the_forest(self):
        result = self.replay("--method", "ferns", *BLACKOUT)
        self.assertEqual(result["method"], "ferns")
        self.assertEqual(len(result["kidnaps"]), 1)


class LimitsTest(ReplayTest):
    FEW_FRAMES = ROOM + "@0:10"

    def test_a_map_that_is_full_is_warned_of_and_counted(self):
        result = self.replay("--method", "none", "--set", "fusion.volume.max_blocks=300", sequence=self.FEW_FRAMES)
        self.assertEqual(len(result["warnings"]), 1)
        self.assertIn("fusion.volume.max_blocks = 300", result["warnings"][0])
        self.assertGreater(result["undisturbed"]["blocks_refused"], 0)

    def test_depth_out_of_range_is_warned_of_and_counted(self):
        result = self.replay("--method", "none", "--set", "fusion.volume.max_depth_m=1", sequence=self.FEW_FRAMES)
        self.assertEqual(len(result["warnings"]), 1)
        self.assertIn("fusion.volume.max_depth_m = 1,", result["warnings"][0])
        self.assertGreater(result["undisturbed"]["depth_out_of_range"], 0.5)


class ShowTest(ReplayTest):
    @unittest.skipUnless(shutil.which("xvfb-run"), "xvfb-run is not installed")
    def test_shows_a_window(self):
        result = subprocess.run(["xvfb-run", "-a", self.app, ROOM + "@0:6", "--show"], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_says_so_without_a_display(self):
        for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
            value = os.environ.pop(name, None)
            if value is not None:
                self.addCleanup(os.environ.__setitem__, name, value)
        self.check_refused(ROOM, "--show", says=["--show", "DISPLAY", "--video"])

    def test_says_so_whatever_is_wrong_with_a_display(self):
        names = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
        for name, value in [("DISPLAY", "localhost:77.0"), ("WAYLAND_DISPLAY", "wayland-77"), ("DISPLAY", "unix:77"), ("QT_QPA_PLATFORM", "none")]:
            with self.subTest(name, value=value), unittest.mock.patch.dict(os.environ):
                for other in names:
                    os.environ.pop(other, None)
                os.environ[name] = value
                result = self.check_refused(ROOM, "--show", says=["--show", value, "--video"])
                self.assertEqual(len(result.stderr.strip().splitlines()), 1)


class InterruptTest(ReplayTest):
    def test_what_there_is_is_saved(self):
        process = subprocess.Popen([self.app, "synthetic:kitchen?frames=100000&width=160&height=120", "--video", "video", "--json", "result.json",
                                    "--save-trajectory", "trajectory.txt"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.folder / "video" / "view-000003.png").exists():
            self.assertIsNone(process.poll(), "the app ended by itself")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        result = json.loads((self.folder / "result.json").read_text())
        self.assertFalse(result["complete"])
        self.assertGreaterEqual(result["undisturbed"]["frames"], 3)
        self.assertTrue((self.folder / "trajectory.txt").exists())


class BadInputTest(ReplayTest):
    def test_wrong_arguments(self):
        self.check_refused(says="sequence")
        self.check_refused("missing", says="missing")
        self.check_refused("synthetic:castle", says=["castle", "kitchen"])
        self.check_refused(ROOM, "--method", "magic", says=["magic", "forest", "ferns", "none"])
        self.check_refused(ROOM, "--forest", "missing.forest", says="missing.forest")
        self.check_refused(ROOM, "--device", "tpu", says="tpu")
        self.check_refused(ROOM, "--voxel", 1, says="--voxel")
        self.check_refused(ROOM, "--kidnap", -1, says="--kidnap")
        self.check_refused(ROOM, "--kidnap-length", 0, says="--kidnap-length")
        self.check_refused(ROOM, "--video-every", 0, says="--video-every")
        self.check_refused(ROOM, "--set", "fusion.volume.voxel_size=1", says=["voxel_size", "did you mean"])
        self.check_refused(ROOM, "--set", "fusion.volume", says="path=value")
        self.check_refused(ROOM, "--set", "fusion.volume.voxel_size_m=7", says=["voxel_size_m", "[0.001, 0.1]"])
        self.check_refused(ROOM, "--settings", "missing.json", says="missing.json")

    def test_kidnaps_that_do_not_fit(self):
        self.check_refused(ROOM, "--kidnap", 3, says=["3 kidnaps", "40 frames"])
        self.check_refused(ROOM, "--kidnap", 1, "--independent", says=["removed", "40 frames"])

    def test_wrong_outputs_are_refused_before_the_run(self):
        for option in ["--json", "--save-mesh", "--save-trajectory", "--video"]:
            self.check_refused(ROOM, option, "nowhere/name", says="nowhere")
        (self.folder / "file").write_text("")
        self.check_refused(ROOM, "--video", "file", says=["--video", "file"])


if __name__ == "__main__":
    app_support.main()
