"""scripts/: known answers of what they compute, and runs with stubs in place of programs that take time."""

import pathlib
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "scripts"))

import build_times  # noqa: E402 the path comes first


class BuildTimes(unittest.TestCase):
    LOG = ("# ninja log v5\n"
           "0\t9000\t1\tlod/CMakeFiles/swell_lod.dir/mesh.cpp.o\taa\n"      # replaced by a later run
           "0\t500\t1\tbin/mesh_test\tbb\n"
           "10\t20\t1\tapps/commit\tcc\n10\t20\t1\tapps/commit.h\tcc\n"     # one command
           "0\t2000\t1\tlod/CMakeFiles/swell_lod.dir/mesh.cpp.o\tdd\n"
           "0\t4000\t1\ttests/lod/CMakeFiles/gone_test.dir/gone.cpp.o\tee\n")
    NINJA = ("build lod/CMakeFiles/swell_lod.dir/mesh.cpp.o: CXX_COMPILER__swell_lod_Release /x/mesh.cpp\n"
             "  OBJECT_DIR = lod/CMakeFiles/swell_lod.dir\n"
             "build bin/mesh_test: CXX_EXECUTABLE_LINKER__mesh_test_Release a.o | b.a\n"
             "  OBJECT_DIR = tests/lod/CMakeFiles/mesh_test.dir\n"
             "build apps/commit apps/commit.h | ${cmake_ninja_workdir}apps/commit: CUSTOM_COMMAND\n")

    def test_the_last_run_of_a_command_counts_once(self):
        self.assertEqual(build_times.read_ninja_log(self.LOG),
                         [("lod/CMakeFiles/swell_lod.dir/mesh.cpp.o", 2.0), ("bin/mesh_test", 0.5),
                          ("apps/commit", 0.01), ("tests/lod/CMakeFiles/gone_test.dir/gone.cpp.o", 4.0)])

    def test_kind_and_folder_are_those_of_the_rule(self):
        edges = build_times.read_build_ninja(self.NINJA)
        self.assertEqual(edges["lod/CMakeFiles/swell_lod.dir/mesh.cpp.o"], ("compile", "lod"))
        self.assertEqual(edges["bin/mesh_test"], ("link", "tests/lod"))
        self.assertEqual(edges["apps/commit.h"], ("other", "apps"))
        self.assertNotIn("tests/lod/CMakeFiles/gone_test.dir/gone.cpp.o", edges)

    def test_failed_tests_are_no_times(self):
        self.assertEqual(build_times.read_ctest_costs("mesh_test 3 1.5\nskipped_test 0 0\n---\nmesh_test\n"),
                         {"mesh_test": 1.5})

    def test_sums_are_by_folder_with_the_slowest_first(self):
        rows = [("compile", "lod", "a.o", 2.0), ("compile", "render", "b.o", 5.0), ("link", "lod", "c", 1.0),
                ("tests", "tests/lod", "mesh_test", 0.5)]
        text = build_times.report("release", rows, 1)
        self.assertEqual([line.split() for line in text[2:6]],
                         [["render", "5.0", "0.0", "0.0", "0.0", "5.0"], ["lod", "2.0", "1.0", "0.0", "0.0", "3.0"],
                          ["tests/lod", "0.0", "0.0", "0.0", "0.5", "0.5"], ["all", "7.0", "1.0", "0.0", "0.5", "8.5"]])
        self.assertIn("     5.0  b.o", text)
        self.assertNotIn("     2.0  a.o", text)


if __name__ == "__main__":
    unittest.main()
