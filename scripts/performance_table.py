"""Prints the table of docs/understand/performance.md: what a frame takes, in ms, on one and two threads, and as
`swell-bench scaling` predicts for 8 and 16. Runs for about ten minutes; let nothing else run.

    python3 scripts/performance_table.py [FOLDER of swell-bench=build/release/bin]
"""

import json
import subprocess
import sys
from pathlib import Path

SCENES = ["open_ocean", "beach", "lagoon", "buoys", "harbour", "river", "archipelago", "reef", "everything"]
SIZES = ["1280x720", "1920x1080", "3840x2160"]
PREDICTED = [8, 16]


def measure(bench: Path, scene: str, size: str) -> dict:
    command = [bench, "scaling", "--scene", f"scenes/{scene}.toml", "--size", size, "--frames", "30", "--json", "-"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def cell(report: dict) -> str:
    predicted = {row["threads"]: row["frame_ms"] for row in report["predicted"]}
    times = [report["measured"]["one_thread_ms"], report["measured"]["frame_ms"], *(predicted[n] for n in PREDICTED)]
    return "/".join(f"{ms:.1f}" if ms < 100 else f"{ms:.0f}" for ms in times)


def main() -> None:
    bench = Path(sys.argv[1] if len(sys.argv) > 1 else "build/release/bin") / "swell-bench"
    print("| scene |", " | ".join(SIZES), "|")
    print("|---" * (1 + len(SIZES)) + "|")
    for scene in SCENES:
        print(f"| {scene} |", " | ".join(cell(measure(bench, scene, size)) for size in SIZES), "|", flush=True)


if __name__ == "__main__":
    main()
