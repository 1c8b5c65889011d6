#!/usr/bin/env python3
"""Are the pictures and labels of the build for 64-bit Arm those of the release build's SIMD targets, bit for bit?

Called by scripts/arm64.sh, which has built both. Pictures that are known to be the same are not drawn again while the
programs stay as they are: build/arm64/same_pictures.txt has their names.
"""
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
RELEASE = ROOT / "build/release/bin/swell-render"
ARM = ROOT / "build/arm64/bin/swell-render"
KNOWN = ROOT / "build/arm64/same_pictures.txt"
LARGER = {"open_ocean", "lagoon", "beach", "harbour", "river", "everything"}
TIMES = ["--frames", "0-1", "--fps", "0.125"]  # at 0 s and at 8 s: most of the time goes into a world


def draw(command, scene, size):
    """The hashes of the pictures, and of the files of their labels."""
    with tempfile.TemporaryDirectory() as folder:
        command = [*command, "--scene", ROOT / f"scenes/{scene}.toml", "--size", size, *TIMES, "--hash",
                   "--out", f"{folder}/%d.png", "--labels", "all", "--exr-compression", "none"]
        run = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
        if run.returncode != 0:
            sys.exit(f"error: {' '.join(map(str, command))}: {run.stderr.strip()}")
        labels = [hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(pathlib.Path(folder).glob("*.exr"))]
        return run.stdout.splitlines(), labels


def main():
    programs = hashlib.sha256(RELEASE.read_bytes() + ARM.read_bytes()).hexdigest()
    known = KNOWN.read_text(encoding="utf-8").splitlines() if KNOWN.exists() else []
    if known[:1] != [programs]:
        known = [programs]
        KNOWN.write_text(programs + "\n", encoding="utf-8")
    version = subprocess.run([RELEASE, "--version", "--json"], capture_output=True, text=True, check=True)
    targets = json.loads(version.stdout)["simd_targets"]
    scenes = sys.argv[1:] or sorted(file.stem for file in (ROOT / "scenes").glob("*.toml"))
    same = 0
    for scene in scenes:
        for size in ("96x54", "320x180") if scene in LARGER else ("96x54",):
            name = f"{scene} {size}"
            if name not in known:
                got = draw(["qemu-aarch64-static", "-L", ROOT / "build/arm64-root", ARM], scene, size)
                for target in targets:
                    expected = draw([RELEASE, "--simd", target], scene, size)
                    if got != expected or [len(hashes) for hashes in got] != [2, 2]:
                        sys.exit(f"error: {name}: pictures and labels {got}, allowed {expected} of {target}")
                with KNOWN.open("a", encoding="utf-8") as file:
                    file.write(name + "\n")
            same += 2
    print(f"The same {same} pictures and their labels on both")


if __name__ == "__main__":
    main()
