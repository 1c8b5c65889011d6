"""Swell draws the sea on CPUs, with labels, and answers what it is like at any place and time.

    import swell
    world = swell.World("scenes/buoys.toml", set={"sea.douglas": 4})
    picture = world.render(t=5.0, size=(1280, 720), labels=["depth", "id"])
    picture.rgb                         # (720, 1280, 3) uint8
    picture["depth"]                    # (720, 1280) float32, metres
    world.height([[0.0, 50.0]], t=5.0)  # [metres over the mean sea level]

World x is east, y north, z up; metres and seconds; docs/look_up/conventions.md has the rest. The same scene, time and camera
give the same bits with any number of threads, on any machine. A fault raises SceneError (the scene), or ValueError (an
argument), with one line that says what was given and what is allowed.
"""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from operator import index
from typing import Any, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _swell
from ._swell import SceneError
from .below import ABOVE_WATER, IN_GROUND, IN_WATER, HullLoads, Load, Motion, triangles_of
from .camera import Camera, quaternion_of, rotation_of
from .checks import Size, instance, number, numbers, points, size_of, vector
from .disturbance import Disturbance
from .distortion import DistortedPicture, Lookup
from .lidar import Returns, grid_beams, lidars, spinning_beams

__all__ = ["ABOVE_WATER", "Camera", "DistortedPicture", "Disturbance", "Hit", "HullLoads", "IN_GROUND", "IN_WATER",
           "Key", "Load", "Motion", "Object", "Pick", "Picture", "Pose", "Returns", "SceneError", "Size", "World",
           "grid_beams", "keys", "labels", "lidars", "parts", "quaternion_of", "rotation_of", "spinning_beams",
           "__version__"]
__version__ = _swell.version()


@dataclass(frozen=True)
class Key:
    """A key of scene files (docs/look_up/scene.md)."""

    table: str
    """Empty, or the tables [[...]] that have it."""
    name: str
    unit: str
    allowed: str
    meaning: str


def keys() -> List[Key]:
    """Every key of scene files."""
    return [Key(*key) for key in _swell.keys()]


def labels() -> List[str]:
    """The names of the labels (docs/look_up/labels.md)."""
    return _swell.labels()


def parts() -> List[str]:
    """The names of the parts that a picture can be drawn without."""
    return _swell.parts()


@dataclass(frozen=True)
class Object:
    """An object of a scene."""

    id: int
    """In the label "id"."""
    klass: int
    """In the label "class"."""
    name: str
    class_name: str
    kind: str


@dataclass(frozen=True)
class Pose:
    """Where an object is. Its axes are right, ahead and up; its origin lies on its vertical axis at the waterline."""

    position: Tuple[float, ...]
    """Metres: east, north, up."""
    quaternion: Tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)
    """(w, x, y, z): turns its axes into the world."""

    @staticmethod
    def of(position: Sequence[float], rotation: npt.ArrayLike) -> Pose:
        """A pose of a rotation matrix (3, 3), whose columns are right, ahead and up."""
        return Pose(tuple(position), quaternion_of(rotation))

    @property
    def rotation(self) -> np.ndarray:
        """The rotation matrix (3, 3)."""
        return rotation_of(self.quaternion)


@dataclass(frozen=True)
class Hit:
    """Where a ray passes the water."""

    position: Tuple[float, ...]
    distance: float
    from_above: bool


@dataclass(frozen=True)
class Pick:
    """What a point of a picture shows."""

    what: str
    """"sky", "water", "land" or "object"; the rest is 0 or None for the sky."""
    position: Tuple[float, ...]
    """Metres, on the drawn triangle."""
    distance: float
    """From the eye, metres."""
    id: int
    """In the label "id"."""
    object: Optional[int]
    """The index of an object in World.objects."""
    kind: Optional[str]
    """Of an object: "buoy", "boat", ..."""
    height: float
    """There, metres: of the ground if land is shown, else of the water."""


Poses = Mapping[Union[int, str], Pose]
"""Poses by the index or the name of their objects."""


class Picture:
    """A drawn picture. Its arrays share its memory, which lives as long as one of them does."""

    def __init__(self, drawn: _swell.Picture, t: float, picks: Sequence[Pick] = ()):
        self._drawn = drawn
        self.t = t
        """Its time in seconds."""
        self.picks = list(picks)
        """What the points of render(picks=...) show, in their order."""

    @property
    def rgba(self) -> npt.NDArray[np.uint8]:
        """(height, width, 4) uint8: sRGB, rows from the top; alpha is 255."""
        return self._drawn.plane("rgba")

    @property
    def rgb(self) -> npt.NDArray[np.uint8]:
        """(height, width, 3) uint8: sRGB; a view of rgba."""
        return self.rgba[..., :3]

    @property
    def linear(self) -> npt.NDArray[np.float32]:
        """(height, width, 3) float32: linear light before the tone curve, of render(linear=True)."""
        return self._drawn.plane("linear")

    def __getitem__(self, label: str) -> np.ndarray:
        """A label that was asked for (docs/look_up/labels.md has their meaning): an array (height, width, ...).

        depth, distance, elevation: float32, metres
        foam: float32, in [0, 1]
        normal, geometric_normal: float32, (..., 3)
        motion: float32, (..., 2), pixels
        position: float64, (..., 3), metres
        id, class: uint32
        flags: uint8
        """
        return self._drawn.plane(label)

    @property
    def hash(self) -> str:
        """16 hex digits: what swell-render --hash prints of the same picture."""
        return f"{self._drawn.hash():016x}"

    @property
    def camera(self) -> Camera:
        """The camera that it was drawn with."""
        return Camera._of(self._drawn.camera())


class World:
    """A scene made ready to draw and to ask. Any number of threads may use one; none waits for another."""

    def __init__(self, scene: Union[str, os.PathLike, Mapping[str, Any]] = "", *,
                 set: Union[Mapping[str, Any], Iterable[str]] = (),
                 folder: Union[str, os.PathLike, None] = None, threads: int = 0,
                 cache: Union[str, os.PathLike, None] = None):
        """Makes a world, in 0.1 s to some seconds.

        scene: the path of a scene file; its text, TOML or JSON, which is known by a line break, an '=' or a '{'; or the
        same as a dict: {"wind": {"speed_mps": 12}}, or {"wind.speed_mps": 12}.
        set: values for other keys, {"wind.speed_mps": 12, "object[0].name": "red"} or ["wind.speed_mps=12"], as
        swell-render --set has them; None leaves a key out.
        folder: relative paths of a text or a dict are relative to it.
        threads: that a picture is drawn with, 0: all that the process may use. They change no bit.
        cache: a folder where parts of worlds are kept for later processes, which make the same world in a fraction of
        the time; 2 GB at most.
        """
        path = text = None
        if isinstance(scene, Mapping):
            text = json.dumps(scene, default=_plain)
        elif isinstance(scene, str) and (scene == "" or any(mark in scene for mark in "\n={")):
            text = scene
        else:
            path = os.fspath(scene)
        settings = [_setting(*item) for item in set.items()] if isinstance(set, Mapping) else list(set)
        self._world = _swell.World(path, text, None if folder is None else os.fspath(folder), settings, threads,
                                   None if cache is None else os.fspath(cache))

    @property
    def text(self) -> str:
        """The scene as TOML with every value written out."""
        return self._world.text()

    @property
    def hash(self) -> str:
        """16 hex digits: XXH3-64 of `text`."""
        return f"{self._world.hash():016x}"

    @property
    def objects(self) -> List[Object]:
        """The objects of the scene, in its order."""
        return [Object(*o) for o in self._world.objects()]

    @property
    def classes(self) -> List[str]:
        """The name of each class of the label "class"."""
        return self._world.classes()

    def camera(self, t: float = 0.0, size: Size = (1280, 720), *, poses: Poses = {},
               disturbances: Iterable[Disturbance] = ()) -> Camera:
        """The scene's own camera at a time, as render() has it with these poses and disturbances.

        A camera that is mounted on an object goes with it where the poses put that.
        """
        return Camera._of(self._world.camera(number(t, "t"), *size_of(size), self._poses(poses), _tuples(disturbances)))

    def render(self, t: float = 0.0, size: Size = (1280, 720), *, camera: Optional[Camera] = None,
               labels: Union[str, Iterable[str]] = (), linear: bool = False, poses: Poses = {},
               next_frame: float = 1.0 / 60.0, next_camera: Optional[Camera] = None, next_poses: Poses = {},
               without: Union[str, Iterable[str]] = (), water_triangles: int = 0, terrain_triangles: int = 0,
               lookup_scale: float = 0.0, edge_samples: Optional[int] = None,
               disturbances: Iterable[Disturbance] = (), picks: npt.ArrayLike = ()) -> Union[Picture, DistortedPicture]:
        """Draws the world at time t (seconds).

        size: (width, height) in pixels, each in 1 to 8192.
        camera: instead of the scene's own, which goes with the object that it is mounted on, also where `poses` put
        that. Of one with a distortion the picture is a DistortedPicture: a larger one is drawn and looked up anew, which
        takes some 0.1 s at 1280 x 720.
        labels: names of docs/look_up/labels.md, such as ["depth", "id"], or "all".
        linear: keeps linear light as well; shades every pixel for it, as with picture.shading = "full".
        poses: objects that are elsewhere in this picture, by index or name.
        next_frame, next_camera, next_poses: of the next picture, for the label of motion; next_frame in seconds.
        without: parts to leave out, as swell-render --without has them.
        water_triangles, terrain_triangles, lookup_scale, edge_samples (0, 4, 8): instead of the scene's.
        disturbances: what disturbs the water besides the scene's own.
        picks: points of the picture [n, 2] in pixels, whose Picture.picks say what is there; pixel (i, j) has its middle
        at (i + 0.5, j + 0.5). Not with a distortion.
        """
        size = size_of(size)
        disturbances = list(disturbances)
        places = numbers(picks, "picks").reshape(-1, 2)
        for name, given in [("camera", camera), ("next_camera", next_camera)]:
            if given is not None:
                instance(given, Camera, name)
        if camera is not None and any(camera.distortion):
            if len(places):
                raise ValueError("picks, got points of a camera with a distortion, allowed without")
            lookup = Lookup(camera, size)
            wide = self.render(t, lookup.size, camera=lookup.camera, labels=labels, linear=linear, poses=poses,
                               without=without, water_triangles=water_triangles, terrain_triangles=terrain_triangles,
                               lookup_scale=lookup_scale, edge_samples=edge_samples, disturbances=disturbances)
            return DistortedPicture(wide, lookup, camera)
        drawn = self._world.render(
            t=number(t, "t"), width=size[0], height=size[1], labels=_names(labels), without=_names(without), linear=linear,
            camera=camera._tuple() if camera else None,
            next_camera=next_camera._tuple() if next_camera else None, next_frame_s=number(next_frame, "next_frame"),
            poses=self._poses(poses), next_poses=self._poses(next_poses), water_triangles=water_triangles,
            terrain_triangles=terrain_triangles, lookup_scale=number(lookup_scale, "lookup_scale"),
            edge_samples=0 if edge_samples is None else edge_samples or 1,
            disturbances=_tuples(disturbances), picks=places)
        return Picture(drawn, t, self._picks(drawn.picks()) if len(places) else ())

    def render_many(self, t: float, cameras: Iterable[Camera], size: Size = (1280, 720), *,
                    labels: Union[str, Iterable[str]] = (), linear: bool = False, poses: Poses = {},
                    without: Union[str, Iterable[str]] = (), water_triangles: int = 0, terrain_triangles: int = 0,
                    lookup_scale: float = 0.0, edge_samples: Optional[int] = None,
                    disturbances: Iterable[Disturbance] = ()) -> List[Union[Picture, DistortedPicture]]:
        """Draws the world at time t (seconds) as several cameras see it: the pictures of render(t, size, camera=...).

        They share the sea, and each is drawn by one thread where there are enough: for many small ones. The rest is as
        in render().
        """
        size = size_of(size)
        cameras = [instance(camera, Camera, "camera") for camera in cameras]
        lookups = [Lookup(camera, size) if any(camera.distortion) else None for camera in cameras]
        drawn = self._world.render_many(
            t=number(t, "t"), sizes=[lookup.size if lookup else size for lookup in lookups],
            cameras=[(lookup.camera if lookup else camera)._tuple() for camera, lookup in zip(cameras, lookups)],
            labels=_names(labels), without=_names(without), linear=linear, poses=self._poses(poses),
            water_triangles=water_triangles, terrain_triangles=terrain_triangles,
            lookup_scale=number(lookup_scale, "lookup_scale"),
            edge_samples=0 if edge_samples is None else edge_samples or 1, disturbances=_tuples(disturbances))
        pictures = [Picture(picture, t) for picture in drawn]
        return [DistortedPicture(picture, lookup, camera) if lookup else picture
                for picture, camera, lookup in zip(pictures, cameras, lookups)]

    def height(self, xy: npt.ArrayLike, t: float,
               disturbances: Iterable[Disturbance] = ()) -> npt.NDArray[np.float32]:
        """Height of the drawn water over the mean sea level in metres at points xy [..., 2] (east, north): [...]."""
        return self._ask("height", xy, t, disturbances)

    def slope(self, xy: npt.ArrayLike, t: float,
              disturbances: Iterable[Disturbance] = ()) -> npt.NDArray[np.float32]:
        """dz/dx and dz/dy of the water: [..., 2]."""
        return self._ask("slope", xy, t, disturbances)

    def normal(self, xy: npt.ArrayLike, t: float,
               disturbances: Iterable[Disturbance] = ()) -> npt.NDArray[np.float32]:
        """Unit normals of the water: [..., 3]."""
        return self._ask("normal", xy, t, disturbances)

    def velocity(self, xy: npt.ArrayLike, t: float,
                 disturbances: Iterable[Disturbance] = ()) -> npt.NDArray[np.float32]:
        """Velocity of the water at the surface in m/s, east, north, up: [..., 3]."""
        return self._ask("velocity", xy, t, disturbances)

    def below(self, xyz: npt.ArrayLike, t: float, density: float = 1025.0,
              disturbances: Iterable[Disturbance] = ()) -> Motion:
        """How the water moves at points xyz [..., 3] (east, north, up) on and below the surface.

        Linear theory, each wave with its own decay, which begins at the surface under crests and troughs alike
        (Wheeler, 1970); at the surface the velocity is that of velocity(). density: of the water, 1 to 1e5 kg/m3.
        """
        return Motion(*self._world.below(numbers(xyz, "xyz"), number(t, "t"), _density(density), _tuples(disturbances)))

    def hull_loads(self, xyz: npt.ArrayLike, triangles: npt.ArrayLike, t: float,
                   about: Sequence[float] = (0.0, 0.0, 0.0), density: float = 1025.0,
                   disturbances: Iterable[Disturbance] = ()) -> HullLoads:
        """Forces on what of a hull is under the surface, which cuts its triangles, and their moments about a point.

        xyz: corners (n, 3) in the world, metres. triangles (m, 3): indices of a closed hull, counter-clockwise as seen
        from outside, with edges short against the waves (a tenth of a wavelength: 1 %). Both loads together are what
        undisturbed waves press.
        """
        corners = points(xyz, "xyz", 3)
        loads = self._world.hull_loads(corners, triangles_of(triangles, len(corners)), number(t, "t"),
                                       vector(about, 3, "about"), _density(density), _tuples(disturbances))
        return HullLoads(*(Load(np.array(force), np.array(moment)) for force, moment in (loads[:2], loads[2:])))

    def foam(self, xy: npt.ArrayLike, t: float) -> npt.NDArray[np.float32]:
        """The part of the surface that whitecaps and surf of wave trains hide, in [0, 1]: [...]."""
        return self._ask("foam", xy, t)

    def still_depth(self, xy: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Depth of the ground under the mean sea level in metres: [...]; below 0 on land, infinite without terrain."""
        return self._ask("still_depth", xy, 0.0)

    def poses(self, t: float) -> List[Pose]:
        """Where the scene and the water have its objects at a time, in its order."""
        return [Pose(tuple(position), tuple(quaternion)) for _, position, quaternion in self._world.poses(number(t, "t"))]

    def ray(self, origin: Sequence[float], direction: Sequence[float], t: float,
            max_distance: float = 1e5) -> Optional[Hit]:
        """The first place where a ray passes the water at most max_distance metres away; None: it does not."""
        hit = self._world.ray(number(t, "t"), vector(origin, 3, "origin"), vector(direction, 3, "direction"),
                              number(max_distance, "max_distance"))
        return None if hit is None else Hit(tuple(hit[0]), hit[1], hit[2])

    def lidar(self, t: float, pose: Pose, beams: npt.ArrayLike, *, end: Optional[Pose] = None, duration: float = 0.0,
              moments: int = 1, least: float = 0.0, most: float = 120.0, reach: float = 0.0, range_noise: float = 0.0,
              seed: int = 1, poses: Poses = {}, disturbances: Iterable[Disturbance] = ()) -> Returns:
        """What the beams of a lidar get back at time t (seconds), of the surfaces that queries answer for.

        Waves, land, trees with all leaves, forms and objects are met within 1 mm at 100 m, in a flat world.

        pose: of the sensor, whose axes are those of REP 103: x ahead, y left, z up.
        beams: [..., 3], of each the azimuth from x towards y and the elevation from there towards z in degrees, and when it
        leaves, in seconds after t: spinning_beams(), grid_beams() or any list.
        end, duration: where the sensor is so many seconds after t; beams leave from between both (a rolling shutter).
        moments: in 1 to 64, at which the world stands still in the duration; 1: at t.
        least, most: ranges in metres that it tells, up to 1e5.
        reach: how far, in metres, a surface of reflectance 0.1 that is met squarely is seen half of the time; what sends back
        less, such as clear water but straight down, is lost sooner. 0: each beam that meets something has a return.
        range_noise: standard deviation in metres, up to 10.
        seed: of noise and losses, which follow from it, the number of the beam and t alone.
        poses, disturbances: as in render().
        """
        instance(pose, Pose, "pose")
        if end is not None:
            instance(end, Pose, "end")
        if not 0 <= index(seed) < 2**64:
            raise ValueError(f"seed, got {seed}, allowed 0 to 2^64 - 1")
        if not 1 <= index(moments) <= 64:
            raise ValueError(f"moments, got {moments}, allowed 1 to 64")
        if end is not None and not number(duration, "duration") > 0.0:
            raise ValueError(f"duration, got {duration} with an end, allowed over 0")
        return Returns(**self._world.scan(
            numbers(beams, "beams"), number(t, "t"), _sensor(pose), _sensor(end) if end else None,
            number(duration, "duration"), moments, (number(least, "least"), number(most, "most")), number(reach, "reach"),
            number(range_noise, "range_noise"), seed, self._poses(poses), _tuples(disturbances)))

    def _ask(self, what: str, xy: npt.ArrayLike, t: float,
             disturbances: Iterable[Disturbance] = ()) -> npt.NDArray[np.float32]:
        return self._world.ask(numbers(xy, "xy"), number(t, "t"), what, _tuples(disturbances))

    def _picks(self, found) -> List[Pick]:
        objects = self.objects
        picks = []
        for what, position, distance, index, id, height in found:
            shown = objects[index] if what == 3 else None
            picks.append(Pick(("sky", "water", "land", "object")[what], tuple(position), distance, id,
                              index if shown else None, shown.kind if shown else None, height))
        return picks

    def _poses(self, poses: Poses):
        if not isinstance(poses, Mapping):
            raise TypeError(f"poses, got {type(poses).__name__}, allowed a dict of swell.Pose")
        if not poses:
            return []
        names = {o.name: n for n, o in enumerate(self.objects) if o.name}
        indices = []
        for key in poses:
            if isinstance(key, str) and key not in names:
                raise ValueError(f"poses, got '{key}', allowed {', '.join(names) or 'indices: no object has a name'}")
            indices.append(names[key] if isinstance(key, str) else int(key))
        if any(index < 0 for index in indices):
            raise ValueError(f"poses, got object {min(indices)}, allowed 0 to {len(self.objects) - 1}")
        given = [instance(pose, Pose, "poses") for pose in poses.values()]
        return [(n, vector(p.position, 3, "pose's position"), vector(p.quaternion, 4, "pose's quaternion"))
                for n, p in zip(indices, given)]


def _sensor(pose: Pose):
    return 0, vector(pose.position, 3, "pose's position"), vector(pose.quaternion, 4, "pose's quaternion")


def _tuples(disturbances: Iterable[Disturbance]):
    return [instance(d, Disturbance, "disturbances")._tuple() for d in disturbances]


def _density(density: float) -> float:
    """0 stands for the default in the C interface."""
    if density == 0.0:
        raise ValueError("density, got 0, allowed 1 to 100000")
    return number(density, "density")


def _names(names: Union[str, Iterable[str]]) -> str:
    return names if isinstance(names, str) else ",".join(names)


def _plain(value: Any) -> Any:
    """What JSON knows of a NumPy value."""
    if isinstance(value, (np.ndarray, np.generic)) and value.dtype.kind in "Mm":
        raise TypeError(f"a scene's value, got {value.dtype}, allowed numbers, text, booleans, lists, dicts")
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a scene's value, got {type(value).__name__}, allowed numbers, text, booleans, lists, dicts")


def _setting(key: str, value: Any) -> str:
    return f"{key}=" if value is None else f"{key}={json.dumps(value, default=_plain)}"
