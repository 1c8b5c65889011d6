"""scripts/: known answers of what they compute, and runs with stubs in place of programs that take time."""

import contextlib
import io
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCE / "scripts"))

import arm64_tests  # noqa: E402 the path comes first
import build_times  # noqa: E402
import compare      # noqa: E402


class Temporary(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class CompareTimes(unittest.TestCase):
    def verdict(self, ratios):
        return compare.compare_times([10.0] * len(ratios), [10.0 * ratio for ratio in ratios])["verdict"]

    def test_ranks_are_those_of_tables_of_the_sign_test(self):
        ranks = {5: 0, 6: 1, 7: 1, 8: 1, 9: 2, 12: 3, 15: 4, 20: 6, 25: 8}
        self.assertEqual({pairs: compare.interval_rank(pairs) for pairs in ranks}, ranks)

    def test_the_interval_holds_the_true_ratio_in_95_of_100_experiments(self):
        dice = random.Random(1)
        held = 0
        for _ in range(1000):
            row = compare.compare_times([1.0] * 9, [1.1 * dice.lognormvariate(0.0, 0.05) for _ in range(9)])
            held += row["low"] <= 1.1 <= row["high"]
        self.assertGreaterEqual(held, 940)  # of nine pairs 96.1 %, less three standard deviations
        self.assertLessEqual(held, 980)

    def test_medians_and_ratio_are_of_pairs(self):
        # The machine grows slower; each pair has the same ratio.
        before = [10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0]
        row = compare.compare_times(before, [1.5 * ms for ms in before])
        self.assertEqual((row["before_ms"], row["after_ms"]), (16.0, 24.0))
        self.assertEqual((row["low"], row["ratio"], row["high"]), (1.5, 1.5, 1.5))

    def test_one_disturbed_pair_of_nine_changes_nothing(self):
        self.assertEqual(self.verdict([1.0] * 8 + [3.0]), "same speed")
        self.assertEqual(self.verdict([1.05] * 8 + [0.3]), "SLOWER")

    def test_same_speed_holds_1_or_ends_under_1_02(self):
        for ratios, verdict in [([0.97, 1.03], "same speed"), ([1.005, 1.019], "same speed"),
                                ([1.005, 1.02], "SLOWER"), ([1.0, 1.5], "same speed"), ([0.9, 0.99], "faster")]:
            with self.subTest(ratios):
                self.assertEqual(self.verdict([ratios[0]] * 4 + [ratios[1]] * 5), verdict)


class CompareSh(Temporary):
    def program(self, name, median_ms, hash="aa"):
        """A swell-bench that has always drawn already, and notes that it was called."""
        report = json.dumps({"frame_ms": {"median": median_ms}, "hash": hash, "cpu": "a stub"})
        path = self.folder / name
        path.write_text(f"#!/bin/sh\necho {name} \"$*\" >>{self.folder}/calls\necho '{report}'\n")
        path.chmod(0o700)
        return path

    def run_compare(self, *words, programs):
        scene = self.folder / "calm.toml"
        scene.write_text("")
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                status = compare.main(["--turns", "6", "HEAD", "--", str(scene), *words], programs)
            except SystemExit as left:
                status = left.code
        return status, out.getvalue(), err.getvalue()

    def setUp(self):
        super().setUp()
        if compare.git("rev-parse", "HEAD") is None:
            self.skipTest("not a repository of git")
        self.old, self.copy = self.program("old", 10.0), self.program("copy", 10.0)

    def test_programs_take_turns_after_the_commit_has_met_itself(self):
        status, out, _ = self.run_compare("64x36", programs=[self.old, self.copy, self.program("new", 10.0)])
        self.assertEqual(status, 0)
        calls = [line.split() for line in (self.folder / "calls").read_text().splitlines()]
        self.assertEqual([call[0] for call in calls], ["old", "copy", "copy", "old"] * 3 + ["old", "new", "new", "old"] * 3)
        self.assertIn("--size 64x36 --frames 40 --threads 2 --json -", " ".join(calls[0]))
        self.assertEqual([line.split()[2] for line in out.splitlines() if line.startswith("calm")], ["itself", "now"])

    def test_a_slower_program_ends_it_with_1(self):
        status, out, _ = self.run_compare("64x36", "128x72", programs=[self.old, self.copy, self.program("new", 10.5)])
        self.assertEqual(status, 1)
        self.assertEqual(out.count("1.050  1.050 to 1.050  SLOWER"), 2)

    def test_other_pictures_are_said(self):
        status, out, _ = self.run_compare(programs=[self.old, self.copy, self.program("new", 9.0, hash="bb")])
        self.assertEqual(status, 0)
        self.assertIn("faster\n  the pictures of the last frame differ", out)

    def test_noise_that_hides_2_percent_is_said(self):
        for median_ms in (10.7, 10.0 / 1.07):
            _, out, _ = self.run_compare(programs=[self.old, self.program("loud", median_ms), self.old])
            self.assertIn("noise: up to 7 % can hide in it", out)

    def test_what_cannot_be_measured_ends_it_with_2(self):
        failing = self.folder / "failing"
        failing.write_text("#!/bin/sh\necho 'error: no such key' >&2\nexit 2\n")
        failing.chmod(0o700)
        status, _, err = self.run_compare(programs=[self.old, self.copy, failing])
        self.assertEqual(status, 2)
        self.assertIn("error: no such key", err)
        for words, said in [(["no_such_scene"], "SCENE, got 'no_such_scene'"), (["--turns", "5"], "--turns")]:
            status, _, err = self.run_compare(*words, programs=[self.old, self.copy, self.old])
            self.assertEqual(status, 2)
            self.assertIn(said, err)


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


@unittest.skipUnless(shutil.which("git"), "needs git")
class CheckCommits(Temporary):
    def git(self, *words):
        subprocess.run(["git", *words], cwd=self.folder, check=True, capture_output=True, env=self.environment)

    def commit(self, message, **files):
        """Files of so many different lines, by name."""
        for name, lines in files.items():
            path = self.folder / name.replace("__", "/")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("".join(f"line {i} of {name}\n" for i in range(lines)))
        self.git("add", ".")
        self.git("commit", "-q", "--allow-empty", "-m", message)

    def setUp(self):
        super().setUp()
        self.environment = dict(os.environ, GIT_CONFIG_GLOBAL="/dev/null", GIT_CONFIG_NOSYSTEM="1", GIT_AUTHOR_NAME="a",
                                GIT_AUTHOR_EMAIL="a@b", GIT_COMMITTER_NAME="a", GIT_COMMITTER_EMAIL="a@b")
        (self.folder / "scripts").mkdir()
        shutil.copy(SOURCE / "scripts/check_commits.sh", self.folder / "scripts")
        self.git("init", "-q")
        self.commit("lod: Begin\n\nThere was nothing.", moved=2000)
        self.git("tag", "begin")

    def warnings(self, base="begin"):
        run = subprocess.run([self.folder / "scripts/check_commits.sh", base], capture_output=True, text=True,
                             check=True, env=self.environment)
        self.assertEqual(run.stderr, "")
        return run.stdout

    def test_a_commit_as_it_should_be_is_passed_over(self):
        self.commit("lod, tests: Bring the mesh closer\n\nIt was 3 m off.", lod=1500)
        self.assertEqual(self.warnings(), "")

    def test_titles_have_an_area_and_an_imperative(self):
        self.commit("Bring the mesh closer\n\nIt was 3 m off.")
        self.assertIn("is not of the shape 'area: Imperative'", self.warnings())
        self.commit("lod: Moved the mesh\n\nIt was 3 m off.")
        self.assertIn("'lod: Moved the mesh': its title's verb 'Moved' is not an imperative", self.warnings())

    def test_a_body_of_trailers_gives_no_reason(self):
        self.commit("lod: Move the mesh\n\nSigned-off-by: somebody")
        self.assertIn("its body gives no reason", self.warnings())

    def test_many_lines_are_warned_of_but_no_moves_goldens_or_images(self):
        (self.folder / "moved").rename(self.folder / "renamed")
        text = (self.folder / "renamed").read_text().splitlines(keepends=True)
        (self.folder / "renamed").write_text("".join(text[:1000]))
        (self.folder / "second").write_text("".join(text[1000:]))
        self.commit("lod: Split a file\n\nIt was long.", tests__golden__list=5000, docs__drawing=10)
        self.assertEqual(self.warnings(), "")
        self.commit("lod: Grow\n\nFor a reason.", grown=1501)
        self.assertIn("it changes 1501 lines, more than 1500", self.warnings())

    def test_without_a_base_the_last_commits_are_looked_at(self):
        self.commit("Grow")
        self.assertRegex(self.warnings("origin/main"), "(?s)^note: no commit 'origin/main' here.*warning: .*'Grow'")


class RunSh(unittest.TestCase):
    def test_every_program_is_built(self):
        made = [re.findall(r"swell_add_program\((swell-\w+)", file.read_text())
                for file in (SOURCE / "apps").glob("*/CMakeLists.txt")]
        targets = re.search(r"--target (.*)", (SOURCE / "scripts/run.sh").read_text())[1].split()
        self.assertGreater(len(sum(made, [])), 3)
        self.assertEqual(set(sum(made, [])) - set(targets), set())


class Arm64Tests(Temporary):
    def test_names_are_of_tests(self):
        lists = "".join(file.read_text() for file in (SOURCE / "tests").glob("**/CMakeLists.txt"))
        known = set(re.findall(r"\b(?:swell_add_(?:program_)?test\(|add_test\(NAME )(\w+)", lists))
        self.assertEqual({*arm64_tests.WHOLE, *arm64_tests.LARGER, *arm64_tests.SHORT} - known, set())
        self.assertEqual(set(arm64_tests.SHORT) - set(arm64_tests.WHOLE), set())

    def test_those_that_passed_run_again_when_a_program_changes(self):
        program = self.folder / "bin/some_test"
        program.parent.mkdir()
        with mock.patch.object(arm64_tests, "BUILD", self.folder):
            def state():
                return arm64_tests.state_of("some_test", ["qemu", str(program)])
            (self.folder / "bin/swell-render").write_text("one")
            program.write_text("of kernels")
            alone = state()
            (self.folder / "bin/swell-render").write_text("another")
            self.assertEqual(state(), alone)
            program.write_text("that runs bin/swell-render")
            naming = state()
            self.assertNotEqual(naming, alone)
            (self.folder / "bin/swell-render").write_text("a third")
            self.assertNotEqual(state(), naming)


class PackageLists(Temporary):
    def packages(self, name):
        lines = (SOURCE / "scripts" / name).read_text().splitlines()
        return {line.split()[0] for line in lines if not line.startswith("#")}

    def test_a_package_is_needed_or_of_the_viewer_or_of_the_tests(self):
        lists = [self.packages(f"packages{group}.txt") for group in ("", "_viewer", "_tests")]
        self.assertEqual(sum(map(len, lists)), len(set.union(*lists)))
        self.assertIn("libhwy-dev", lists[0])

    def test_run_sh_installs_none_of_the_tests(self):
        groups = re.search(r"setup\.sh (.*)", (SOURCE / "scripts/run.sh").read_text())[1].split()
        self.assertEqual(groups, ["viewer", "python"])

    def test_without_those_of_the_viewer_and_the_tests_all_else_is_built(self):
        subprocess.run(["cmake", "-G", "Ninja", "-S", SOURCE, "-B", self.folder, "-DSWELL_SIMD=avx2",
                        "-DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON", "-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON"],
                       capture_output=True, check=True)
        targets = subprocess.run(["ninja", "-C", self.folder, "-t", "targets", "all"], capture_output=True, text=True,
                                 check=True).stdout
        built = {name for name in ("swell-render", "swell-bench", "swell_installed", "swell-view", "math_test")
                 if f"\n{name}: " in targets}
        self.assertEqual(built, {"swell-render", "swell-bench", "swell_installed"})


class CompilersSh(unittest.TestCase):
    def test_an_unknown_compiler_ends_it_with_2(self):
        run = subprocess.run([SOURCE / "scripts/compilers.sh", "g++-1"], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertRegex(run.stderr, r"^error: compiler, got 'g\+\+-1', allowed clang\+\+-16 .*\n$")


class TidySh(unittest.TestCase):
    def test_an_unknown_option_ends_it_with_2(self):
        run = subprocess.run([SOURCE / "scripts/tidy.sh", "--nonsense"], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stdout), (2, ""))


if __name__ == "__main__":
    unittest.main()
