"""The wheel: what is in it, what it asks of a machine, and that it draws where nothing else of Swell is.

  wheel_test.py Contents     of a wheel for any processor
  wheel_test.py Installed    one for this processor, by pip in an environment of its own

SWELL_BUILD is the build's folder, SWELL_RENDER the program swell-render. Python is one that has NumPy.
"""

import csv
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
NEEDED = {"patchelf": "patchelf", "ensurepip": "python3-venv"}
# What every machine has that the tag names (PEP 600).
RUNTIMES = {"libc.so.6", "libm.so.6", "libgcc_s.so.1", "libstdc++.so.6", "ld-linux-x86-64.so.2",
            "ld-linux-aarch64.so.1"}
PROCESSORS = {"x86_64": "Advanced Micro Devices X86-64", "aarch64": "AArch64"}
NEWEST = {"GLIBC": (2, 35), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12,)}
BUILD, RENDER = os.environ["SWELL_BUILD"], os.environ["SWELL_RENDER"]
HASH = 'import swell; print(swell.World("scenes/buoys.toml").render(5.0, (320, 180)).hash); ' \
       'print(open("/proc/self/maps").read())'


def run(*command, **options):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout}"
    return done.stdout


def write_wheel(out):
    return pathlib.Path(run(sys.executable, "-B", SOURCE / "scripts/write_wheel.py", BUILD, out).strip())


class Wheel(unittest.TestCase):
    """A wheel, and its files."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.wheel = write_wheel(cls.folder / "first")
        with zipfile.ZipFile(cls.wheel) as wheel:
            wheel.extractall(cls.folder / "files")
        cls.files = cls.folder / "files"
        cls.objects = sorted(file for file in cls.files.rglob("*.so*"))


class Contents(Wheel):
    def test_the_same_build_gives_the_same_bytes(self):
        second = write_wheel(self.folder / "second")
        self.assertEqual((second.name, second.read_bytes()), (self.wheel.name, self.wheel.read_bytes()))

    def test_no_object_asks_for_a_newer_symbol_than_its_platform_has(self):
        (processor,) = re.findall(r"-manylinux_2_35_(\w+)\.whl$", self.wheel.name)
        self.assertGreater(len(self.objects), 5)
        for file in self.objects:
            self.assertIn(PROCESSORS[processor], run("readelf", "-h", file), file.name)
            undefined = [line for line in run("readelf", "--dyn-syms", "-W", file).splitlines() if " UND " in line]
            versions = set(re.findall(r"@(GLIBC\w*|GCC|CXXABI)_([\w.]+)", "\n".join(undefined)))
            self.assertTrue(versions, file.name)
            for library, version in versions:
                number = tuple(int(part) for part in version.split("."))
                self.assertLessEqual(number, NEWEST[library], f"{file.name}: {library}_{version}")

    def test_it_holds_every_library_but_the_runtimes(self):
        names = {file.name for file in self.objects}
        asked = "".join(run("readelf", "-d", file) for file in self.objects)
        needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", asked))
        self.assertEqual(needed - names - RUNTIMES, set())
        self.assertEqual(names - needed, {file.name for file in self.objects if file.name.startswith("_swell.")})

    def test_its_record_has_every_file(self):
        (record,) = self.files.glob("*.dist-info/RECORD")
        with record.open(newline="") as file:
            named = {row[0] for row in csv.reader(file)}
        files = {file.relative_to(self.files).as_posix() for file in self.files.rglob("*") if file.is_file()}
        self.assertEqual(named, files)
        for part in ("LICENSE", "notices.txt", "libtbb12/copyright", "libpng16-16/copyright"):
            self.assertTrue((record.parent / "licenses" / part).is_file(), part)


class Installed(Wheel):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # Python's own packages are NumPy's; no path of the caller's leads to another swell.
        cls.environment = {name: value for name, value in os.environ.items()
                           if not name.startswith(("PYTHON", "LD_", "PIP_"))}
        cls.environment["PYTHONDONTWRITEBYTECODE"] = "1"
        cls.venv = cls.folder / "venv"
        run(sys.executable, "-m", "venv", "--system-site-packages", cls.venv, env=cls.environment)
        cls.python = cls.venv / "bin/python3"
        cls.pip = [cls.python, "-m", "pip", "--disable-pip-version-check", "--no-cache-dir"]
        print(run(*cls.pip, "install", "--no-index", cls.wheel, env=cls.environment))

    def run_python(self, code):
        return run(self.python, "-c", code, cwd=self.venv / "share/swell", env=self.environment)

    def test_pip_makes_the_same_from_the_sources(self):
        out = self.folder / "pip"
        run(*self.pip, "wheel", "--no-index", "--no-deps", "--config-settings", f"build={BUILD}", "-w", out, SOURCE,
            env=self.environment)
        self.assertEqual((out / self.wheel.name).read_bytes(), self.wheel.read_bytes())

    def test_readme_draws_in_an_environment_of_its_own(self):
        (code,) = re.findall(r"```python\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)
        self.assertRegex(self.run_python(code), r"^\(720, 1280\) \[-?\d")
        (types,) = self.venv.glob("lib/python3*/site-packages/swell/py.typed")
        self.assertTrue((types.parent / "_swell.pyi").is_file())

    def test_the_picture_is_that_of_swell_render(self):
        printed = run(RENDER, "--scene", SOURCE / "scenes/buoys.toml", "--size", "320x180", "--time", "5", "--hash")
        drawn, maps = self.run_python(HASH).split("\n", 1)
        self.assertEqual(printed, f"frame 0 xxh3 {drawn}\n")
        # Every library is the wheel's, whatever the machine has.
        loaded = {pathlib.Path(path).name for path in re.findall(rf"({re.escape(str(self.venv))}\S+\.so\S*)", maps)}
        self.assertEqual(loaded, {file.name for file in self.objects})

    def test_a_scene_with_an_image_says_what_is_missing(self):
        code = 'import swell\ntry: swell.World("scenes/pool.toml")\nexcept swell.SceneError as fault: print(fault)'
        self.assertIn("libswell_image_codec.so", self.run_python(code))


if __name__ == "__main__":
    missing = [package for tool, package in NEEDED.items()
               if not (shutil.which(tool) or importlib.util.find_spec(tool))]
    if missing:
        print(f"skipped: no {', '.join(missing)}")
        sys.exit(77)
    unittest.main()
