"""Wide cameras and noise in Python."""

from dataclasses import replace

import numpy as np
import pytest

import swell

SMALL = {"sky": {"zenith": [0.1, 0.2, 0.4], "horizon": [0.5, 0.6, 0.7]}, "detail": {"water_triangles": 500}}
BUOY = {"kind": "buoy", "name": "red", "position_m": [0, 30]}
SIZE = (128, 96)
LENS = (0.03, -0.004, 0.0005, 0.0)


@pytest.fixture(scope="module")
def still():
    return swell.World({**SMALL, "sea": {"spectrum": False}, "object": [BUOY]})


def cameras():
    return [swell.Camera.fisheye((0, 0, 4), heading=20, pitch=-10, roll=5, fov=200, size=SIZE, k=LENS),
            swell.Camera.fisheye((0, 0, 4), pitch=-90, size=SIZE), swell.Camera.equirectangular((0, 0, 4), heading=40)]


@pytest.mark.parametrize("camera", cameras(), ids=lambda camera: camera.projection)
def test_places_are_where_the_projection_shows_them(still, camera):
    picture = still.render(0.0, SIZE, camera=camera, labels=["position", "depth", "distance"])
    seen = np.isfinite(picture["depth"])
    rows, columns = np.nonzero(seen)
    xyd = camera.project(picture["position"][seen], SIZE)
    assert seen.sum() > 500
    assert np.abs(xyd[:, 0] - columns - 0.5).max() < 1e-3 and np.abs(xyd[:, 1] - rows - 0.5).max() < 1e-3
    assert np.allclose(xyd[:, 2], picture["depth"][seen], rtol=1e-5)
    assert np.array_equal(picture["depth"], picture["distance"])
    drawn = picture.camera
    assert (drawn.projection, drawn.fisheye_k) == (camera.projection, camera.fisheye_k)
    assert np.allclose(drawn.focal, camera.focal) and drawn.fisheye_fov == pytest.approx(camera.fisheye_fov)


def test_a_fisheye_is_opencvs():
    camera = replace(cameras()[0], eye=(0, 0, 0), quaternion=(1, 0, 0, 0))
    a, b = 0.7, -0.4
    r = np.hypot(a, b)
    t = np.arctan(r)
    bent = t * (1 + LENS[0] * t**2 + LENS[1] * t**4 + LENS[2] * t**6)
    x, y, distance = camera.project([a, b, 1.0])
    assert x == pytest.approx(camera.focal[0] * bent / r * a + camera.principal[0])
    assert y == pytest.approx(camera.focal[1] * bent / r * b + camera.principal[1])
    assert distance == pytest.approx(np.sqrt(1 + r * r))
    assert np.isnan(camera.project([0.0, 0.1, -1.0])[:2]).all()


def test_wide_views_among_others_are_what_each_is_alone(still):
    views = [*cameras(), swell.Camera.look((0, 0, 4), size=SIZE)]
    for camera, picture in zip(views, still.render_many(1.0, views, SIZE, labels="id")):
        alone = still.render(1.0, SIZE, camera=camera, labels="id")
        assert picture.hash == alone.hash and np.array_equal(picture["id"], alone["id"])


def test_the_scenes_camera_may_be_wide(still):
    scene = {**SMALL, "camera": {"projection": "fisheye", "fisheye_fov_deg": 190, "pitch_deg": 60}}
    world = swell.World(scene)
    camera = world.camera(0.0, SIZE)
    assert camera.projection == "fisheye" and camera.fisheye_fov == pytest.approx(190)
    assert camera.focal[0] == pytest.approx(48 / np.radians(95))
    picture = world.render(0.0, SIZE)
    assert not picture.rgb[0, 0].any() and picture.rgb[48, 64].any()
    assert picture.hash == world.render(0.0, SIZE, camera=camera).hash


def test_faults_are_one_line(still):
    fish = cameras()[0]
    for camera, words in [(replace(fish, projection="fish"), "camera.projection, got 'fish'"),
                          (replace(fish, fisheye_k=(-1, 0, 0, 0)), "camera.fisheye_k, got"),
                          (replace(fish, fisheye_fov=400.0), "camera.fisheye_fov_deg, got 400"),
                          (replace(fish, focal=(0.0, 0.0)), "camera.focal_px, got 0"),
                          (replace(fish, distortion=(0.1, 0, 0, 0, 0)), "camera.distortion, got one of a camera")]:
        with pytest.raises(ValueError, match=words):
            still.render(0.0, SIZE, camera=camera)
    with pytest.raises(ValueError, match="whose last frame is wide"):
        still.render(0.0, SIZE, camera=fish, picks=[(1, 1)])


def test_noise_has_the_models_variance_and_a_seed():
    noise = {"full_well_e": 8000, "iso": 400, "read_noise_e": 5, "noise_seed": 3}
    camera = {"pitch_deg": 60, "fov_y_deg": 20}
    clean, noisy, other = (swell.World({**SMALL, "camera": {**camera, **more}}).render(0.0, SIZE, linear=True)
                           for more in ({}, noise, {**noise, "noise_seed": 4}))
    assert not np.array_equal(noisy.linear, other.linear)
    off = noisy.linear.astype(float) - clean.linear
    # Exposed light; the sky's is even, and electrons are 1000 / 4 of light 1.
    exposure = swell_exposure(clean)
    electrons = clean.linear * exposure * 250.0
    expected = (electrons + 25.0) / (250.0 * exposure) ** 2
    assert (off**2).mean() == pytest.approx(expected.mean(), rel=0.03)
    assert abs(off.mean()) < 4 * np.sqrt(expected.mean() / off.size)


def swell_exposure(picture):
    """What linear light is multiplied by, from dark pixels, where the tone curve is straight."""
    srgb = picture.rgb.astype(float) / 255
    shown = np.where(srgb < 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    dark = (shown < 0.39) & (shown > 0.05)
    return float(np.median(shown[dark] / picture.linear[dark]))
