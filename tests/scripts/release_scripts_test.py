#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""What fuzz.sh, soak.sh and check_all.sh report, with programs that only pretend to fuzz and test.

    release_scripts_test.py REPOSITORY
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(sys.argv.pop(1)).resolve()

FUZZER = """
echo '#1024 DONE cov: 12 ft: 34 corp: 5/6b'
echo 'stat::number_of_executed_units: 1024'
"""
FINDING = """
for argument in "$@"; do case $argument in -artifact_prefix=*) touch "${argument#*=}crash-1" ;; esac; done
exit 77
"""


class ReleaseScriptTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copytree(REPOSITORY / "scripts", self.folder / "scripts")
        shutil.copytree(REPOSITORY / ".ci", self.folder / ".ci")
        for name in ["install_packages", "build", "test", "tidy"]:
            self.write_program(f"scripts/{name}.sh", "exit 0")
        for name in ["map", "scene"]:
            self.write_program(f"tests/fuzz/{name}_fuzz.cpp", "")
            self.write_program(f"build/fuzz/bin/fuzz_{name}", FUZZER)

    def write_program(self, path, text):
        file = self.folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"#!/bin/bash\n{text}\n")
        file.chmod(0o755)

    def run_script(self, name, *arguments, status=0):
        result = subprocess.run([self.folder / "scripts" / name, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(result.returncode, status, result.stdout)
        return result.stdout

    def test_fuzz_runs_each_target_for_its_share(self):
        output = self.run_script("fuzz.sh", "2")
        self.assertIn("| map | 60 | 1024 | 12 | 34 | 0 |", output)
        self.assertIn("| scene | 60 | 1024 | 12 | 34 | 0 |", output)
        output = self.run_script("fuzz.sh", "2", "map")
        self.assertIn("| map | 120 |", output)
        self.assertNotIn("scene", output)

    def test_fuzz_fails_on_a_finding_after_all_targets_ran(self):
        self.write_program("build/fuzz/bin/fuzz_map", FINDING)
        output = self.run_script("fuzz.sh", "1", status=1)
        self.assertRegex(output, r"\| map \|.*\| 1 \|")
        self.assertRegex(output, r"\| scene \|.*\| 0 \|")
        self.assertTrue((self.folder / "build/fuzz/findings/map/crash-1").exists())

    def test_fuzz_fails_when_a_target_does_not_run(self):
        self.write_program("build/fuzz/bin/fuzz_map", "exit 1")
        self.assertRegex(self.run_script("fuzz.sh", "1", "map", status=1), r"\| map \|.*\| 1 \|")

    def test_check_all_goes_on_after_a_failure_and_lists_it(self):
        self.write_program("tests/checks/format.py", "")
        (self.folder / "tests/checks/format.py").write_text("")
        output = self.run_script("check_all.sh", "1")
        self.assertIn("check_all: all passed", output)
        self.write_program("scripts/tidy.sh", "exit 1")
        output = self.run_script("check_all.sh", "1", status=1)
        self.assertIn("tidy: FAILED", output)
        self.assertIn("fuzz: passed", output)
        self.assertIn("check_all: failed: tidy", output)

    def test_wrong_arguments_are_refused(self):
        self.assertIn("expected a number of minutes", self.run_script("fuzz.sh", status=2))
        self.assertIn("tests/fuzz/none_fuzz.cpp", self.run_script("fuzz.sh", "1", "none", status=2))
        self.assertIn("HOURS", self.run_script("soak.sh", status=2))
        self.assertIn("FUZZ-MINUTES", self.run_script("check_all.sh", "long", status=2))


if __name__ == "__main__":
    unittest.main()
