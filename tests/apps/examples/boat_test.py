"""boat_test.py ros2|gazebo BIN SOURCE BUILD: that boat of examples/ floats, and its check.py finds what is wrong.

The folder is copied to an empty place and used as its README says, with the swell-sim of BIN and the package of BUILD.
"""
import importlib.util
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

NAME = sys.argv[1]
BIN, SOURCE, BUILD = (pathlib.Path(path).resolve() for path in sys.argv[2:5])
EXAMPLE = SOURCE / "examples" / NAME
SECONDS = 4
NEEDS = {"ros2": (("idlc", "cyclonedds-tools"), ("dds/dds.h", "cyclonedds-dev")),
         "gazebo": (("ignition/transport11/ignition/transport/Node.hh", "libignition-transport-dev"),
                    ("ignition/msgs8/ignition/msgs/pose_v.pb.h", "libignition-msgs-dev"))}
SHARED = ("check.py", "hull.h", "sea.toml", "seen.h")  # each folder is whole, so that it can be copied


def missing():
    """The packages that the example needs and this machine lacks."""
    return [package for file, package in NEEDS[NAME]
            if not shutil.which(file) and not pathlib.Path("/usr/include", file).exists()]


def environment():
    """Of a domain or partition of the test's own, and with nothing of a user's."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "CYCLONEDDS", "IGN", "GZ"))}
    return {**kept, "ROS_DOMAIN_ID": str(100 + os.getpid() % 100), "IGN_PARTITION": f"swell{os.getpid()}",
            "GZ_PARTITION": f"swell{os.getpid()}", "SWELL_SIM": str(BIN / "swell-sim"),
            "PYTHONPATH": str(BUILD / "python"), "PYTHONDONTWRITEBYTECODE": "1",
            "CXXFLAGS": "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror"}


@unittest.skipIf(missing(), f"without the packages {', '.join(missing())}")
class Boat(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = pathlib.Path(scratch.name, "boat")
        shutil.copytree(EXAMPLE, cls.folder, ignore=shutil.ignore_patterns("build", "seen"))
        cls.said = cls.start("seen")

    @classmethod
    def start(cls, seen):
        done = subprocess.run(["./start.sh", seen, str(SECONDS)], cwd=cls.folder, env=environment(), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300, check=False)
        assert done.returncode == 0, done.stdout
        return done.stdout

    def check(self, seen="seen"):
        done = subprocess.run([sys.executable, "check.py", seen], cwd=self.folder, env=environment(), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300, check=False)
        return done.returncode, done.stdout

    def test_all_that_it_saw_is_right(self):
        code, said = self.check()
        print(said)
        self.assertEqual((code, said.count(": right\n")), (0, 3), said)
        tilts = re.search(r"horizon +(\d+) pictures, tilted by (\S+) to (\S+) deg", said)
        beams = re.search(r"depth +(\d+) middle beams", said)
        self.assertEqual((int(tilts[1]), int(beams[1])), (5 * SECONDS + 1, 5 * SECONDS + 1))
        self.assertLess(float(tilts[2]), -3.0)
        self.assertGreater(float(tilts[3]), 3.0)
        self.assertGreaterEqual(self.said.count("heave"), SECONDS)

    def test_the_same_run_again_shows_the_same_pictures(self):
        self.start("again")
        first, again = (sorted((self.folder / seen).glob("*.ppm")) for seen in ("seen", "again"))
        count = min(len(first), len(again))
        self.assertGreaterEqual(count, 5 * SECONDS)
        for one, other in zip(first, again):
            self.assertEqual(one.name, other.name)
            self.assertTrue(one.read_bytes() == other.read_bytes(), one.name)

    def test_what_is_wrong_is_found(self):
        def turned(words):  # a roll of one degree more
            x, y, z, w = map(float, words[5:])
            sine, cosine = math.sin(math.radians(0.5)), math.cos(math.radians(0.5))
            return words[:5] + [x * cosine + w * sine, y * cosine + z * sine, z * cosine - y * sine,
                                w * cosine - x * sine]

        def longer(words):
            return words[:2] + [float(words[2]) + 1.0]

        def higher(words):
            return words[:4] + [float(words[4]) + 1e-6]
        for kind, change, name in (("pose", turned, "horizon"), ("lidar", longer, "depth"), ("wave", higher, "waves")):
            wrong = self.folder / f"wrong_{name}"
            shutil.copytree(self.folder / "seen", wrong)
            lines = [line.split() for line in (wrong / "seen.txt").read_text().splitlines()]
            lines = [change(words) if words[0] == kind else words for words in lines]
            (wrong / "seen.txt").write_text("".join(" ".join(map(str, words)) + "\n" for words in lines))
            code, said = self.check(wrong.name)
            self.assertEqual(code, 1, said)
            self.assertEqual(re.findall(r"(?m)^(\w+) .*: WRONG$", said), [name], said)

    def test_the_tilt_of_a_drawn_horizon_is_measured(self):
        import numpy
        sys.path.insert(0, str(BUILD / "python"))
        spec = importlib.util.spec_from_file_location("check", EXAMPLE / "check.py")
        check = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(check)
        rows, columns = numpy.mgrid[:361, :641]
        for roll_deg in (-25.0, -3.3, 0.0, 10.0):
            # REP 103: a positive roll has the left side up, and the camera turns clockwise: its right goes down, where
            # the horizon then is higher in the picture.
            line = 170.0 - math.tan(math.radians(roll_deg)) * (columns - 320.0)
            grey = 200.0 - 120.0 * numpy.clip(rows - line + 0.5, 0.0, 1.0)
            self.assertAlmostEqual(check.horizon_deg(grey), roll_deg, delta=0.05)
            half = math.radians(0.5 * roll_deg)
            pose = [0.0, 0.0, 0.0, math.sin(half), 0.0, 0.0, math.cos(half)]
            self.assertAlmostEqual(check.wanted_horizon_deg(pose, 0.0), roll_deg, delta=1e-9)

    def test_both_folders_have_the_same_of_what_they_share(self):
        for name in SHARED:
            self.assertEqual((SOURCE / "examples/ros2" / name).read_bytes(),
                             (SOURCE / "examples/gazebo" / name).read_bytes(), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:], verbosity=2)
