# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""reconstruct_live from the outside, with the virtual camera on the real OpenNI2 library."""

import fcntl
import json
import pathlib
import re
import shutil
import signal
import struct
import unittest

import app_support
import live_support
from live_support import LiveTest

MODE = ("--mode", "160x120@30", "--headless")
SHORT_TIMES = ("--set", "camera.silence_timeout_ms=400")


class CameraTest(LiveTest):
    def test_lists_cameras_and_modes(self):
        self.plug_in("pattern:160x120|pattern:320x240")
        output = self.check_success("--list-devices").stdout
        self.assertIn("0  foothold://0  Foothold Virtual camera (pattern:160x120)", output)
        self.assertIn("1  foothold://1", output)
        self.assertIn("320x240@30 (depth 1 mm)", output)

    def test_refuses_what_is_not_there(self):
        self.check_refused(*MODE, "--camera", "3", says=["no such camera", "foothold://0"])
        self.check_refused("--headless", "--mode", "640x480@30", says=["no depth mode", "160x120 at 30 Hz"])
        self.plug_in("none")
        self.check_refused(*MODE, says="no camera found")
        self.check_refused("--list-devices", says="no camera found")

    def test_refuses_wrong_options(self):
        self.check_refused("--mode", "big", says=["--mode", "640x480@30"])
        self.check_refused("--colour-mode", "640", says=["--colour-mode", "640x480"])
        self.check_refused("--set", "camera.fqs=30", says="did you mean 'camera.fps'")
        self.check_refused("--set", "camera.registration=yes", says="auto, device, software or off")
        self.check_refused("--set", "fusion.volume.voxel_size_m=9", says=["voxel_size_m", "[0.001, 0.1]"])
        self.check_refused(*MODE, "--calibration", "nowhere", says="camera-intrinsics.txt")
        self.check_refused("--press", "l100", says=["--press", "KEY@FRAME"])
        self.check_refused("--forest", "nowhere.forest", says="nowhere.forest")
        self.check_refused("--record-only", says="--record DIR")
        self.check_refused("--record-only", "--record", "take", "--save-mesh", "a.ply", says=["--record-only", "a.ply"])

    def test_refuses_outputs_that_cannot_be_written_before_the_run_rather_than_after_it(self):
        for option in ["--save-mesh", "--save-scene", "--save-trajectory", "--json"]:
            self.check_refused(*MODE, option, "missing/file", "--frames", 1, says="missing/file")

    def test_without_a_display_it_names_the_way_out(self):
        self.check_refused("--mode", "160x120@30", says=["cannot open a window", "--headless"])
        self.set_variable("DISPLAY", ":4711")
        self.check_refused("--mode", "160x120@30", says=["DISPLAY=:4711", "--headless"])

    def test_refuses_scenes_that_it_cannot_go_on_with(self):
        self.check_refused(*MODE, "--load-scene", "missing.scene", says="missing.scene")
        (self.folder / "no.scene").write_text("nothing of the kind")
        self.check_refused(*MODE, "--load-scene", "no.scene", says=["no.scene", "not a scene"])
        self.check_success(*MODE, "--frames", 5, "--save-scene", "a.scene")
        good = (self.folder / "a.scene").read_bytes()
        (self.folder / "cut.scene").write_bytes(good[: len(good) // 2])
        self.check_refused(*MODE, "--load-scene", "cut.scene", says=["cut.scene", "ends early"])
        voxels = "fusion.volume.voxel_size_m="
        self.check_refused(*MODE, "--load-scene", "a.scene", "--set", voxels + "0.02", says=["other settings", "--set " + voxels + "0.01"])

    def test_a_camera_without_a_driver(self):
        library = pathlib.Path(self.app).parent.parent / "virtual_camera" / "libOpenNI2.so.0"
        (self.folder / "bare").mkdir()
        shutil.copy(library, self.folder / "bare")
        self.set_variable("LD_LIBRARY_PATH", str(self.folder / "bare"))
        self.check_refused(*MODE, says=["no usable driver", "libopenni2-0"])

    def test_a_camera_that_another_program_uses(self):
        with open(self.folder / "lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.plug_in("pattern:160x120", LOCK=self.folder / "lock")
            self.check_refused(*MODE, says=["cannot be opened", "another program is using it"])
            self.assertIn("cannot be opened now", self.check_success("--list-devices").stdout)

    def test_a_camera_that_stops_sending_is_told_and_does_not_hang(self):
        for event, says in [("stall@3", "has sent nothing"), ("nodepth@3", "colour but no depth"), ("nocolour@3", "depth but no colour")]:
            self.plug_in("pattern:160x120", EVENTS=event, FEATURES="no-sync")
            with self.subTest(event):
                process = self.start(*MODE, *SHORT_TIMES, "--json", "a.json")
                self.wait_for_line(process, says)
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=live_support.PATIENCE_S)
                self.assertEqual(process.returncode, 130)
                self.assertEqual(json.loads((self.folder / "a.json").read_text())["ended_by"], "interrupt")

    def test_a_driver_that_hangs_is_told_and_does_not_hang_the_program(self):
        self.plug_in("pattern:160x120", DELAYS="open=60")
        self.check_refused(*MODE, "--set", "camera.open_timeout_ms=500", says=["has not answered", "Unplug the camera"])
        for call in ["stop", "close"]:
            self.plug_in("pattern:160x120", DELAYS=f"{call}=300")
            result = self.check_success(*MODE, "--frames", 3, "--save-mesh", "a.ply", "--set", "camera.close_timeout_ms=500")
            self.assertIn("has not answered", result.stderr)
            self.assertTrue((self.folder / "a.ply").exists())


class SlowMachineTest(LiveTest):
    def test_fast_means_smaller_images_and_coarser_voxels_unless_said_otherwise(self):
        self.plug_in("pattern:320x240")
        self.check_success("--fast", "--headless", "--frames", 3, "--save-scene", "a.scene", "--record", "take")
        header = (self.folder / "take" / "frame-000000.depth.png").read_bytes()[16:24]
        self.assertEqual(struct.unpack(">II", header), (320, 240))
        self.check_refused("--fast", "--headless", "--set", "fusion.volume.voxel_size_m=0.03", "--load-scene", "a.scene", says="=0.02")
        self.plug_in("pattern:160x120")
        self.check_refused("--fast", "--headless", says="320x240")
        self.check_success("--fast", *MODE, "--frames", 3)


class RecordTest(LiveTest):
    def test_records_what_the_camera_sends(self):
        output = self.check_success(*MODE, "--record", "take", "--record-only", "--frames", 10).stdout
        self.assertIn("10 frames written, 0 dropped", output)
        self.assertEqual(self.recorded("take"), 10)
        times = [float(line.split()[1]) for line in (self.folder / "take" / "timestamps.txt").read_text().splitlines()]
        self.assertEqual(times, sorted(times))
        self.assertRegex((self.folder / "take" / "camera-intrinsics.txt").read_text(), r"^(160|159\.99|160\.00)")

    def test_colour_of_another_size_is_recorded_as_it_is_and_reconstructed_registered(self):
        small = ("--headless", "--mode", "80x60@30", "--colour-mode", "160x120")
        sizes = {}
        for folder, option in [("raw", ["--record-only"]), ("take", [])]:
            self.check_success(*small, "--record", folder, *option, "--frames", 3)
            for kind in ("depth", "color"):
                header = (self.folder / folder / f"frame-000000.{kind}.png").read_bytes()[16:24]
                sizes[folder, kind] = struct.unpack(">II", header)
        self.assertEqual(sizes["raw", "depth"], (80, 60))
        self.assertEqual(sizes["raw", "color"], (160, 120))
        self.assertEqual(sizes["take", "depth"], (80, 60))
        self.assertEqual(sizes["take", "color"], (80, 60))

    def test_survives_an_unplug(self):
        self.plug_in("pattern:160x120", EVENTS="unplug@5+15")
        result = self.check_success(*MODE, "--record", "take", "--record-only", "--frames", 10)
        self.assertIn("was unplugged", result.stderr)
        self.assertIn("reopened 1 times", result.stdout)
        self.assertEqual(self.recorded("take"), 10)

    def test_a_folder_with_frames_is_left_alone(self):
        self.check_success(*MODE, "--record", "take", "--record-only", "--frames", 2)
        self.check_refused(*MODE, "--record", "take", "--frames", 2, says="take")
        self.assertEqual(self.recorded("take"), 2)


class EndTest(LiveTest):
    def test_interrupts_save_everything(self):
        for stop in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            with self.subTest(stop.name):
                name = stop.name
                outputs = {f"--save-{what}": f"{name}.{what}" for what in ["mesh", "scene", "trajectory"]} | {"--json": f"{name}.json"}
                arguments = [word for pair in outputs.items() for word in pair]
                process = self.start(*MODE, "--record", name, *arguments)
                self.wait_for((self.folder / name / "frame-000004.depth.png").exists, process, "the fifth frame")
                process.send_signal(stop)
                output, log = process.communicate(timeout=live_support.PATIENCE_S)
                self.assertEqual(process.returncode, 130, log)
                written = int(re.search(r"(\d+) frames written", output).group(1))
                self.assertEqual(self.recorded(name), written)
                self.assertEqual(len((self.folder / name / "timestamps.txt").read_text().splitlines()), written)
                for file in outputs.values():
                    self.assertGreater((self.folder / file).stat().st_size, 0)
                summary = json.loads((self.folder / f"{name}.json").read_text())
                self.assertEqual(summary["ended_by"], "interrupt")
                self.assertEqual(summary["frames"]["processed"], written)

    def test_one_failure_at_the_end_does_not_keep_the_rest_from_being_saved(self):
        (self.folder / "out").mkdir()
        process = self.start(*MODE, "--save-mesh", "out/a.ply", "--save-trajectory", "a.txt", "--record", "take", "--json", "a.json")
        self.wait_for((self.folder / "take" / "frame-000004.depth.png").exists, process, "the fifth frame")
        (self.folder / "out").rmdir()
        process.send_signal(signal.SIGINT)
        _, log = process.communicate(timeout=live_support.PATIENCE_S)
        self.assertEqual(process.returncode, app_support.USER_ERROR, log)
        self.assertIn("out/a.ply", log)
        self.assertTrue((self.folder / "a.txt").exists())
        self.assertIn("out/a.ply", json.loads((self.folder / "a.json").read_text())["errors"][0])

    def test_a_recording_that_fails_is_told_once_and_the_reconstruction_goes_on(self):
        process = self.start(*MODE, "--record", "take", "--save-mesh", "a.ply", "--json", "a.json")
        self.wait_for((self.folder / "take" / "frame-000004.depth.png").exists, process, "the fifth frame")
        (self.folder / "take").rename(self.folder / "gone")  # at once: what is removed file by file may be written anew meanwhile
        self.wait_for_line(process, "recording has ended")
        process.send_signal(signal.SIGINT)
        _, log = process.communicate(timeout=live_support.PATIENCE_S)
        self.assertEqual(process.returncode, app_support.USER_ERROR, log)
        self.assertNotIn("recording has ended", log)
        self.assertTrue((self.folder / "a.ply").exists())
        self.assertIn("take", json.loads((self.folder / "a.json").read_text())["errors"][0])

    def test_without_a_single_frame_earlier_results_stay(self):
        self.plug_in("pattern:160x120", EVENTS="stall@0")
        for name in ["a.ply", "a.scene", "a.txt"]:
            (self.folder / name).write_text("of an earlier run")
        result = self.check_success(
            *MODE, "--duration", 1, "--save-mesh", "a.ply", "--save-scene", "a.scene", "--save-trajectory", "a.txt"
        )  # fmt: skip
        self.assertIn("nothing was reconstructed", result.stderr)
        for name in ["a.ply", "a.scene", "a.txt"]:
            self.assertEqual((self.folder / name).read_text(), "of an earlier run")


if __name__ == "__main__":
    app_support.main()
