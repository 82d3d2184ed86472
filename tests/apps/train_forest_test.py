# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""train_forest from the outside."""

import unittest

import app_support

ROOM = "synthetic:training-0?frames=4&width=160&height=120"
SMALL = ["--trees", 2, "--depth", 4, "--candidates", 16, "--examples-per-frame", 100, "--set", "num_features=16"]


class TrainTest(app_support.AppTest):
    def train(self, out, *arguments):
        return self.check_success("--sequence", ROOM, "--out", out, *SMALL, *arguments)

    def test_the_forest_depends_on_the_seed_and_not_on_the_threads(self):
        self.train("one.forest", "--threads", 1)
        self.train("two.forest", "--threads", 2)
        self.train("other.forest", "--seed", 7)
        one = (self.folder / "one.forest").read_bytes()
        self.assertEqual(one, (self.folder / "two.forest").read_bytes())
        self.assertNotEqual(one, (self.folder / "other.forest").read_bytes())
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["one.forest", "other.forest", "two.forest"])

    def test_info_tells_where_a_forest_comes_from(self):
        self.train("a.forest", "--seed", 5, "--note", "commit = abc")
        info = self.check_success("info", "a.forest").stdout
        for words in ["2 trees", "16 features", "depth 4", "seed = 5", f"sequence = {ROOM}, 4 frames", "data hash = ", "commit = abc"]:
            self.assertIn(words, info)

    def test_settings_from_a_file_yield_to_options(self):
        (self.folder / "settings.json").write_text('{"depth": 2, "num_trees": 1}')
        self.check_success("--sequence", ROOM, "--out", "a.forest", "--settings", "settings.json", "--examples-per-frame", 50, "--depth", 3)
        self.assertIn("1 trees, 8 leaves", self.check_success("info", "a.forest").stdout)

    def test_resume_without_a_checkpoint_starts_from_the_beginning(self):
        self.train("a.forest", "--resume")
        self.train("b.forest")
        self.assertEqual((self.folder / "a.forest").read_bytes(), (self.folder / "b.forest").read_bytes())

    def test_resume_refuses_a_damaged_checkpoint(self):
        (self.folder / "a.forest.checkpoint").write_text("no checkpoint, but long enough for one")
        self.check_refused("--sequence", ROOM, "--out", "a.forest", "--resume", *SMALL, says=["a.forest.checkpoint", "FHFTRAIN"])

    def test_refuses_what_it_cannot_use(self):
        self.check_refused("--out", "a.forest", says="--sequence")
        self.check_refused("--sequence", ROOM, says="--out")
        self.check_refused("--sequence", "synthetic:nowhere", "--out", "a.forest", says="nowhere")
        self.check_refused("--sequence", ROOM, "--out", "a.forest", "--depth", 21, says=["depth", "21", "[1, 20]"])
        self.check_refused("--sequence", ROOM, "--out", "a.forest", "--set", "dept=3", says=["dept", "depth"])
        self.check_refused("--sequence", ROOM, "--out", "a.forest", "--set", "depth", says="setting=value")
        self.check_refused("--sequence", ROOM, "--out", "missing/a.forest", says="missing/a.forest")


class RandomTest(app_support.AppTest):
    def test_writes_a_data_free_forest(self):
        self.check_success("random", "--out", "a.forest", "--set", "depth=4", "--seed", 3)
        info = self.check_success("info", "a.forest").stdout
        for words in ["5 trees, 80 leaves", "data-free", "seed = 3"]:
            self.assertIn(words, info)

    def test_refuses_what_it_cannot_use(self):
        self.check_refused("random", "--out", "a.forest", "--set", "depth=0", says=["depth", "[1, 20]"])
        self.check_refused("info", "missing.forest", says="missing.forest")
        (self.folder / "short.forest").write_bytes(b"FHFOREST")
        self.check_refused("info", "short.forest", says="short.forest")


if __name__ == "__main__":
    app_support.main()
