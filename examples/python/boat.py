"""A boat that rides the waves: physics of one's own on the heights of the sea that is drawn.

    python3 boat.py [FRAMES [FOLDER]]

Writes boat_%03d.png into FOLDER if python3-pil is installed; prints where the boat is in any case.
"""

import sys

import numpy as np

import swell

frames = int(sys.argv[1]) if len(sys.argv) > 1 else 60
folder = sys.argv[2] if len(sys.argv) > 2 else None
world = swell.World({"wind": {"speed_mps": 9}, "camera": {"eye_m": [0, -16, 3], "pitch_deg": -6},
                     "object": [{"kind": "boat", "name": "marie"}]})
boat = next(o for o in world.objects if o.name == "marie")

bow_stern_sides = np.array([[0.0, 2.0], [0.0, -2.0], [0.7, 0.0], [-0.7, 0.0]])
heave, heave_rate, fps = 0.0, 0.0, 30
for frame in range(frames):
    t = frame / fps
    # The physics: a spring and a damper to the water under the hull, and the tilt of that water.
    bow, stern, right, left = world.height(bow_stern_sides, t)
    heave_rate += (25.0 * ((bow + stern + right + left) / 4 - heave) - 4.0 * heave_rate) / fps
    heave += heave_rate / fps
    ahead = np.array([0.0, 4.0, bow - stern]) / np.hypot(4.0, bow - stern)
    up = np.cross([1.4, 0.0, right - left], ahead)
    up /= np.linalg.norm(up)
    pose = swell.Pose.of((0.0, 0.0, heave), np.stack([np.cross(ahead, up), ahead, up], axis=1))

    picture = world.render(t, size=(320, 180), labels=["id"], poses={"marie": pose})
    seen = np.count_nonzero(picture["id"] == boat.id)
    if frame % 10 == 0:
        print(f"t {t:5.2f} s: heave {heave:+.2f} m, pitch {np.degrees(np.arcsin(ahead[2])):+.1f} deg, {seen} pixels")
    if folder:
        from PIL import Image

        Image.fromarray(picture.rgb).save(f"{folder}/boat_{frame:03d}.png")
