# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""render_sequence from the outside: folders and raw files, and what it refuses."""

import os
import shutil
import signal
import struct
import subprocess
import time
import unittest

import app_support

ROOM = "synthetic:kitchen?frames=3&width=80&height=60"
OUT_OF_MEMORY = 3
HEAD_BYTES, FRAME_BYTES, TAIL_BYTES = 12 + 24 + 88, 12 + 24 + 65 + 80 * 60 * 5, 12 + 24 + 8  # in a raw file


class RenderTest(app_support.AppTest):
    def test_folder(self):
        self.check_success("--sequence", ROOM, "--out", "kitchen")
        self.assertEqual(len(list((self.folder / "kitchen").glob("*.depth.png"))), 3)

    def test_raw_file(self):
        self.check_success("--sequence", ROOM, "--out", "kitchen.fhraw", "--raw")
        data = (self.folder / "kitchen.fhraw").read_bytes()
        self.assertEqual(data[:8], b"FHRAWSEQ")
        self.assertEqual(len(data), HEAD_BYTES + 3 * FRAME_BYTES + TAIL_BYTES)

    def test_raw_copy_of_a_folder(self):
        app_support.write_seven_scenes(self.folder / "recording", 4)
        self.check_success("--sequence", "recording", "--out", "copy.fhraw", "--raw", "--stride", 2)
        self.assertEqual((self.folder / "copy.fhraw").stat().st_size, HEAD_BYTES + 2 * FRAME_BYTES + TAIL_BYTES)

    def test_a_folder_is_a_copy_and_a_raw_file_is_registered(self):
        """A raw file is read by programs that do not register; intrinsics of depth and of colour stand at bytes 24 and 40 of its header."""
        app_support.write_seven_scenes(self.folder / "recording", 2)
        (self.folder / "recording" / "colour-intrinsics.txt").write_text("66 0 41\n0 66 31\n0 0 1\n")
        self.check_success("--sequence", "recording", "--out", "copy")
        self.check_success("--sequence", "copy", "--out", "raw", "--raw")
        self.check_success("--sequence", "recording", "--out", "direct", "--raw")
        self.assertEqual((self.folder / "copy" / "colour-intrinsics.txt").read_text().split()[0], "66")
        data = (self.folder / "raw").read_bytes()
        self.assertEqual(struct.unpack("<4f", data[24:40]), struct.unpack("<4f", data[40:56]))
        first_frame = slice(HEAD_BYTES, HEAD_BYTES + FRAME_BYTES)
        self.assertEqual(data[first_frame], (self.folder / "direct").read_bytes()[first_frame])

    def test_a_full_disk_and_a_kill_leave_the_former_raw_file(self):
        (self.folder / "kitchen.fhraw").write_text("former")
        limited = ["bash", "-c", f"ulimit -f 20; exec {self.app} --sequence '{ROOM}' --out kitchen.fhraw --raw"]
        result = subprocess.run(limited, cwd=self.folder, capture_output=True, text=True, preexec_fn=lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
        self.assertEqual(result.returncode, app_support.USER_ERROR)
        self.assertIn("kitchen.fhraw: cannot be written: File too large", result.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["kitchen.fhraw"])
        arguments = [self.app, "--sequence", ROOM.replace("frames=3", "frames=100000"), "--out", "kitchen.fhraw", "--raw"]
        process = subprocess.Popen(arguments, cwd=self.folder, stderr=subprocess.DEVNULL)
        while len(list(self.folder.iterdir())) < 2:
            time.sleep(0.01)
        process.kill()
        process.wait()
        self.assertEqual((self.folder / "kitchen.fhraw").read_text(), "former")
        self.check_success("--sequence", ROOM, "--out", "kitchen.fhraw", "--raw")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["kitchen.fhraw"])

    def test_pipes_and_devices(self):
        os.mkfifo(self.folder / "pipe")
        process = subprocess.Popen([self.app, "--sequence", ROOM, "--out", "pipe", "--raw"], cwd=self.folder, stdout=subprocess.DEVNULL)
        self.assertEqual(len((self.folder / "pipe").read_bytes()), HEAD_BYTES + 3 * FRAME_BYTES + TAIL_BYTES)
        self.assertEqual(process.wait(), 0)
        self.check_refused("--sequence", ROOM, "--out", "/dev/full", "--raw", says="/dev/full: cannot be written: No space left on device")

    def test_a_result_that_standard_output_does_not_take_is_an_error(self):
        for arguments in (["--help"], ["--sequence", ROOM, "--out", "kitchen"]):
            for redirection in (">&-", ">/dev/full"):
                command = ["bash", "-c", f'exec "$@" {redirection}', "bash", self.app, *arguments]
                result = subprocess.run(command, cwd=self.folder, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(result.returncode, app_support.USER_ERROR, redirection)
                self.assertIn("standard output: cannot be written", result.stderr)
                shutil.rmtree(self.folder / "kitchen", ignore_errors=True)

    def test_a_closed_standard_stream_is_no_ones_file(self):
        command = ["bash", "-c", 'exec "$@" <&- >&- 2>&-', "bash", self.app, "--sequence", ROOM, "--out", "kitchen.fhraw", "--raw"]
        subprocess.run(command, cwd=self.folder, check=False)
        self.assertEqual((self.folder / "kitchen.fhraw").stat().st_size, HEAD_BYTES + 3 * FRAME_BYTES + TAIL_BYTES)

    @unittest.skipIf(app_support.SANITIZERS, "no sanitizer starts under a limit on addresses: its shadow memory has terabytes of them")
    def test_out_of_memory(self):
        """Whatever the limit: a word and the code for it, or success."""
        codes = set()
        for limit_mb in range(120, 700, 20):
            room = "synthetic:kitchen?frames=1&width=1600&height=1200"
            command = ["bash", "-c", f'ulimit -v {1024 * limit_mb}; exec "$@"', "bash", self.app, "--sequence", room, "--out", f"{limit_mb}.raw", "--raw"]
            result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
            if "error while loading shared libraries" in result.stderr:
                continue
            codes.add(result.returncode)
            self.assertIn(result.returncode, (0, OUT_OF_MEMORY), f"{limit_mb} MB: {result.stderr}")
            if result.returncode != 0:
                self.assertIn("out of memory", result.stderr)
        self.assertEqual(codes, {0, OUT_OF_MEMORY})

    def test_refusals(self):
        self.check_refused("--sequence", ROOM, "--out", "nowhere/kitchen.fhraw", "--raw", says="nowhere/kitchen.fhraw")
        self.check_refused("--sequence", "synthetic:attic", "--out", "attic", says="attic")


if __name__ == "__main__":
    app_support.main()
