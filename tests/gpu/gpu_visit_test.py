#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Runs scripts/gpu_visit.sh with programs that only pretend: its order, limits and logs, and what it makes of ncu's table.

    gpu_visit_test.py REPOSITORY TEST_PROGRAM

TEST_PROGRAM has the tests of foothold_gpu_tests; the script must name tests that there are.
"""

import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

STEPS = ["versions", "tests", "memcheck", "racecheck", "time", "compare", "ncu", "soak"]
NCU_TABLE = """\
==PROF== Connected to process 1
"ID","Process ID","Kernel Name","Context","Stream","gpu__time_duration.sum"
"","","","","","ns"
"0","1","void foothold::detail::for_each_team_kernel<foothold::Draw<foothold::CudaExecutor>>(T1)","1","7","1,500"
"1","1","void foothold::detail::for_each_kernel<foothold::Average>(unsigned long, T1)","1","7","2048"
"2","1","void foothold::detail::for_each_team_kernel<foothold::Draw<foothold::CudaExecutor>>(T1)","1","7","2500"
"""


class Visit:
    """A folder as pack_gpu_run.sh's archive makes it, with tools beside it; programs are shell scripts."""

    def __init__(self, repository):
        self.folder = tempfile.mkdtemp()
        os.makedirs(f"{self.folder}/bin")
        os.makedirs(f"{self.folder}/recordings")
        os.makedirs(f"{self.folder}/tools")
        shutil.copy(f"{repository}/scripts/gpu_visit.sh", self.folder)
        self.write("recordings/kitchen", "")
        self.program("bin/foothold_gpu_tests", 'echo "tests $*"')
        self.program("bin/device_benchmark", 'echo "benchmark $*"; echo "| whole | 1 |"')
        self.program("tools/nvidia-smi", "echo a GPU")
        self.program("tools/compute-sanitizer", 'echo "sanitizer $*"')
        self.program("tools/ncu", 'for i in "$@"; do [[ $log ]] && cp "$(dirname "$0")/table" "$i"; log=; [[ $i == --log-file ]] && log=1; done; echo "ncu $*"')
        self.write("tools/table", NCU_TABLE)

    def write(self, name, text):
        with open(f"{self.folder}/{name}", "w", encoding="utf-8") as file:
            file.write(text)

    def program(self, name, body):
        self.write(name, f"#!/bin/bash\n{body}\n")
        os.chmod(f"{self.folder}/{name}", stat.S_IRWXU)

    def run(self, *arguments):
        environment = dict(os.environ, OUT=f"{self.folder}/out", PATH=f"{self.folder}/tools:{os.environ['PATH']}")
        return subprocess.run([f"{self.folder}/gpu_visit.sh", *arguments], env=environment, capture_output=True, text=True, timeout=120, check=False)

    def log(self, step):
        with open(f"{self.folder}/out/{step}.log", encoding="utf-8") as file:
            return file.read()

    def change_script(self, before, after):
        with open(f"{self.folder}/gpu_visit.sh", encoding="utf-8") as file:
            text = file.read()
        assert before in text
        self.write("gpu_visit.sh", text.replace(before, after))

    def remove(self):
        shutil.rmtree(self.folder)


class GpuVisitTest(unittest.TestCase):
    repository = None
    test_program = None

    def setUp(self):
        self.visit = Visit(self.repository)
        self.addCleanup(self.visit.remove)
        self.visit.change_script("while sleep 15", "while sleep 1")

    def test_all_steps_run_in_their_order_each_with_a_log(self):
        done = self.visit.run()
        self.assertEqual(done.returncode, 0, done.stdout)
        positions = [done.stdout.index(f"{step}: passed") for step in STEPS]
        self.assertEqual(positions, sorted(positions))
        self.assertEqual(sorted(os.listdir(f"{self.visit.folder}/out")), sorted(f"{step}.log" for step in STEPS))
        for recording in [f"{self.visit.folder}/recordings/kitchen", "synthetic:office"]:
            self.assertIn(f"time --device cuda --sequence {recording}", self.visit.log("time"))
            self.assertIn(f"compare --threads 0 --sequence {recording}", self.visit.log("compare"))

    def test_the_limits_leave_room_for_a_second_visit(self):
        with open(f"{self.repository}/scripts/gpu_visit.sh", encoding="utf-8") as file:
            steps = next(line for line in file if line.startswith("steps=("))
        limits = [int(entry.split(":")[1]) for entry in steps.strip()[len("steps=(") : -1].split()]
        self.assertLess(sum(limits), 480)

    def test_the_tests_that_are_looked_at_closely_exist(self):
        with open(f"{self.repository}/scripts/gpu_visit.sh", encoding="utf-8") as file:
            chosen = re.findall(r'/foothold_gpu_tests" "([^"]+)"', file.read())
        self.assertGreater(len(chosen), 5)
        for pattern in ",".join(chosen).split(","):
            listed = subprocess.run([self.test_program, "--list-test-names-only", pattern], capture_output=True, text=True, timeout=60, check=False)
            self.assertNotEqual(listed.stdout.strip(), "", f"no test is called {pattern}")

    def test_without_a_gpu_the_visit_ends_and_says_so(self):
        self.visit.program("bin/device_benchmark", "echo 'error: no usable CUDA device' >&2; exit 2")
        done = self.visit.run()
        self.assertEqual(done.returncode, 3)
        self.assertIn("there is no GPU that can be used", done.stdout)
        self.assertIn("no usable CUDA device", done.stdout)
        self.assertEqual(os.listdir(f"{self.visit.folder}/out"), ["versions.log"])

    def test_a_step_that_fails_or_hangs_does_not_keep_the_others_from_running(self):
        self.visit.program("bin/foothold_gpu_tests", 'echo "tests $*"; exit 1')
        self.visit.program("tools/compute-sanitizer", "exec sleep 60")
        self.visit.change_script("memcheck:50 racecheck:45", "memcheck:5 racecheck:5")
        done = self.visit.run("tests", "memcheck", "compare")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("tests: failed with status 1", done.stdout)
        self.assertIn("memcheck: stopped at its limit of 5 s", done.stdout)
        self.assertIn("compare: passed", done.stdout)
        self.assertNotIn("soak", done.stdout)

    def test_the_dearest_kernels_are_looked_at_closely(self):
        self.assertEqual(self.visit.run("ncu").returncode, 0)
        log = self.visit.log("ncu")
        self.assertIn("4000 2 void foothold::detail::for_each_team_kernel<foothold::Draw<", log)
        self.assertIn("2048 1 void foothold::detail::for_each_kernel<foothold::Average>", log)
        self.assertLess(log.index("4000 2 "), log.index("2048 1 "))
        self.assertIn("--launch-skip 2 --launch-count 1", log)  # it was launched twice in the frames that were counted
        self.assertIn("regex:^void foothold::detail::for_each_team_kernel.foothold::Draw.foothold::CudaExecutor...T1.$", log)

    def test_a_rehearsal_needs_no_gpu(self):
        self.visit.program("tools/nvidia-smi", "exit 9")
        self.visit.program("bin/device_benchmark", '[[ "$*" == *cuda* || $1 == compare ]] && exit 2; echo "benchmark $*"')
        self.visit.program("bin/foothold_gpu_tests", "exit 77")
        done = self.visit.run("--rehearse", "tests", "time", "soak")
        self.assertIn("tests: skipped", done.stdout)
        self.assertIn("time: passed", done.stdout)
        self.assertIn("soak: passed", done.stdout)

    def test_wrong_steps_and_a_missing_pack_are_refused(self):
        self.assertEqual(self.visit.run("everything").returncode, 2)
        os.remove(f"{self.visit.folder}/bin/device_benchmark")
        done = self.visit.run()
        self.assertEqual(done.returncode, 2)
        self.assertIn("pack_gpu_run.sh", done.stderr)


if __name__ == "__main__":
    GpuVisitTest.test_program = sys.argv.pop(2)
    GpuVisitTest.repository = sys.argv.pop(1)
    unittest.main()
