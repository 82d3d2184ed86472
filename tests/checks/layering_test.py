#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""layering.py must see each kind of violation, and nothing in a clean tree."""

import os
import tempfile
import unittest

from layering import Checker

HEADER = "// SPDX-License-Identifier: MIT\n// Copyright (c) 2026 The Foothold authors\n"


class LayeringTest(unittest.TestCase):
    def violations(self, files):
        with tempfile.TemporaryDirectory() as repository:
            for path, text in files.items():
                os.makedirs(os.path.join(repository, os.path.dirname(path)), exist_ok=True)
                with open(os.path.join(repository, path), "w", encoding="utf-8") as file:
                    file.write(text)
            return Checker(repository).run()

    def expect_violation(self, path, body, what):
        found = self.violations({path: HEADER + body})
        self.assertEqual(len(found), 1, found)
        self.assertIn(what, found[0])
        self.assertTrue(found[0].startswith(path + ":"), found[0])

    def expect_clean(self, path, body):
        self.assertEqual(self.violations({path: HEADER + body}), [])

    def test_modules_of_one_layer_never_see_each_other(self):
        self.expect_violation("modules/fusion/src/a.cpp", '#include "foothold/relocalisation/forest.h"\n', "fusion must not see relocalisation")
        self.expect_violation("modules/api/src/a.cpp", '#include "foothold/fusion/volume.h"\n', "api must not see fusion")
        self.expect_clean("modules/learning/src/a.cpp", '#include "foothold/fusion/volume.h"\n#include "foothold/base/se3.h"\n')
        self.expect_violation("modules/reconstruction/src/a.cpp", '#include "foothold/io/sequence.h"\n', "reconstruction must not see io")
        self.expect_clean("modules/reconstruction/src/a.cpp", '#include "foothold/fusion/volume.h"\n#include "foothold/relocalisation/forest.h"\n')
        self.expect_clean("apps/replay/main.cpp", '#include "foothold/fusion/volume.h"\n#include <opencv2/core.hpp>\n')

    def test_unknown_modules_need_a_place(self):
        self.expect_violation("modules/novel/src/a.cpp", "#include <vector>\n", "no place in the layers")

    def test_libraries_stay_in_their_modules(self):
        self.expect_violation("modules/fusion/src/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV")
        self.expect_violation("modules/io/src/a.cpp", "#include <OpenNI.h>\n", "OpenNI2")
        self.expect_violation("modules/reconstruction/src/a.cpp", "#include <opencv2/core.hpp>\n", "OpenCV")
        self.expect_violation("modules/relocalisation/src/a.cpp", "#include <oneapi/tbb/parallel_for.h>\n", "oneTBB")
        self.expect_clean("modules/io/src/a.cpp", "#include <opencv2/core.hpp>\n")

    def test_cuda_headers_stay_in_cuda_files(self):
        self.expect_violation("modules/fusion/src/a.h", "#pragma once\n#include <cuda_runtime.h>\n", "CUDA header")
        self.expect_clean("modules/fusion/src/a.cu", "#include <cuda_runtime.h>\n")
        self.expect_violation("modules/fusion/src/a.cu", "void f() { g<<<1, 1>>>(); }\n", "kernel launch")

    def test_executors_stay_out_of_public_headers(self):
        body = '#pragma once\n#include "foothold/base/exec/cpu_executor.h"\n'
        self.expect_violation("modules/fusion/include/foothold/fusion/a.h", body, "executor")
        self.expect_clean("modules/fusion/src/a_kernels.h", body)

    def test_public_headers_do_not_include_private_ones(self):
        self.expect_violation("modules/fusion/include/foothold/fusion/a.h", '#pragma once\n#include "volume/b.h"\n', "private")
        self.expect_violation("modules/fusion/src/a.cpp", '#include "forest/b.h"\n', "not a private header")

    def test_rooms_of_a_module_include_those_below_them(self):
        header = {"modules/fusion/src/icp/b.h": HEADER + "#pragma once\n", "modules/fusion/src/tsdf/b.h": HEADER + "#pragma once\n"}
        upward = {**header, "modules/fusion/src/tsdf/a.cpp": HEADER + '#include "icp/b.h"\n'}
        found = self.violations(upward)
        self.assertEqual(len(found), 1, found)
        self.assertIn("tsdf must not see icp", found[0])
        for path in ["modules/fusion/src/raycast/a.cpp", "modules/fusion/src/tsdf/a.cpp", "modules/fusion/src/a.cpp"]:
            self.assertEqual(self.violations({**header, path: HEADER + '#include "tsdf/b.h"\n'}), [])

    def test_libraries_neither_end_the_process_nor_print(self):
        self.expect_violation("modules/base/src/a.cpp", "void f() { std::exit(1); }\n", "ends the process")
        self.expect_violation("modules/base/src/a.cpp", "void f() { abort(); }\n", "ends the process")
        self.expect_violation("modules/base/src/a.cpp", "void f() { std::cout << 1; }\n", "terminal")
        self.expect_violation("modules/base/src/a.cpp", 'void f() { printf("x"); }\n', "terminal")
        self.expect_clean("modules/base/src/a.cpp", '// exit() and std::cout are forbidden\nconst char* s = "abort()"; /* exit(\n1) */\n')
        self.expect_clean("apps/replay/main.cpp", "void f() { std::exit(1); }\n")

    def test_threads_live_in_executors_and_background_decorators(self):
        self.expect_violation("modules/relocalisation/src/a.cpp", "std::thread worker;\n", "thread")
        self.expect_clean("modules/relocalisation/src/background_relocaliser.cpp", "std::thread worker;\n")
        self.expect_clean("modules/io/src/a.cpp", "std::thread worker;\n")

    def test_every_source_begins_with_the_licence(self):
        for path in ["modules/base/src/a.cpp", "scripts/a.sh", "tests/checks/a.py"]:
            found = self.violations({path: "\n"})
            self.assertEqual(len(found), 1, found)
            self.assertIn("SPDX", found[0])
        self.assertEqual(self.violations({"scripts/a.sh": "#!/bin/sh\n" + HEADER.replace("//", "#")}), [])

    def test_headers_are_included_once(self):
        self.expect_violation("modules/base/src/a.h", "int f();\n", "#pragma once")


if __name__ == "__main__":
    unittest.main()
