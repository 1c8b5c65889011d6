#!/usr/bin/env python3
"""Runs tests of the build for 64-bit Arm under qemu, as ctest lists them, one on each CPU; the longest begin.

  arm64_tests.py [--short] [--targets]   --targets: prints what is to be built for them, and runs none

Called by scripts/arm64.sh. Tests that passed are not run again while their commands and programs stay as they are:
build/arm64/passed_tests.txt has them.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import time

BUILD = pathlib.Path(__file__).resolve().parent.parent / "build/arm64"
ROOT = BUILD.parent / "arm64-root"
PASSED = BUILD / "passed_tests.txt"

# All their cases run: each primitive over 2^32 numbers or 10^8 at least.
WHOLE = ["math_test", "texture_test", "raster_test", "terrain_test", "lod_test", "sky_test"]
# Of these all that ctest runs under qemu: not the cases that the address checks leave out, other cases running the same
# code. Not here are programs that draw pictures for hours, of which same_pictures.py compares more (the others of
# render, dataset_test, bench_test), that follow paths of light for hours (sky_air_test), that measure time (making_test,
# ray_time_test), and that open windows (view_test, viewer_test, viewer_rebuild_test, serve_test).
LARGER = """shared_test render_shaders_test ocean_coast_test ocean_open_sea_test render_lidar_test render_labels_test
  rounding_modes_test c_interface_test render_under_water_test sim_test ocean_maps_test render_wide_test
  render_parts_test scene_things_test door_test below_test wave_provider_example ocean_below_test shapes_test
  unload_test scene_file_test example_hull_test peer_maps_test math_parallel_test lidar_test""".split()
SHORT = ["math_test", "raster_test", "sky_test"]
# What qemu does not have for programs: filters of system calls, advice on memory, each signal that comes between threads.
WITHOUT = "LargeArray.AsksForHugePages:*ReplacedFile*:*AbandonedFile*:ImageFilesDeathTest.*:" \
          "Workers.ThatGetTooFewThreads*:Ways/Signals.*"
LONG = ":*TargetBits*:ElementaryExhaustive*"


def read_commands(names, short):
    """{name: words}, as ctest has them but for the cases that are left out."""
    listed = subprocess.run(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], stdout=subprocess.PIPE, check=True)
    listed = {test["name"]: test["command"] for test in json.loads(listed.stdout)["tests"]}
    commands = {name: listed[name] for name in names}
    for name, words in commands.items():
        if words[-1].startswith("--gtest_filter=-"):
            words[-1] = "--gtest_filter=-" + WITHOUT + LONG * short if name in WHOLE else f"{words[-1]}:{WITHOUT}"
    return commands


def program_of(command):
    return next(pathlib.Path(word) for word in command if word.startswith(f"{BUILD}/bin/"))


def state_of(name, command):
    """A line: the test, and a hash of its command, its program, and the programs and libraries that these name."""
    naming = " ".join(command).encode() + program_of(command).read_bytes()
    state = hashlib.sha256(naming)
    for file in sorted([*BUILD.glob("bin/swell-*"), *BUILD.glob("lib/libswell.so.?")]):
        if file.name.encode() in naming:
            state.update(file.read_bytes())
    return f"{name} {state.hexdigest()}"


def run(command):
    began_s = time.monotonic()
    # Programs that a test starts find their libraries there.
    environment = {**os.environ, "SWELL_CACHE": "off", "QEMU_LD_PREFIX": str(ROOT)}
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          env=environment, check=False)
    return done.returncode, done.stdout, time.monotonic() - began_s


def main():
    short = "--short" in sys.argv
    commands = read_commands(SHORT if short else WHOLE + LARGER, short)
    if "--targets" in sys.argv:
        print(" ".join(program_of(command).name for command in commands.values()))
        return
    known = PASSED.read_text(encoding="utf-8").splitlines() if PASSED.exists() else []
    states = {name: state_of(name, command) for name, command in commands.items()}
    failed = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = {pool.submit(run, commands[name]): name for name, state in states.items() if state not in known}
        for done in concurrent.futures.as_completed(runs):
            name, (code, printed, took_s) = runs[done], done.result()
            print(f"{name}: {'passed' if code == 0 else f'exit code {code}'}, {took_s:.0f} s", flush=True)
            if code == 0:
                with PASSED.open("a", encoding="utf-8") as file:
                    file.write(states[name] + "\n")
            else:
                print(printed)
                failed.append(name)
    if failed:
        sys.exit(f"error: tests under qemu, got faults in {' '.join(failed)}, allowed none")


if __name__ == "__main__":
    main()
