"""Clouds of swell-sim's recordings against World.lidar() of the Python package: lidar_points_test.py BIN SOURCE."""
import pathlib
import subprocess
import sys
import tempfile

import mcap_reader
import numpy as np
import swell

BIN, SOURCE = (pathlib.Path(path) for path in sys.argv[1:3])
COLUMNS, BEAMS = 256, 32
KINDS = {"x": "<f4", "y": "<f4", "z": "<f4", "intensity": "<f4", "t": "<u4", "ring": "<u2", "class": "<u2", "id": "<u4"}
TYPES = {7: "<f4", 6: "<u4", 4: "<u2"}  # of sensor_msgs/PointField


def matrix(rotation):
    return swell.rotation_of([rotation[k] for k in "wxyz"])


def cloud_of(values):
    """{field: [row, column]}."""
    fields = {field["name"]: (TYPES[field["datatype"]], field["offset"]) for field in values["fields"]}
    assert {name: kind for name, (kind, _) in fields.items()} == KINDS, fields
    assert all(field["count"] == 1 for field in values["fields"])
    kind = np.dtype({"names": list(fields), "formats": [kind for kind, _ in fields.values()],
                     "offsets": [offset for _, offset in fields.values()], "itemsize": values["point_step"]})
    assert values["row_step"] == values["point_step"] * values["width"]
    assert not values["is_bigendian"]
    return np.frombuffer(values["data"], kind).reshape(values["height"], values["width"])


def check_cloud(world, message, body, mounting):
    cloud = cloud_of(message.values)
    assert cloud.shape == (BEAMS, COLUMNS)
    outer, inner = matrix(body["rotation"]), matrix(mounting["rotation"])
    place = [np.array([pose["translation"][axis] for axis in "xyz"]) for pose in (body, mounting)]
    pose = swell.Pose(place[0] + outer @ place[1], swell.quaternion_of(outer @ inner))
    beams = swell.spinning_beams("hdl-32e", COLUMNS, duration=0.0)
    seen = world.lidar(message.t_ns / 1e9, pose, beams, least=0.2, most=100.0, reach=60.0, range_noise=0.02, seed=1)
    met = np.isfinite(seen.range).T
    # A pose that went through a quaternion may turn the last bit where a beam passes an edge.
    assert (np.isfinite(cloud["x"]) != met).mean() < 1e-3
    both = met & np.isfinite(cloud["x"])
    points = np.stack([cloud[axis] for axis in "xyz"], axis=-1)
    off = np.abs(points - seen.point.transpose(1, 0, 2))[both].max(axis=-1)
    assert (off > 1e-3).mean() < 1e-3, np.sort(off)[-10:]
    same = np.zeros_like(both)
    same[both] = off <= 1e-3
    assert np.allclose(cloud["intensity"][same], seen.intensity.T[same], atol=1e-4)
    assert (cloud["class"][same] == seen.klass.T[same]).all()
    assert (cloud["id"][same] == seen.id.T[same]).all()
    assert (cloud["ring"] == np.arange(BEAMS)[:, None]).all()
    assert (cloud["t"] == 0).all() and not cloud["id"][~np.isfinite(cloud["x"])].any()
    return int(both.sum())


def main():
    scene = SOURCE / "scenes/harbour.toml"
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "run.mcap"
        settings = ("camera[0].width_px=16", "camera[0].height_px=9", f"lidar[0].columns={COLUMNS}", "lidar[0].class=true",
                    "lidar[0].id=true")
        subprocess.run([BIN / "swell-sim", "--scene", scene, "--rig", SOURCE / "scenes/rigs/harbour_boat.toml",
                        *(word for setting in settings for word in ("--rig-set", setting)),
                        "--record", path, "--duration", "2"], check=True, stdout=subprocess.DEVNULL)
        messages = mcap_reader.read(path).messages
    fixed = {transform["child_frame_id"]: transform["transform"] for message in messages
             if message.topic == "/tf_static" for transform in message.values["transforms"]}
    moved = {message.t_ns: message.values["transforms"][0]["transform"] for message in messages
             if message.topic == "/tf"}
    clouds = [message for message in messages if message.topic == "/lidar/points"]
    assert [message.t_ns for message in clouds] == [k * 10**8 for k in range(20)]
    world = swell.World(scene)
    points = [check_cloud(world, message, moved[message.t_ns], fixed["lidar_link"]) for message in clouds[::5]]
    print(f"{len(points)} clouds of {points} points are those of World.lidar()")
    assert min(points) > 500


main()
