"""A quick look at a scene: its picture, its labels, and the waves around the camera as a figure.

    python3 quick_look.py [SCENE.toml [OUT.png]]

Writes a figure if python3-matplotlib is installed; prints what the labels say in any case.
"""

import sys

import numpy as np

import swell

scene = sys.argv[1] if len(sys.argv) > 1 else "scenes/buoys.toml"
out = sys.argv[2] if len(sys.argv) > 2 else "quick_look.png"
world = swell.World(scene)
picture = world.render(t=5.0, size=(640, 360), labels=["depth", "id", "class", "normal", "elevation"])

for klass, name in enumerate(world.classes):
    print(f"{name:12} {100 * np.mean(picture['class'] == klass):5.1f} % of the picture")
eye = np.array(picture.camera.eye[:2])
east, north = np.meshgrid(np.linspace(-100, 100, 256), np.linspace(-100, 100, 256))
heights = world.height(eye + np.stack([east, north], -1), t=5.0)
print(f"water within 100 m of the camera: {heights.min():.2f} to {heights.max():.2f} m")

try:
    import matplotlib
except ImportError:
    print("no figure: it needs python3-matplotlib")
    sys.exit()
matplotlib.use("Agg")
import matplotlib.pyplot as plt

figure, axes = plt.subplots(2, 3, figsize=(15, 7))
depth = np.where(np.isfinite(picture["depth"]), picture["depth"], np.nan)
sheets = {"picture": picture.rgb, "log10 of the depth in m": np.log10(depth), "id": picture["id"] % 20,
          "normal": (picture["normal"] + 1) / 2, "elevation in m": picture["elevation"]}
for axis, (title, sheet) in zip(axes.flat, sheets.items()):
    axis.imshow(sheet)
    axis.set_title(title)
    axis.axis("off")
waves = axes.flat[5]
waves.imshow(heights, origin="lower", extent=(-100, 100, -100, 100), cmap="RdBu_r")
waves.set_title("height of the water around the camera, m east and north")
figure.savefig(out)
print(f"Wrote {out}")
