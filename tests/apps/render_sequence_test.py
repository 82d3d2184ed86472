# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""render_sequence from the outside: folders and raw files, and what it refuses."""

import struct

import app_support

ROOM = "synthetic:kitchen?frames=3&width=80&height=60"


class RenderTest(app_support.AppTest):
    def test_folder(self):
        self.check_success("--sequence", ROOM, "--out", "kitchen")
        self.assertEqual(len(list((self.folder / "kitchen").glob("*.depth.png"))), 3)

    def test_raw_file(self):
        """A header of 104 bytes, then 72 bytes, depth of 16 bits and three colours for each frame."""
        self.check_success("--sequence", ROOM, "--out", "kitchen.fhraw", "--raw")
        data = (self.folder / "kitchen.fhraw").read_bytes()
        self.assertEqual(data[:8], b"FHRAWSEQ")
        self.assertEqual(len(data), 104 + 3 * (72 + 80 * 60 * 5))

    def test_raw_copy_of_a_folder(self):
        app_support.write_seven_scenes(self.folder / "recording", 4)
        self.check_success("--sequence", "recording", "--out", "copy.fhraw", "--raw", "--stride", 2)
        self.assertEqual((self.folder / "copy.fhraw").stat().st_size, 104 + 2 * (72 + 80 * 60 * 5))

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
        first_frame = slice(104, 104 + 72 + 80 * 60 * 5)
        self.assertEqual(data[first_frame], (self.folder / "direct").read_bytes()[first_frame])

    def test_refusals(self):
        self.check_refused("--sequence", ROOM, "--out", "nowhere/kitchen.fhraw", "--raw", says="nowhere/kitchen.fhraw")
        self.check_refused("--sequence", "synthetic:attic", "--out", "attic", says="attic")


if __name__ == "__main__":
    app_support.main()
