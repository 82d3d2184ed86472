#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""What build.sh, test.sh, demo.sh and compile_times.sh make of their arguments, with the repository's presets on a tiny project.

    build_scripts_test.py REPOSITORY
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(sys.argv.pop(1)).resolve()

PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(tiny LANGUAGES NONE)
add_custom_target(first ALL COMMAND ${CMAKE_COMMAND} -E touch ${CMAKE_BINARY_DIR}/first)
add_custom_target(second ALL COMMAND ${CMAKE_COMMAND} -E touch ${CMAKE_BINARY_DIR}/second)
add_custom_target(relocalisation_benchmark COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_SOURCE_DIR}/program ${CMAKE_BINARY_DIR}/bin/relocalisation_benchmark)
enable_testing()
add_test(NAME one COMMAND ${CMAKE_COMMAND} -E echo one)
add_test(NAME two COMMAND ${CMAKE_COMMAND} -E echo two)
add_test(NAME environment COMMAND ${CMAKE_COMMAND} -E environment)
"""

# Two libraries of one folder, one of which may compile its sources as one.
LIBRARIES = """
add_library(together a.cpp b.cpp)
set_target_properties(together PROPERTIES UNITY_BUILD ${FOOTHOLD_UNITY})
add_library(single a.cpp)
"""


class ScriptTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copy(REPOSITORY / "CMakePresets.json", self.folder)
        shutil.copytree(REPOSITORY / "scripts", self.folder / "scripts")
        shutil.copytree(REPOSITORY / ".ci", self.folder / ".ci")
        self.write_program("scripts/install_packages.sh", "exit 0")
        self.write_program("program", "exit 0")
        (self.folder / "CMakeLists.txt").write_text(PROJECT)

    def write_program(self, path, text):
        file = self.folder / path
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def run_script(self, name, *arguments, status=0, environment=None):
        result = subprocess.run([self.folder / name if "/" in name else self.folder / "scripts" / name, *arguments], env=environment,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(result.returncode, status, result.stdout)
        return result.stdout

    def option(self, name, preset="release"):
        cache = (self.folder / "build" / preset / "CMakeCache.txt").read_text()
        return re.search(f"^{name}:[A-Z]+=(.*)$", cache, re.MULTILINE)[1]

    def is_built(self, target):
        return (self.folder / "build" / "release" / target).exists()


class BuildTest(ScriptTest):
    def test_options_are_kept_until_they_get_another_value(self):
        self.run_script("build.sh")
        self.assertEqual(self.option("FOOTHOLD_CUDA"), "AUTO")
        self.run_script("build.sh", "release", "-DFOOTHOLD_CUDA=OFF", "-DFOOTHOLD_CUDA_ARCHITECTURES=75;90")
        self.run_script("build.sh", "release", "first")
        self.assertEqual(self.option("FOOTHOLD_CUDA"), "OFF")
        self.assertEqual(self.option("FOOTHOLD_CUDA_ARCHITECTURES"), "75;90")
        self.run_script("build.sh", "-DFOOTHOLD_CUDA:STRING=ON")
        self.run_script("build.sh")
        self.assertEqual(self.option("FOOTHOLD_CUDA"), "ON")
        self.assertEqual((self.folder / "build/release/options.txt").read_text().splitlines(),
                         ["-DFOOTHOLD_CUDA_ARCHITECTURES=75;90", "-DFOOTHOLD_CUDA:STRING=ON"])

    def test_options_are_those_of_one_preset(self):
        self.run_script("build.sh", "release", "-DFOOTHOLD_CUDA=OFF")
        self.run_script("build.sh", "ci")
        self.assertEqual(self.option("FOOTHOLD_CUDA", "ci"), "AUTO")

    def test_targets_are_what_is_built(self):
        self.run_script("build.sh", "release", "first", "-DFOOTHOLD_CUDA=OFF")
        self.assertTrue(self.is_built("first"))
        self.assertFalse(self.is_built("second"))
        self.run_script("build.sh")
        self.assertTrue(self.is_built("second"))

    def test_an_option_that_configure_refuses_is_not_kept(self):
        (self.folder / "CMakeLists.txt").write_text(PROJECT + 'if(FOOTHOLD_CUDA STREQUAL "maybe")\n  message(FATAL_ERROR "refused")\nendif()\n')
        self.assertIn("refused", self.run_script("build.sh", "release", "-DFOOTHOLD_CUDA=maybe", status=1))
        self.run_script("build.sh")
        self.assertEqual(self.option("FOOTHOLD_CUDA"), "AUTO")

    def test_other_arguments_are_named(self):
        self.assertIn("got '--verbose', expected", self.run_script("build.sh", "release", "--verbose", status=2))


class TestTest(ScriptTest):
    def test_options_go_to_configure_and_the_rest_to_ctest(self):
        output = self.run_script("test.sh", "-DFOOTHOLD_CUDA=OFF", "--tests-regex", "two")
        self.assertIn("100% tests passed, 0 tests failed out of 1", output)
        self.run_script("test.sh")
        self.assertEqual(self.option("FOOTHOLD_CUDA", "ci"), "OFF")

    def test_no_test_to_run_is_an_error(self):
        self.run_script("test.sh", "--tests-regex", "three", status=8)

    def test_sanitizers_know_what_is_suppressed(self):
        for preset, variable, name in [("asan", "LSAN_OPTIONS", "leaks.txt"), ("tsan", "TSAN_OPTIONS", "races.txt")]:
            output = self.run_script("test.sh", preset, "--tests-regex", "environment", "--verbose")
            file = re.search(f"{variable}=.*suppressions='(.*)'", output)[1]
            self.assertEqual(file, str(self.folder / "tests" / "sanitizers" / name))
            self.assertTrue((REPOSITORY / "tests" / "sanitizers" / name).exists())


class Aarch64Test(ScriptTest):
    def test_its_libraries_are_asked_for_and_its_preset_is_tested(self):
        (self.folder / "cmake").mkdir()
        shutil.copy(REPOSITORY / "cmake/aarch64.cmake", self.folder / "cmake")
        self.write_program("scripts/install_packages.sh", 'echo "$@" >>installed')
        output = self.run_script("test_aarch64.sh", "-DFOOTHOLD_IO=OFF", "--tests-regex", "two")
        self.assertIn("100% tests passed, 0 tests failed out of 1", output)
        self.assertEqual(self.option("FOOTHOLD_IO", "aarch64"), "OFF")
        self.assertIn("--aarch64", (self.folder / "installed").read_text().splitlines())


class ContinuousIntegrationTest(ScriptTest):
    def test_cuda_is_compiled_where_nvcc_is(self):
        self.write_program("fake/nvcc", "exit 0")
        self.run_script(".ci/run", environment=dict(os.environ, PATH=f"{self.folder / 'fake'}:{os.environ['PATH']}"))
        self.assertEqual(self.option("FOOTHOLD_CUDA", "ci"), "ON")


class DemoTest(ScriptTest):
    def test_only_what_the_demo_needs_is_built(self):
        self.run_script("demo.sh")
        self.assertTrue(self.is_built("bin/relocalisation_benchmark"))
        self.assertFalse(self.is_built("first"))

    def test_what_is_configured_stays_as_it_is(self):
        self.run_script("build.sh", "-DFOOTHOLD_CUDA=OFF")
        self.run_script("demo.sh")
        self.assertEqual(self.option("FOOTHOLD_CUDA"), "OFF")


class CompileTimesTest(ScriptTest):
    def files(self, *arguments):
        output = self.run_script("compile_times.sh", "release", *arguments, "together", "single")
        table = output.split("seconds  file\n")[1].split("\n\n")[0]
        return sorted(line.split()[1] for line in table.splitlines())

    def test_lists_sources_by_themselves_or_as_compiled_together(self):
        (self.folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(tiny LANGUAGES CXX)\nadd_subdirectory(code)\n")
        (self.folder / "code").mkdir()
        (self.folder / "code/CMakeLists.txt").write_text(LIBRARIES)
        for name in "ab":
            (self.folder / f"code/{name}.cpp").write_text(f"int {name}() {{ return 1; }}\n")
        self.assertEqual(self.files(), ["code/a.cpp", "code/together/unity_0"])
        # Both libraries compile a.cpp.
        self.assertEqual(self.files("-DFOOTHOLD_UNITY=OFF"), ["code/a.cpp", "code/b.cpp"])


if __name__ == "__main__":
    unittest.main()
