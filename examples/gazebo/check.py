"""Whether what the boat's sensors said is right: check.py [FOLDER [SCENE]], of a run of start.sh.

Measures three things and exits with 1 if one is not within its bound:
  horizon  how the horizon lies in each picture, against the roll of the pose that the boat's program gave
  depth    how far the camera sees at its principal point, against the lidar's middle beam from the same place
  waves    the wave probes, against world.height() of the Python package
"""
import collections
import math
import pathlib
import sys
import tomllib

import numpy as np

import swell

HERE = pathlib.Path(__file__).resolve().parent
MOST_TILT_OFF_DEG = 0.2
# Beams meet the waves themselves, pixels the triangles that are drawn: so far apart in height are the two for half of
# the pixels and for 95 % of them, says the test of Swell's lidars (tests/render/lidar/lidar_picture_test.cpp).
MOST_HEIGHT_OFF_M = {50: 0.01, 95: 0.05}
LEAST_PICTURES = 10


def read_seen(folder):
    """{kind: {stamp in ns: [the words of each line]}} of seen.txt."""
    seen = collections.defaultdict(lambda: collections.defaultdict(list))
    for line in (folder / "seen.txt").read_text().splitlines():
        kind, stamp, *values = line.split()
        seen[kind][int(stamp)].append(values)
    return seen


def read_picture(path):
    """A PPM file's brightness, (height, width)."""
    _, size, _, pixels = path.read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    return np.frombuffer(pixels, np.uint8).reshape(height, width, 3).mean(axis=2)


def rotation(x, y, z, w):
    """The matrix whose columns are a body's axes in the map."""
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def darkening(grey, angle_deg):
    """The mean over the width of how much darker it gets below a line that rises to the right: that of the best line."""
    height, width = grey.shape
    columns = np.arange(0, width, 2)
    rows = np.arange(height)[:, None] - math.tan(math.radians(angle_deg)) * (columns - 0.5 * (width - 1))
    above = np.clip(np.floor(rows).astype(int), 0, height - 2)
    share = np.clip(rows - above, 0.0, 1.0)
    values = (1.0 - share) * grey[above, columns] + share * grey[above + 1, columns]
    inside = (rows >= 0) & (rows <= height - 1)
    count = inside.sum(axis=1)
    mean = np.where(count > columns.size // 2, (values * inside).sum(axis=1) / np.maximum(count, 1), np.nan)
    return np.nanmax(mean[:-2] - mean[2:])


def horizon_deg(grey):
    """The tilt of the line below which the picture gets darkest, positive where it rises to the right."""
    def best(picture, angles):
        return angles[np.argmax([darkening(picture, angle) for angle in angles])]
    height, width = (size // 4 for size in grey.shape)
    coarse = grey[:4 * height, :4 * width].reshape(height, 4, width, 4).mean(axis=(1, 3))
    angle = best(coarse, np.linspace(-40.0, 40.0, 161))
    for reach in (1.0, 0.2, 0.04):
        angle = best(grey, angle + np.linspace(-reach, reach, 11))
    return angle


def wanted_horizon_deg(pose, mounted_pitch_deg):
    """By the pose: the picture's x and y are to the right and down, so that up lies along (-x, -y) in a level one."""
    up = rotation(*pose[3:])[2]  # in the body's axes: ahead, left, up
    pitch = math.radians(mounted_pitch_deg)
    return math.degrees(math.atan2(up[1], math.sin(pitch) * up[0] + math.cos(pitch) * up[2]))


class Report:
    def __init__(self):
        self.is_right = True

    def say(self, name, text, is_right):
        self.is_right = self.is_right and is_right
        print(f"{name:8} {text}: {'right' if is_right else 'WRONG'}")


def main(folder, scene):
    rig = tomllib.loads((HERE / "boat.toml").read_text())
    mounted_pitch_deg = rig["camera"][0]["rpy_deg"][1]
    seen = read_seen(folder)
    poses = {stamp: [float(word) for word in lines[0]] for stamp, lines in seen["pose"].items()}
    report = Report()

    off, wanted = [], []
    for stamp, [[name]] in sorted(seen["picture"].items()):
        if stamp in poses:
            wanted.append(wanted_horizon_deg(poses[stamp], mounted_pitch_deg))
            off.append(abs(horizon_deg(read_picture(folder / name)) - wanted[-1]))
    if len(off) < LEAST_PICTURES:
        sys.exit(f"{folder}: {len(off)} pictures with a pose, wanted at least {LEAST_PICTURES}")
    report.say("horizon", f"{len(off)} pictures, tilted by {min(wanted):.1f} to {max(wanted):.1f} deg, off by at most "
               f"{max(off):.3f} deg, allowed {MOST_TILT_OFF_DEG}", max(off) <= MOST_TILT_OFF_DEG)

    off = []
    for stamp, [[depth_m]] in seen["depth"].items():
        if stamp not in poses or stamp not in seen["lidar"]:
            continue
        range_m = float(seen["lidar"][stamp][0][0])
        if math.isfinite(range_m) and math.isfinite(float(depth_m)):
            pitch = math.radians(mounted_pitch_deg)
            ahead = rotation(*poses[stamp][3:]) @ (math.cos(pitch), 0.0, -math.sin(pitch))
            off.append(abs(float(depth_m) - range_m) * abs(ahead[2]))
    half, most = (np.percentile(off, share) for share in MOST_HEIGHT_OFF_M) if off else (math.inf, math.inf)
    report.say("depth", f"{len(off)} middle beams, in height half of them within {half:.4f} m of the picture, 95 % "
               f"within {most:.4f} m, allowed {MOST_HEIGHT_OFF_M[50]} and {MOST_HEIGHT_OFF_M[95]}",
               len(off) >= LEAST_PICTURES and half <= MOST_HEIGHT_OFF_M[50] and most <= MOST_HEIGHT_OFF_M[95])

    world = swell.World(scene)
    off = []
    for stamp, lines in seen["wave"].items():
        points = np.array(lines, float)
        off.extend(abs(points[:, 2] - world.height(points[:, :2], stamp / 1e9)))
    report.say("waves", f"{len(off)} heights, off by at most {max(off, default=math.inf):g} m, allowed 0",
               len(off) >= LEAST_PICTURES and max(off) == 0.0)
    return 0 if report.is_right else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "seen"),
                  sys.argv[2] if len(sys.argv) > 2 else HERE / "sea.toml"))
