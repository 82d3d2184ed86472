# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""reconstruct_live from the outside, with the virtual camera on the real OpenNI2 library."""

import os
import pathlib
import re
import signal
import subprocess
import time
import unittest

import app_support

MODE = ("--mode", "160x120@30")


class LiveTest(app_support.AppTest):
    def setUp(self):
        super().setUp()
        library = pathlib.Path(self.app).parent.parent / "virtual_camera"
        self.assertTrue((library / "libOpenNI2.so.0").exists(), "the virtual camera is not built")
        self.plug_in("pattern:160x120")
        self.set_variable("LD_LIBRARY_PATH", str(library))

    def set_variable(self, name, value):
        before = os.environ.get(name)
        self.addCleanup(os.environ.__setitem__, name, before) if before is not None else self.addCleanup(os.environ.pop, name, None)
        os.environ[name] = value

    def plug_in(self, sequence, **script):
        self.set_variable("FOOTHOLD_VIRTUAL_CAMERA", sequence)
        for name, value in script.items():
            self.set_variable(f"FOOTHOLD_VIRTUAL_CAMERA_{name}", value)

    def recorded(self, folder):
        return len(list((self.folder / folder).glob("frame-*.depth.png")))


class CameraTest(LiveTest):
    def test_lists_cameras_and_modes(self):
        self.plug_in("pattern:160x120|pattern:320x240")
        output = self.check_success("--list-devices").stdout
        self.assertIn("0  foothold://0  Foothold Virtual camera (pattern:160x120)", output)
        self.assertIn("1  foothold://1", output)
        self.assertIn("320x240@30 (depth 1 mm)", output)

    def test_refuses_what_is_not_there(self):
        self.check_refused(*MODE, "--camera", "3", says=["no such camera", "foothold://0"])
        self.check_refused("--mode", "640x480@30", says=["no depth mode", "160x120 at 30 Hz"])
        self.plug_in("none")
        self.check_refused(*MODE, says="no camera found")
        self.check_refused("--list-devices", says="no camera found")

    def test_refuses_wrong_options(self):
        self.check_refused("--mode", "big", says=["--mode", "640x480@30"])
        self.check_refused("--set", "camera.fqs=30", says="did you mean 'camera.fps'")
        self.check_refused("--set", "camera.registration=yes", says="auto, device, software or off")
        self.check_refused("--calibration", "nowhere", says="camera-intrinsics.txt")


class RecordTest(LiveTest):
    def test_records_what_the_camera_sends(self):
        output = self.check_success(*MODE, "--record", "take", "--frames", 10).stdout
        self.assertIn("10 frames written, 0 dropped", output)
        self.assertEqual(self.recorded("take"), 10)
        times = [float(line.split()[1]) for line in (self.folder / "take" / "timestamps.txt").read_text().splitlines()]
        self.assertEqual(times, sorted(times))
        self.assertRegex((self.folder / "take" / "camera-intrinsics.txt").read_text(), r"^(160|159\.99|160\.00)")

    def test_survives_an_unplug(self):
        self.plug_in("pattern:160x120", EVENTS="unplug@5+15")
        result = self.check_success(*MODE, "--record", "take", "--frames", 10)
        self.assertIn("was unplugged", result.stderr)
        self.assertIn("reopened 1 times", result.stdout)
        self.assertEqual(self.recorded("take"), 10)

    def test_interrupt_completes_the_recording(self):
        process = subprocess.Popen([self.app, *MODE, "--record", "take"], cwd=self.folder, stdout=subprocess.PIPE, text=True)
        while not (self.folder / "take" / "frame-000004.depth.png").exists():
            self.assertIsNone(process.poll(), "the app ended by itself")
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        output = process.communicate()[0]
        self.assertEqual(process.returncode, 130)
        written = int(re.search(r"(\d+) frames written", output).group(1))
        self.assertEqual(self.recorded("take"), written)
        self.assertEqual(len((self.folder / "take" / "timestamps.txt").read_text().splitlines()), written)

    def test_a_folder_with_frames_is_left_alone(self):
        self.check_success(*MODE, "--record", "take", "--frames", 2)
        self.check_refused(*MODE, "--record", "take", "--frames", 2, says="take")
        self.assertEqual(self.recorded("take"), 2)


if __name__ == "__main__":
    app_support.main()
