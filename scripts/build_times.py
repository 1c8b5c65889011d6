#!/usr/bin/env python3
"""Prints where the time of builds goes: compiling, linking and tests, by folder and by preset.

  scripts/build_times.py [--clean] [--slowest N] [PRESET ...]     PRESET: release, unless others are named

Reads build/PRESET: Ninja's log, and what ctest noted of its last runs there. With --clean it first throws away
what is compiled, builds what .ci/run builds, without ccache, and runs the tests, all but the slow ones. Times of commands
are from start to end: what runs beside them makes them longer.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
from collections import defaultdict

ROOT = pathlib.Path(__file__).resolve().parent.parent
KINDS = ("compile", "link", "other", "tests")
SANITIZED = {"asan", "tsan"}  # presets of which .ci/run builds the target sanitizer_tests alone


def read_ninja_log(text):
    """[(output, seconds)] of the last run of each command; one of several outputs counts once."""
    last = {}
    for line in text.splitlines():
        fields = line.split("\t")
        if len(fields) == 5:
            start_ms, end_ms, _, output, command = fields
            last[output] = (int(start_ms), int(end_ms), command)
    once = {run: output for output, run in reversed(last.items())}  # the first of its outputs
    return [(output, (end_ms - start_ms) / 1000) for (start_ms, end_ms, _), output in reversed(once.items())]


def read_ctest_costs(text):
    """{test: seconds}: the mean over the runs in this build folder, as ctest keeps it for its schedule."""
    costs = {}
    for line in text.splitlines():
        if line == "---":  # the names of failed tests follow
            break
        name, runs, seconds = line.rsplit(" ", 2)
        if int(runs) > 0:
            costs[name] = float(seconds)
    return costs


def folder_of(path):
    """Of a path in the build folder: the top folder of its sources, tests/render beside render."""
    parts = pathlib.PurePath(path).parts
    if len(parts) == 1 or parts[0] in ("/", "bin", "lib", "CMakeFiles"):
        return "(top)"
    return "/".join(parts[:2 if parts[0] == "tests" and len(parts) > 2 and parts[1] != "CMakeFiles" else 1])


def read_build_ninja(text):
    """{output: (kind, folder)} of what there is to build."""
    outputs, kind, edges = [], "", {}
    for line in text.splitlines():
        edge = re.match(r"build (.*?): (\S+)", line)
        if edge:
            outputs = edge.group(1).replace("|", " ").split()
            kind = "compile" if "_COMPILER_" in edge.group(2) else "link" if "_LINKER_" in edge.group(2) else "other"
            edges.update({output: (kind, folder_of(outputs[0])) for output in outputs})
        place = re.match(r"  OBJECT_DIR = (.*)/CMakeFiles/", line)
        if place:  # programs of all folders lie in bin/
            edges.update({output: (kind, folder_of(place.group(1) + "/x")) for output in outputs})
    return edges


def test_folders(build):
    """{test: folder}, as ctest knows them."""
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True,
                            stdout=subprocess.PIPE, stdin=subprocess.DEVNULL).stdout
    folders = {}
    for test in json.loads(listed)["tests"]:
        place = {entry["name"]: entry["value"] for entry in test.get("properties", [])}["WORKING_DIRECTORY"]
        folders[test["name"]] = folder_of(str(pathlib.Path(place).relative_to(build)) + "/x")
    return folders


def read_build(build):
    """[(kind, folder, name, seconds)] of all commands and tests of a build folder."""
    rows = []
    edges = read_build_ninja((build / "build.ninja").read_text())
    for output, seconds in read_ninja_log((build / ".ninja_log").read_text()):
        if output in edges:
            rows.append((*edges[output], output, seconds))
    costs = build / "Testing/Temporary/CTestCostData.txt"
    if costs.exists():
        folders = test_folders(build)
        rows += [("tests", folders[name], name, seconds)
                 for name, seconds in read_ctest_costs(costs.read_text()).items() if name in folders]
    return rows


def table(first_column, sums):
    """Lines: a row a key of sums, the longest first, and their sum."""
    width = max([len(first_column)] + [len(key) for key in sums])
    lines = [f"{first_column:<{width}}" + "".join(f"{kind:>9}" for kind in KINDS) + f"{'all':>9}"]
    total = {kind: sum(row[kind] for row in sums.values()) for kind in KINDS}
    for key, row in sorted(sums.items(), key=lambda item: -sum(item[1].values())) + [("all", total)]:
        lines.append(f"{key:<{width}}" + "".join(f"{row[kind]:9.1f}" for kind in KINDS) +
                     f"{sum(row.values()):9.1f}")
    return lines


def sums_by(rows, key):
    sums = defaultdict(lambda: dict.fromkeys(KINDS, 0.0))
    for row in rows:
        sums[key(row)][row[0]] += row[3]
    return sums


def report(preset, rows, slowest):
    lines = [f"{preset}: seconds by folder"] + table("folder", sums_by(rows, lambda row: row[1]))
    for title, kinds in (("outputs", KINDS[:3]), ("tests", KINDS[3:])):
        some = sorted((row for row in rows if row[0] in kinds), key=lambda row: -row[3])[:slowest]
        if some:
            lines += ["", f"{preset}: the slowest {title}, s"] + [f"{row[3]:8.1f}  {row[2]}" for row in some]
    if not any(row[0] == "tests" for row in rows):
        lines += ["", f"{preset}: no tests have run in this folder"]
    return lines


def build_clean(preset, build):
    environment = dict(os.environ, CCACHE_DISABLE="1")

    def run(*command):
        subprocess.run(command, check=True, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL,
                       stdout=sys.stderr)
    run("cmake", "--preset", preset)
    run("cmake", "--build", "--preset", preset, "--target", "clean")
    for stale in (".ninja_log", "Testing/Temporary/CTestCostData.txt"):
        (build / stale).unlink(missing_ok=True)
    target = ["--target", "sanitizer_tests"] if preset in SANITIZED else []
    run("cmake", "--build", "--preset", preset, *target)
    run("ctest", "--preset", preset, "--no-tests=error", "-LE", "slow")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--clean", action="store_true", help="build and test anew first")
    parser.add_argument("--slowest", type=int, default=15, metavar="N", help="how many outputs and tests are named")
    parser.add_argument("presets", nargs="*", default=["release"], metavar="PRESET")
    options = parser.parse_args()
    rows = {}
    for preset in options.presets:
        build = ROOT / "build" / preset
        if options.clean:
            try:
                build_clean(preset, build)
            except subprocess.CalledProcessError as failed:
                sys.exit(f"error: '{' '.join(failed.cmd)}' ended with {failed.returncode}")
        if not (build / ".ninja_log").exists():
            parser.error(f"{build.relative_to(ROOT)} holds no build; scripts/build_times.py --clean {preset} makes one")
        rows[preset] = read_build(build)
    for preset in options.presets:
        print("\n".join(report(preset, rows[preset], options.slowest)), end="\n\n")
    if len(rows) > 1:
        by_preset = sums_by([(kind, preset, name, seconds) for preset, of_preset in rows.items()
                             for kind, _, name, seconds in of_preset], lambda row: row[1])
        print("\n".join(["seconds by preset"] + table("preset", by_preset)))


if __name__ == "__main__":
    main()
