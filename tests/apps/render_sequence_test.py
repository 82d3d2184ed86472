# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""render_sequence from the outside: folders and raw files, and what it refuses."""

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

    def test_refusals(self):
        self.check_refused("--sequence", ROOM, "--out", "nowhere/kitchen.fhraw", "--raw", says="nowhere/kitchen.fhraw")
        self.check_refused("--sequence", "synthetic:attic", "--out", "attic", says="attic")


if __name__ == "__main__":
    app_support.main()
