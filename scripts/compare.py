"""Are the frames of this tree as fast as a commit's? Builds both and lets them draw by turns.

  scripts/compare.sh [--turns N] [--frames N] [--threads N] COMMIT [-- SCENE|WxH ...]

SCENE is a name of the commit's scenes/, so that its program knows every key, or a file. COMMIT is built in
build/compare/, this tree in build/release.

For each scene and size two programs draw by turns (A B B A ...): pairs of runs, each with the ratio of the medians
of its two runs. A row shows the median of these ratios and the interval that the true median lies in with 95 %
confidence by the sign test, whatever the distribution of the times is: of nine pairs from the second to the eighth
ratio. (swell-bench frame --compare has the same intervals, for each stage.) First the commit's program is compared
with a copy of itself: what that shows is noise.

"Same speed": the interval holds 1.00, or its upper end is under 1.02.
Exit codes: 0 all have the same speed or are faster; 1 one is slower; 2 bad options, or a program that fails.
"""
import argparse
import json
import math
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = ["open_ocean", "lagoon", "beach", "buoys", "harbour", "river", "archipelago", "reef", "everything"]
FEWEST_TURNS = 6  # that an interval of 95 % can be had from
SLOWER = 1.02


class Refused(Exception):
    """What was asked for cannot be measured."""


def interval_rank(pairs):
    """The largest k for which the k-th ratios from below and from above hold the true median between them."""
    outside = 0.0
    for rank in range(pairs):
        outside += 2 * math.comb(pairs, rank) / 2**pairs
        if outside > 0.05:
            return rank
    return 0


def verdict(low, high):
    if low > 1.0 and high >= SLOWER:
        return "SLOWER"
    return "faster" if high < 1.0 else "same speed"


def compare_times(before_ms, after_ms):
    """Of the medians of pairs of runs."""
    ratios = sorted(after / before for before, after in zip(before_ms, after_ms, strict=True))
    rank = interval_rank(len(ratios))
    low, high = ratios[rank - 1], ratios[-rank]
    return {"before_ms": statistics.median(before_ms), "after_ms": statistics.median(after_ms),
            "ratio": statistics.median(ratios), "low": low, "high": high, "verdict": verdict(low, high)}


def draw(program, scene, size, options):
    """swell-bench's report of one run."""
    command = [program, "frame", "--scene", scene, "--size", size, "--frames", options.frames,
               "--threads", options.threads, "--json", "-"]
    command = [str(word) for word in command]
    run = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise Refused(f"'{' '.join(command)}' ended with {run.returncode}: {run.stderr.strip()}")
    return json.loads(run.stdout)


def compare(before, after, scene, size, options):
    """Runs of two programs, which begin by turns: a machine that grows slower steadily is no difference."""
    sides = [(before, []), (after, [])]
    for turn in range(options.turns):
        for program, reports in sides if turn % 2 == 0 else reversed(sides):
            reports.append(draw(program, scene, size, options))
    row = compare_times(*([report["frame_ms"]["median"] for report in reports] for _, reports in sides))
    old, new = (reports[0] for _, reports in sides)
    row["pictures_differ"] = old.get("hash") != new.get("hash")
    row["cpu"] = new.get("cpu", "a CPU without a name")
    return row


def row_text(name, size, kind, row):
    return (f"{name:<12} {size:>9}  {kind:<6} {row['before_ms']:8.2f} {row['after_ms']:8.2f} {row['ratio']:7.3f}  "
            f"{row['low']:.3f} to {row['high']:.3f}  {row['verdict']}").rstrip()


def compare_all(programs, scenes, sizes, options):
    """Prints two rows a scene and size; whether one is slower."""
    old, old_again, new = programs
    slower = False
    print(f"{'scene':<12} {'size':>9}  {'':<6} {'old, ms':>8} {'new, ms':>8} {'ratio':>7}  {'95 % of it':<14}  verdict")
    for scene in scenes:
        for size in sizes:
            name = pathlib.Path(scene).stem
            noise = compare(old, old_again, scene, size, options)
            print(row_text(name, size, "itself", dict(noise, verdict="")), flush=True)
            row = compare(old, new, scene, size, options)
            print(row_text(name, size, "now", row), flush=True)
            if row["pictures_differ"]:
                print("  the pictures of the last frame differ")
            hidden = max(noise["high"], 1 / noise["low"], row["high"] if row["verdict"] == "same speed" else 1)
            if hidden >= SLOWER:
                print(f"  noise: up to {100 * (hidden - 1):.0f} % can hide in it; try more --turns, or less beside it")
            slower = slower or row["verdict"] == "SLOWER"
    print(f"{options.turns} pairs of runs of {options.frames} frames, {options.threads} threads, {row['cpu']}; "
          "the interval is that of the median of the pairs' ratios, by the sign test")
    return slower


def git(*words):
    try:
        run = subprocess.run(["git", *words], cwd=ROOT, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    return run.stdout.strip() if run.returncode == 0 else None


def scene_files(words, commit, folder):
    """Files of scenes that are named, or are files."""
    known = {pathlib.PurePath(name).stem for name in (git("ls-tree", "--name-only", commit, "scenes/") or "").split()
             if name.endswith(".toml")}
    files = []
    for word in words:
        if word in known:
            files.append(folder / "scenes" / f"{word}.toml")
        elif pathlib.Path(word).is_file():
            files.append(pathlib.Path(word).resolve())
        else:
            raise Refused(f"SCENE, got '{word}', allowed a file, a size such as 1280x720, or {', '.join(sorted(known))}")
    return files


def build(folder):
    """With the packages that the folder's own commit asks for."""
    for command in (["scripts/setup.sh"],
                    ["cmake", "--preset", "release"],
                    ["cmake", "--build", "--preset", "release", "--target", "swell-render", "swell-bench"]):
        if subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=sys.stderr, check=False).returncode:
            raise Refused(f"{folder} does not build")
    return folder / "build/release/bin/swell-bench"


def built_programs(commit, folder):
    """The commit's swell-bench, a copy of it, and this tree's."""
    if not folder.exists() and git("worktree", "add", "--detach", str(folder), commit) is None:
        raise Refused(f"git makes no worktree in {folder}; 'git worktree prune' forgets one that was deleted")
    old = build(folder)
    return old, shutil.copy(old, old.with_name("swell-bench-again")), build(ROOT)


def main(words=None, programs=None):
    """Tests give three programs in place of those that are built."""
    parser = argparse.ArgumentParser(prog="scripts/compare.sh", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--turns", type=int, default=9, metavar="N", help="pairs of runs (9; 6 or more)")
    parser.add_argument("--frames", type=int, default=40, metavar="N", help="frames of a run (40)")
    parser.add_argument("--threads", type=int, default=2, metavar="N", help="threads (2)")
    parser.add_argument("commit", metavar="COMMIT", help="what this tree is compared with")
    parser.add_argument("what", nargs="*", metavar="SCENE|WxH",
                        help=f"scenes ({' '.join(SCENES)}) and sizes (1280x720)")
    options = parser.parse_args(words)
    if options.turns < FEWEST_TURNS:
        parser.error(f"--turns: got {options.turns}, allowed {FEWEST_TURNS} or more, for an interval of 95 %")
    sizes = [word for word in options.what if re.fullmatch(r"\d+x\d+", word)]
    names = [word for word in options.what if word not in sizes]
    try:
        commit = git("rev-parse", "--verify", "--quiet", options.commit + "^{commit}")
        if not commit:
            raise Refused(f"COMMIT, got '{options.commit}', which this repository does not have")
        folder = ROOT / "build/compare" / commit
        scenes = scene_files(names or SCENES, commit, folder)
        programs = programs or built_programs(commit, folder)
        return 1 if compare_all(programs, scenes, sizes or ["1280x720"], options) else 0
    except Refused as refused:
        print(f"error: {refused}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
