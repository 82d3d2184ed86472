#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""test_titles.py must see each semicolon in a title, and none elsewhere."""

import unittest

from test_titles import bad_titles


class TestTitlesTest(unittest.TestCase):
    def test_titles_in_one_piece_and_in_several(self):
        text = 'int a;\nTEST_CASE("a: b; c", "[tag;]") { f("x; y"); }\nTEST_CASE(\n    "d: e "\n    "f; g") {}\nTEST_CASE_METHOD(Fixture, "h; i") {}\nSCENARIO("j; k") {}\n'
        self.assertEqual(list(bad_titles(text)), [(2, "a: b; c"), (3, "d: e f; g"), (6, "h; i"), (7, "j; k")])

    def test_semicolons_elsewhere_are_fine(self):
        self.assertEqual(list(bad_titles('TEST_CASE("a: \\"b\\" and c") { CHECK(d == "e;"); SECTION("f; g") {} }\n')), [])


if __name__ == "__main__":
    unittest.main()
