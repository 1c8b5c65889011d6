"""The Python package: known answers, the same pictures as swell-render, faults, threads, the examples.

SWELL_SOURCE_DIR is the repository, SWELL_RENDER the program swell-render.
"""

import gc
import os
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import swell

SOURCE = Path(os.environ["SWELL_SOURCE_DIR"])
RENDER = os.environ["SWELL_RENDER"]
# A gradient for a sky, few triangles: made in 40 ms, drawn in a few.
SMALL = {"sky": {"zenith": [0.1, 0.2, 0.4], "horizon": [0.5, 0.6, 0.7]}, "detail": {"water_triangles": 500}}
STILL = {**SMALL, "sea": {"spectrum": False}}
BUOY = {"kind": "buoy", "name": "red", "class": "buoy", "position_m": [0, 30]}
SIZE = (96, 64)
LABELS = {"depth": (np.float32, ()), "distance": (np.float32, ()), "position": (np.float64, (3,)),
          "normal": (np.float32, (3,)), "geometric_normal": (np.float32, (3,)), "id": (np.uint32, ()),
          "class": (np.uint32, ()), "motion": (np.float32, (2,)), "elevation": (np.float32, ()),
          "foam": (np.float32, ()), "flags": (np.uint8, ())}


@pytest.fixture(scope="module")
def windy():
    return swell.World({**SMALL, "wind.speed_mps": 9, "object": [BUOY]})


@pytest.fixture(scope="module")
def still():
    return swell.World({**STILL, "object": [BUOY]})


def test_the_picture_is_that_of_swell_render():
    scene = SOURCE / "scenes" / "buoys.toml"
    world = swell.World(scene, set={"sea.douglas": 4, "camera.pitch_deg": -8.5})
    printed = subprocess.run([RENDER, "--scene", scene, "--set", "sea.douglas=4", "--set", "camera.pitch_deg=-8.5",
                              "--size", "96x64", "--time", "5", "--hash", "--threads", "1"],
                             capture_output=True, text=True, check=True).stdout
    assert printed == f"frame 0 xxh3 {world.render(5.0, SIZE).hash}\n"


def test_still_water_is_level(still):
    xy = np.zeros((4, 5, 2))
    assert still.height(xy, 1.0).shape == (4, 5) and not still.height(xy, 1.0).any()
    assert (still.normal(xy, 1.0) == [0, 0, 1]).all() and still.normal(xy, 1.0).shape == (4, 5, 3)
    assert not still.velocity(xy, 1.0).any() and not still.slope(xy, 1.0).any() and not still.foam(xy, 1.0).any()
    assert np.isposinf(still.still_depth(xy)).all()
    assert still.height([0.0, 0.0], 1.0).shape == () and still.height(np.zeros((0, 2)), 1.0).shape == (0,)
    hit = still.ray((1, 2, 10), (0, 0, -1), t=1.0)
    assert hit.from_above and hit.distance == pytest.approx(10, abs=1e-5)
    assert still.ray((1, 2, 10), (0, 0, 1), t=1.0) is None


def test_the_query_is_the_surface_that_is_drawn(windy):
    # At the scene's default number of triangles they are small near the eye.
    camera = swell.Camera.look((0, -20, 4), heading=0, pitch=-35, fov_y=40, size=SIZE)
    picture = windy.render(3.0, SIZE, camera=camera, labels=["position", "id", "elevation"], water_triangles=20000)
    water = picture["id"] == 1
    assert water.mean() > 0.9
    heights = windy.height(picture["position"][water][:, :2], 3.0)
    assert np.abs(heights - picture["elevation"][water]).mean() < 0.02
    assert heights.std() > 0.05


def test_labels_have_their_shapes_and_types(windy):
    picture = windy.render(1.0, SIZE, labels="all", linear=True)
    assert picture.rgba.shape == (64, 96, 4) and picture.rgba.dtype == np.uint8 and (picture.rgba[..., 3] == 255).all()
    assert picture.rgb.shape == (64, 96, 3) and picture.linear.dtype == np.float32
    for name, (dtype, tail) in LABELS.items():
        assert picture[name].shape == (64, 96) + tail and picture[name].dtype == dtype, name
    assert windy.classes[:5] == ["sky", "water", "terrain", "object", "foam"]
    red = windy.objects[0]
    assert (red.name, red.kind, red.class_name, red.id) == ("red", "buoy", "buoy", 16)
    assert (picture["class"][picture["id"] == 16] == red.klass).all()


def test_arrays_are_not_copied_and_outlive_the_picture(windy):
    picture = windy.render(1.0, SIZE, labels=["depth"])
    assert picture.rgba.__array_interface__["data"] == picture.rgba.__array_interface__["data"]
    kept, depth = picture.rgb, picture["depth"]
    before = kept.copy(), depth.copy()
    del picture
    gc.collect()
    for k in range(6):
        windy.render(10.0 + k, SIZE, labels=["depth"])
    assert (kept == before[0]).all() and (depth == before[1]).all()


def test_cameras_agree(still):
    look = swell.Camera.look((3, -10, 5), heading=30, pitch=-12, roll=4, fov_y=60, size=SIZE)
    again = swell.Camera.from_pose(look.world_from_optical, look.K)
    opencv_K = look.K - [[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0]]
    optical_from_world = np.linalg.inv(look.world_from_optical)
    opencv = swell.Camera.from_opencv(opencv_K, optical_from_world[:3, :3], optical_from_world[:3, 3])
    for camera in (again, opencv):
        assert np.allclose(camera.world_from_optical, look.world_from_optical, atol=1e-12)
        assert np.allclose(camera.K, look.K, atol=1e-9)
    # By hand: to the north-north-east, down, the right side lowered.
    assert np.allclose(look.world_from_optical[:3, 2],
                       [np.sin(np.pi / 6) * np.cos(0.20944), np.cos(np.pi / 6) * np.cos(0.20944), -np.sin(0.20944)],
                       atol=1e-5)
    assert look.world_from_optical[2, 0] < 0
    picture = still.render(0.0, SIZE, camera=look, labels=["position"])
    assert np.allclose(picture.camera.K, look.K, rtol=1e-5)
    seen = np.isfinite(picture["position"]).all(-1) & (np.abs(picture["position"]) < 200).all(-1)
    y, x = np.nonzero(seen)
    projected = look.project(picture["position"][seen])
    assert seen.sum() > 100
    assert np.allclose(projected[:, 0], x + 0.5, atol=1e-3) and np.allclose(projected[:, 1], y + 0.5, atol=1e-3)


def test_a_lens_bends_the_picture_as_opencv_says(still):
    size = (192, 128)
    pinhole = swell.Camera.look((0, 0, 4), pitch=-8, roll=10, fov_y=60, size=size)
    for distortion in [(-0.25, 0.06, 0.002, -0.003, 0.0), (0.2, 0.05, 0, 0, 0.01)]:
        lens = swell.Camera(pinhole.eye, pinhole.quaternion, pinhole.focal, pinhole.principal, distortion=distortion)
        # By hand, at x = 0.3, y = -0.2.
        k1, k2, p1, p2, k3 = distortion
        r2, radial = 0.13, 1 + k1 * 0.13 + k2 * 0.13**2 + k3 * 0.13**3
        x, y = lens.distort(np.array(0.3), np.array(-0.2))
        assert x == pytest.approx(0.3 * radial + 2 * p1 * 0.3 * -0.2 + p2 * (r2 + 2 * 0.09))
        assert y == pytest.approx(-0.2 * radial + p1 * (r2 + 2 * 0.04) + 2 * p2 * 0.3 * -0.2)
        picture = still.render(1.0, size, camera=lens, labels=["position", "id", "depth"], linear=True)
        assert picture.rgb.shape == (128, 192, 3) and picture.linear.dtype == np.float32
        near = (np.abs(picture["position"]) < 500).all(-1)
        rows, columns = np.nonzero(near)
        xyd = lens.project(picture["position"][near])
        assert near.mean() > 0.4
        # Of the nearest pixel: half a pixel off each way, times what the lens stretches there, 1.6 at most.
        assert np.abs(xyd[:, 0] - columns - 0.5).max() < 0.8 and np.abs(xyd[:, 1] - rows - 0.5).max() < 0.8
        assert np.allclose(xyd[:, 2], picture["depth"][near], rtol=1e-4)
        assert picture.camera is lens
    nearly = swell.Camera(pinhole.eye, pinhole.quaternion, pinhole.focal, pinhole.principal, distortion=(1e-9, 0, 0, 0, 0))
    same = still.render(1.0, size, camera=pinhole)
    bent = still.render(1.0, size, camera=nearly, labels=["motion"])
    assert np.abs(bent.rgb.astype(int) - same.rgb.astype(int)).mean() < 1.0
    with pytest.raises(ValueError):
        bent["motion"]
    with pytest.raises(ValueError):
        still.render(1.0, size, camera=replace(lens, distortion=(-2.0, 0, 0, 0, 0)))


def test_rotations_come_back():
    rng = np.random.default_rng(3)
    for q in [np.array([1, 0, 0, 0.0]), np.array([0, 1, 0, 0.0]), np.array([0, 0, 0, 1.0]), *rng.normal(size=(50, 4))]:
        rotation = swell.rotation_of(q)
        assert np.allclose(swell.rotation_of(swell.quaternion_of(rotation)), rotation, atol=1e-12)
        assert np.linalg.det(rotation) == pytest.approx(1)


def test_objects_go_where_they_are_told(still):
    camera = swell.Camera.look((0, 0, 4), pitch=-5, size=SIZE)
    pose = still.poses(0.0)[0]
    assert pose.position == pytest.approx((0, 30, 0), abs=1e-9)
    here = still.render(0.0, SIZE, camera=camera, labels=["id"])
    away = still.render(0.0, SIZE, camera=camera, labels=["id"], poses={"red": swell.Pose((0, -300, 0))})
    same = still.render(0.0, SIZE, camera=camera, labels=["id"], poses={0: pose})
    assert (here["id"] == 16).any() and not (away["id"] == 16).any()
    assert here.hash == same.hash != away.hash


def test_picks_say_what_the_labels_say(still):
    camera = swell.Camera.look((0, 0, 4), pitch=-5, size=SIZE)
    places = [(48.5, 32.5), (48.5, 0.5), (5.5, 60.5)]
    picture = still.render(0.0, SIZE, camera=camera, labels=["id", "position", "distance"], picks=places)
    assert [p.what for p in picture.picks] == ["object", "sky", "water"]
    for (x, y), pick in zip(places, picture.picks):
        assert pick.id == picture["id"][int(y), int(x)]
        if pick.what != "sky":
            assert pick.position == pytest.approx(picture["position"][int(y), int(x)], abs=0.05)
            assert pick.distance == pytest.approx(picture["distance"][int(y), int(x)], abs=0.05)
    buoy, _, water = picture.picks
    assert (buoy.object, buoy.kind, water.object, water.kind, water.height) == (0, "buoy", None, None, 0.0)
    assert still.render(0.0, SIZE).picks == []
    with pytest.raises(ValueError):
        still.render(0.0, SIZE, picks=[(np.nan, 0)])


def test_a_lidar_meets_what_is_there(still):
    beams = swell.spinning_beams("vlp-16", 36)
    assert beams.shape == (36, 16, 3) and "vlp-16" in swell.lidars()
    returns = still.lidar(1.0, swell.Pose((0, 0, 3)), beams)
    assert returns.range.shape == (36, 16) and returns.point.shape == (36, 16, 3)
    elevation = np.radians(beams[..., 1])
    with np.errstate(divide="ignore"):
        level = np.where(elevation < -0.0251, -3 / np.sin(elevation), np.inf)  # nearer than 120 m
    assert np.allclose(returns.range[returns.id < 2], level[returns.id < 2], atol=1e-3)
    assert set(np.unique(returns.id)) == {0, 1, 16}
    assert still.classes[returns.klass[returns.id == 16][0]] == "buoy"
    there = returns.id > 0
    assert np.allclose(np.linalg.norm(returns.point[there], axis=-1), returns.range[there], atol=1e-3)
    assert np.isnan(returns.point[~there]).all() and np.isinf(returns.range[~there]).all()
    moved = still.lidar(1.0, swell.Pose((0, 0, 3)), beams, poses={"red": swell.Pose((0, 300, 0))})
    assert not (moved.id == 16).any()
    turned = still.lidar(1.0, swell.Pose((0, 0, 3)), beams, end=swell.Pose((0, 0, 4)), duration=0.1, reach=50.0,
                         range_noise=0.02, seed=2**64 - 1, moments=2)
    assert (turned.intensity <= 1).all() and (turned.incidence <= 90).all()
    grid = swell.grid_beams((8, 4), (80, 40))
    assert grid.shape == (4, 8, 3) and np.allclose(grid[0, 0], (35, 15, 0))


@pytest.mark.parametrize("bad", [dict(t=float("nan")), dict(beams=[0, 0]), dict(beams=[[0, np.inf, 0]]), dict(seed=-1),
                                 dict(moments=0), dict(moments=3), dict(most=-1), dict(reach=np.inf),
                                 dict(end=swell.Pose((0, 0, 0))), dict(pose=swell.Pose((0, 0, np.nan))),
                                 dict(pose=swell.Pose((0, 0, 1), (0, 0, 0, 0)))])
def test_a_lidar_s_faults_are_one_line(still, bad):
    with pytest.raises(ValueError) as raised:
        still.lidar(**{"t": 0.0, "pose": swell.Pose((0, 0, 3)), "beams": [[0, 0, 0]], **bad})
    assert "\n" not in str(raised.value)


def test_disturbances_are_in_the_picture_and_in_the_answers(still):
    drop = swell.Disturbance("drop", position=(0, 30), t=2.0, radius=3.0, height=0.5)
    xy = [[0.0, 30.0], [0.0, 900.0]]
    assert still.height(xy, 2.0, [drop]) == pytest.approx([0.5, 0.0], abs=0.02)
    assert not still.height(xy, 2.0).any()
    assert still.velocity(xy, 2.2, [drop])[0, 2] < 0 and (still.normal(xy, 2.0, [drop])[:, 2] > 0.99).all()
    camera = swell.Camera.look((0, 0, 4), pitch=-8, size=SIZE)
    drawn = still.render(2.0, SIZE, camera=camera, labels=["elevation"], disturbances=[drop], poses={"red": swell.Pose((0, -300, 0))})
    assert 0.3 < np.nanmax(drawn["elevation"]) < 0.51
    hull = swell.Disturbance("hull", path=[(0, -100), (0, 1000)], speed=5.0, path_closed=False)
    wake = still.height([[4, -20], [40, 0]], 20.0, [hull])
    assert abs(wake[0]) > 1e-3 > abs(wake[1])
    for wrong in [swell.Disturbance("whale"), swell.Disturbance("hull"), swell.Disturbance("drop", height=99),
                  swell.Disturbance("drop", radius=0)]:
        with pytest.raises(ValueError):
            still.height(xy, 2.0, [wrong])


def test_the_water_below_the_surface_moves_as_linear_theory_says(windy, still):
    wave = swell.World({**STILL, "sea.sines": [{"amplitude_m": 1.0, "wavelength_m": 60.0, "to_deg": 90.0}]})
    k = 2 * np.pi / 60
    omega = np.sqrt(9.81 * k)
    x = np.linspace(0, 60, 24)
    surface = wave.height(np.stack([x, 0 * x], -1), 3.0).astype(float)
    below = np.array([[1e-6], [2.0], [15.0]])
    xyz = np.stack(np.broadcast_arrays(x, 0 * x, surface - below), -1)
    motion = wave.below(xyz, 3.0)
    decay, phase = np.exp(-k * below), k * x - omega * 3.0
    assert motion.velocity.shape == (3, 24, 3) and motion.place.shape == (3, 24) and motion.place.dtype == np.uint8
    assert (motion.place == swell.IN_WATER).all()
    assert motion.velocity[..., 0] == pytest.approx(omega * decay * np.sin(phase), abs=0.003)
    assert motion.velocity[..., 2] == pytest.approx(-omega * decay * np.cos(phase), abs=0.003)
    assert motion.acceleration[..., 2] == pytest.approx(-omega**2 * decay * np.sin(phase), abs=0.003)
    assert motion.pressure == pytest.approx(1025 * 9.81 * decay * np.sin(phase), abs=30)
    assert wave.below(xyz, 3.0, density=1000).pressure == pytest.approx(motion.pressure / 1.025, rel=1e-5)
    assert wave.below([0, 0, 9], 3.0).place == swell.ABOVE_WATER
    assert wave.below(np.zeros((0, 3)), 0.0).pressure.shape == (0,)
    xy = np.random.default_rng(1).uniform(-200, 200, (300, 2))
    at_surface = windy.below(np.concatenate([xy, windy.height(xy, 4.0)[:, None]], 1), 4.0)
    assert (at_surface.velocity == windy.velocity(xy, 4.0)).all()
    drop = swell.Disturbance("drop", position=(0, 30), t=2.0, radius=3.0, height=0.5)
    assert still.below([0, 30, -1], 2.0, disturbances=[drop]).pressure > 500
    for bad in [[0, 0], [np.nan, 0, 0], [0, 0, np.inf], [0, 0, -1e9]]:
        with pytest.raises(ValueError):
            still.below(bad, 0.0)
    with pytest.raises(ValueError):
        still.below([0, 0, 0], 0.0, density=0)


def test_a_hull_is_pressed_by_what_it_displaces(still):
    corners = np.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4]], float) + [5, 6, -4]
    faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    loads = still.hull_loads(corners, faces, 1.0, about=corners.mean(0))
    assert loads.buoyancy.force == pytest.approx([0, 0, 1025 * 9.81 * 4], abs=0.1)
    assert loads.buoyancy.moment == pytest.approx([0, 0, 0], abs=0.1)
    assert not loads.froude_krylov.force.any() and loads.froude_krylov.moment.shape == (3,)
    assert not still.hull_loads(corners + [0, 0, 9], faces, 1.0).buoyancy.force.any()
    for bad in [[[0, 1, 4]], [[0, 1, -1]], [[0, 1, 1.5]], [[0, 1]], [0, 1, 2]]:
        with pytest.raises(ValueError):
            still.hull_loads(corners, bad, 1.0)


def test_names_are_those_of_the_options(windy):
    assert set(swell.labels()) == set(LABELS)
    assert {"haze", "clouds"} < set(swell.parts())
    assert windy.render(0.0, SIZE, without=["haze"]).hash == windy.render(0.0, SIZE, without="haze").hash


def test_scenes_in_every_form_are_the_same(tmp_path):
    text = "[wind]\nspeed_mps = 7.5\n[[object]]\nkind = \"boat\"\n"
    (tmp_path / "a.toml").write_text(text)
    (tmp_path / "a.json").write_text('{"wind": {"speed_mps": 7.5}, "object": [{"kind": "boat"}]}')
    forms = [swell.World(str(tmp_path / "a.toml")), swell.World(tmp_path / "a.json"), swell.World(text),
             swell.World({"wind.speed_mps": np.float64(7.5), "object": [{"kind": "boat"}]}),
             swell.World("", set={"wind.speed_mps": 7.5, "object[0].kind": "boat"}),
             swell.World(text, set=["wind.speed_mps=3", "wind.speed_mps=7.5"])]
    # The first line of a world's text has its name.
    assert len({world.text.split("\n", 1)[1] for world in forms}) == 1
    assert forms[2].hash == forms[3].hash
    assert swell.World(text, set={"object[0]": None}).objects == []


def test_faults_are_one_line():
    def message(error, call):
        with pytest.raises(error) as raised:
            call()
        text = str(raised.value)
        assert text and "\n" not in text
        return text

    nowhere = message(swell.SceneError, lambda: swell.World("nowhere.toml"))
    assert nowhere.startswith("nowhere.toml: scene file, got 'No such file or directory'")
    printed = subprocess.run([RENDER, "--scene", "nowhere.toml", "--hash"], capture_output=True, text=True)
    assert printed.returncode == 2 and printed.stderr == f"error: {nowhere}\n"
    assert message(swell.SceneError, lambda: swell.World({"wind": {"speed_mps": 99}})) \
        == "scene: wind.speed_mps, got 99, allowed 0 to 60 m/s"
    message(swell.SceneError, lambda: swell.World("[wind"))
    message(TypeError, lambda: swell.World({"wind": {"speed_mps": object()}}))
    world = swell.World(STILL)
    for bad in [dict(size=(0, 5)), dict(size=(9000, 5)), dict(t=float("nan")), dict(labels=["deep"]),
                dict(without="waves"), dict(poses={"red": swell.Pose((0, 0, 0))}),
                dict(poses={5: swell.Pose((0, 0, 0))}), dict(poses={-1: swell.Pose((0, 0, 0))}),
                dict(camera=swell.Camera((0, 0), (1, 0, 0, 0), (9, 9), (4, 4))),
                dict(camera=swell.Camera((0, 0, np.inf), (1, 0, 0, 0), (9, 9), (4, 4)))]:
        message(ValueError, lambda: world.render(**{"size": SIZE, **bad}))
    message(ValueError, lambda: world.height([1.0, 2.0, 3.0], 0.0))
    message(ValueError, lambda: world.height([[np.nan, 2.0]], 0.0))
    message(ValueError, lambda: world.ray((0, 0, 1), (0, 0, 0), 0.0))
    message(ValueError, lambda: world.render(size=SIZE)["depth"])
    message(ValueError, lambda: swell.Camera.from_pose(np.eye(4) * 2, np.eye(3)))
    message(ValueError, lambda: swell.Camera.from_pose(np.eye(3), np.eye(3)))


def test_threads_share_a_world(windy):
    expected = [windy.render(float(k), SIZE).hash for k in range(4)]
    heights = [windy.height([[1.0, 2.0]], float(k))[0] for k in range(4)]
    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(lambda k: windy.render(float(k), SIZE).hash, [0, 1, 2, 3] * 3)) == expected * 3
        assert list(threads.map(lambda k: windy.height([[1.0, 2.0]], float(k))[0], [0, 1, 2, 3] * 3)) == heights * 3


def test_other_threads_run_while_it_draws(windy):
    counts, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counts[0] += 1
            done.wait(0.0005)

    counting = threading.Thread(target=count)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)  # nobody is asked to give the lock away
    counting.start()
    windy.render(1.0, (2000, 1500))
    during = counts[0]
    sys.setswitchinterval(interval)
    done.set()
    counting.join()
    assert during > 5


def test_every_key_is_there():
    names = {(key.table, key.name) for key in swell.keys()}
    assert ("", "wind.speed_mps") in names and ("object", "kind") in names
    assert all(key.meaning and key.allowed for key in swell.keys())


def test_memory_is_used_again(windy):
    def resident_mb():
        return int(next(l for l in open("/proc/self/status") if l.startswith("VmRSS")).split()[1]) / 1024

    def draw(count):
        for k in range(count):
            picture = windy.render(float(k), (320, 240), labels="all")
            picture["position"], picture["distance"]

    draw(10)
    before = resident_mb()
    draw(40)
    for _ in range(10):
        swell.World(STILL).render(size=SIZE)
    assert resident_mb() - before < 60


@pytest.mark.parametrize("example", ["quick_look.py", "boat.py 6", "data_set.py OUT 2"])
def test_examples_run(example, tmp_path):
    script, *arguments = example.split()
    arguments = [str(tmp_path) if a == "OUT" else a for a in arguments]
    if script == "quick_look.py":
        arguments = [str(SOURCE / "scenes/buoys.toml"), str(tmp_path / "figure.png")]
    run = subprocess.run([sys.executable, SOURCE / "examples/python" / script, *arguments], capture_output=True,
                         text=True, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert run.stdout
    if script == "data_set.py":
        sample = np.load(tmp_path / "000001.npz")
        assert sample["rgb"].shape == (180, 320, 3) and sample["id"].max() >= 16


def test_boxes_of_the_data_set_are_those_of_the_ids():
    sys.path.insert(0, str(SOURCE / "examples/python"))
    import data_set
    world = swell.World(data_set.sample_scene(np.random.default_rng([1, 0])))
    ids = world.render(2.0, data_set.SIZE, labels=["id"])["id"]
    for box in data_set.boxes(world, ids):
        x, y, width, height = box["box"]
        mask = ids == box["id"]
        assert mask[y:y + height, x:x + width].sum() == mask.sum() == box["pixels"]
        assert mask[y].any() and mask[y + height - 1].any() and mask[:, x].any() and mask[:, x + width - 1].any()


# ---- a camera on an object that the caller moves ----

MOUNTED = {**STILL, "object": [{**BUOY, "position_m": [5, 30]}],
           "camera": {"mount": "red", "mount_offset_m": [1, 2, 3]}}


def test_a_mounted_camera_goes_where_the_caller_puts_its_object():
    world = swell.World(MOUNTED)
    at = swell.Pose((0, 10, 3))
    assert world.camera(0.0, SIZE, poses={"red": at}).eye == pytest.approx((1, 12, 6))
    assert world.render(0.0, SIZE, poses={"red": at}).camera.eye == pytest.approx((1, 12, 6))
    # Turned by 90 degrees to the left: its right is north, ahead is west.
    turned = swell.Pose((0, 10, 3), (np.sqrt(0.5), 0, 0, np.sqrt(0.5)))
    assert world.camera(0.0, SIZE, poses={"red": turned}).eye == pytest.approx((-2, 11, 6))


def test_the_hull_of_a_mounted_camera_stays_where_it_is_in_the_picture():
    world = swell.World({**MOUNTED, "camera": {"mount": "red", "mount_offset_m": [0, -6, 2]}})
    here = world.render(0.0, SIZE, labels="id")
    there = world.render(0.0, SIZE, labels="id", poses={"red": swell.Pose((40, -25, 0))})
    assert (here["id"] == 16).any() and np.array_equal(here["id"] == 16, there["id"] == 16)


def test_the_motion_label_counts_a_mounted_camera_s_own_motion():
    # Both move alike, so that the hull stays where it is, and the water does not.
    world = swell.World({**MOUNTED, "camera": {"mount": "red", "mount_offset_m": [0, -6, 2]}})
    picture = world.render(0.0, SIZE, labels=["motion", "id"], poses={"red": swell.Pose((0, 0, 0))},
                           next_poses={"red": swell.Pose((1, 0, 0))})
    hull = picture["id"] == 16
    assert hull.any() and np.abs(picture["motion"][hull]).max() < 1e-2
    assert np.abs(picture["motion"][-1][~hull[-1]]).max() > 1.0


# ---- arguments that are none ----

def test_a_size_is_two_whole_numbers(still):
    for size in [(1, 2, 3), (1,), (), (1.5, 2), 7]:
        with pytest.raises(ValueError, match="size, got"):
            still.render(0.0, size)


def test_texts_with_a_nul_are_refused(still):
    with pytest.raises(ValueError, match="NUL"):
        swell.World("scenes/buoys.toml\0.txt")
    with pytest.raises(ValueError, match="NUL"):
        still.render(0.0, SIZE, labels="depth\0,nonsense")
    with pytest.raises(ValueError, match="NUL"):
        swell.World(STILL, set={"sea.douglas\0x": 4})


@pytest.mark.parametrize("xy", [["1", "2"], np.array([["2020-01-01", "2020-01-02"]], dtype="datetime64[D]"),
                                np.array([[1j, 2.0]]), [None, 1.0]])
def test_what_is_no_number_is_no_place(still, xy):
    with pytest.raises(TypeError, match="xy, got"):
        still.height(xy, 0.0)


def test_a_pose_is_a_pose(still):
    with pytest.raises(TypeError, match="poses, got tuple, allowed swell.Pose"):
        still.render(0.0, SIZE, poses={"red": ((0, 0, 0), (1, 0, 0, 0))})


@pytest.mark.parametrize("kind", ["World", "Picture"])
def test_an_object_without_init_is_no_object(kind):
    made = getattr(swell._swell, kind)
    with pytest.raises(TypeError, match="__init__"):
        made.__new__(made).hash()


def test_many_views_of_one_time_are_what_each_is_alone(windy):
    cameras = [swell.Camera.look((10.0 * k, 0.0, 5.0 + k), heading=15.0 * k, size=SIZE) for k in range(5)]
    pictures = windy.render_many(2.0, cameras, SIZE, labels=["id", "depth"], without="haze")
    assert len(pictures) == 5 and windy.render_many(2.0, [], SIZE) == []
    for camera, picture in zip(cameras, pictures):
        alone = windy.render(2.0, SIZE, camera=camera, labels=["id", "depth"], without="haze")
        assert picture.hash == alone.hash and picture.t == 2.0
        assert np.array_equal(picture["id"], alone["id"]) and np.array_equal(picture["depth"], alone["depth"])
    with pytest.raises(TypeError, match="camera, got str, allowed swell.Camera"):
        windy.render_many(2.0, ["north"], SIZE)
    with pytest.raises(ValueError, match="t_s, got nan"):
        windy.render_many(float("nan"), cameras, SIZE)


def test_several_cameras_may_have_their_own_distortion(windy):
    plain = swell.Camera.look((0.0, 0.0, 6.0), size=SIZE)
    bent = replace(plain, distortion=(-0.1, 0.01, 0.0, 0.0, 0.0))
    first, second = windy.render_many(1.0, [plain, bent], SIZE)
    assert np.array_equal(first.rgb, windy.render(1.0, SIZE, camera=plain).rgb)
    assert np.array_equal(second.rgb, windy.render(1.0, SIZE, camera=bent).rgb)


def test_worlds_are_made_of_what_others_kept(tmp_path):
    worlds = [swell.World({"wind.speed_mps": 9}, cache=tmp_path) for _ in range(2)]
    assert list(tmp_path.glob("*.part"))
    assert worlds[0].render(1.0, SIZE).hash == worlds[1].render(1.0, SIZE).hash
