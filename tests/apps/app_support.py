# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Runs an app as its users do, and makes small recordings for it. Needs nothing but Python."""

import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

USER_ERROR = 2
SANITIZERS = os.environ.get("FOOTHOLD_SANITIZE", "")  # that the apps are compiled with


def write_png(path, width, height, rows, bits, channels):
    """Writes rows of raw big-endian pixels as a PNG of one or three channels."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, bits, 2 if channels == 3 else 0, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def write_seven_scenes(folder, num_frames, width=80, height=60):
    """A camera that moves 1 cm a frame past a slanted, chequered wall, in the layout of 7-Scenes."""
    folder.mkdir()
    focal = 585.0 * width / 640
    (folder / "camera-intrinsics.txt").write_text(f"{focal} 0 {width / 2}\n0 {focal} {height / 2}\n0 0 1\n")
    for index in range(num_frames):
        stem = f"frame-{index:06d}"
        depth = [b"".join(struct.pack(">H", 1500 + 10 * u + 3 * v) for u in range(width)) for v in range(height)]
        colour = [bytes(c for u in range(width) for c in ((u + index) // 8 % 2 * 200, v // 8 % 2 * 200, 40)) for v in range(height)]
        write_png(folder / f"{stem}.depth.png", width, height, depth, 16, 1)
        write_png(folder / f"{stem}.color.png", width, height, colour, 8, 3)
        (folder / f"{stem}.pose.txt").write_text(f"1 0 0 {0.01 * index}\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")


class AppTest(unittest.TestCase):
    """A test of the app given on the command line, with an empty folder of its own."""

    app = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_app(self, *arguments):
        return subprocess.run([self.app, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=False)

    def check_success(self, *arguments):
        result = self.run_app(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def check_refused(self, *arguments, says):
        """The app must exit with USER_ERROR, say all the given words on stderr, print no result and leave no file behind."""
        before = sorted(self.folder.rglob("*"))
        result = self.run_app(*arguments)
        self.assertEqual(result.returncode, USER_ERROR, f"{arguments}: {result.stdout}{result.stderr}")
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, result.stderr)
        self.assertEqual(sorted(self.folder.rglob("*")), before, "files were left behind")
        return result


def main():
    AppTest.app = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
