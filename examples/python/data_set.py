"""A data set in a loop: pictures with depths, ids and boxes under seas and lights that a seed draws.

    python3 data_set.py FOLDER [COUNT [SEED]]

Sample n depends on the seed and n alone: any samples can be drawn again, or on other machines. Each is one .npz of rgb,
depth, id and class, beside a .json of its scene's text, camera and boxes.
"""

import json
import sys
from pathlib import Path

import numpy as np

import swell

SIZE = (320, 180)


def sample_scene(rng: np.random.Generator) -> dict:
    """A scene of the recipe: wind, sun, haze, a camera on a mast, and a few things on the water."""
    kinds = ["buoy", "boat", "sailboat"]
    things = [{"kind": str(rng.choice(kinds)), "position_m": [float(rng.uniform(-25, 25)), float(rng.uniform(15, 90))],
               "heading_deg": float(rng.uniform(0, 360))} for _ in range(int(rng.integers(1, 6)))]
    for thing in things:
        thing["class"] = thing["kind"]
    return {"wind": {"speed_mps": float(rng.uniform(2, 14)), "from_deg": float(rng.uniform(0, 360))},
            "sky": {"sun_elevation_deg": float(rng.uniform(5, 70)), "sun_azimuth_deg": float(rng.uniform(0, 360))},
            "camera": {"eye_m": [0.0, 0.0, float(rng.uniform(1.5, 6))], "pitch_deg": float(rng.uniform(-8, 0))},
            "object": things}


def boxes(world: swell.World, ids: np.ndarray) -> list:
    """The box [x, y, width, height] of each object that is seen, which its ids have exactly."""
    found = []
    for o in world.objects:
        rows, columns = np.nonzero(ids == o.id)
        if rows.size:
            x, y = int(columns.min()), int(rows.min())
            found.append({"id": o.id, "class": o.class_name, "pixels": int(rows.size),
                          "box": [x, y, int(columns.max()) + 1 - x, int(rows.max()) + 1 - y]})
    return found


def draw_sample(folder: Path, seed: int, n: int) -> dict:
    rng = np.random.default_rng([seed, n])
    world = swell.World(sample_scene(rng))
    t = float(rng.uniform(0, 600))
    picture = world.render(t, SIZE, labels=["depth", "id", "class"])
    facts = {"sample": n, "hash": picture.hash, "t_s": t, "K": picture.camera.K.tolist(),
             "world_from_optical": picture.camera.world_from_optical.tolist(), "boxes": boxes(world, picture["id"]),
             "scene": world.text}
    np.savez_compressed(folder / f"{n:06d}.npz", rgb=picture.rgb, depth=picture["depth"], id=picture["id"],
                        klass=picture["class"])
    (folder / f"{n:06d}.json").write_text(json.dumps(facts, indent=1))
    return facts


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for index in range(int(sys.argv[2]) if len(sys.argv) > 2 else 4):
        sample = draw_sample(out, int(sys.argv[3]) if len(sys.argv) > 3 else 1, index)
        print(f"{index:06d} {sample['hash']} " + ", ".join(f"{b['class']} {b['box']}" for b in sample["boxes"]))
