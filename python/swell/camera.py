"""Cameras: where they are, where they look, what they see."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _swell
from .checks import Size, matrix, number, numbers, size_of, vector


def quaternion_of(rotation: npt.ArrayLike) -> Tuple[float, ...]:
    """The quaternion (w, x, y, z), w >= 0, of a rotation matrix (3, 3)."""
    r = matrix(rotation, (3, 3), "rotation")
    if not (np.allclose(r @ r.T, np.eye(3), atol=1e-6) and np.linalg.det(r) > 0.0):
        raise ValueError("rotation, got a matrix that is none, allowed unit axes at right angles, "
                         "right-handed, to within 1e-6")
    # Bar-Itzhack: the eigenvector of the largest eigenvalue, which no rotation makes ill-conditioned.
    k = np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[2, 1] - r[1, 2]],
        [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1], r[0, 2] - r[2, 0]],
        [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)],
    ])
    x, y, z, w = np.linalg.eigh(k)[1][:, -1].tolist()
    sign = -1.0 if w < 0.0 else 1.0
    return (sign * w, sign * x, sign * y, sign * z)


def rotation_of(quaternion: npt.ArrayLike) -> np.ndarray:
    """The rotation matrix (3, 3) of a quaternion (w, x, y, z) of any length over 0."""
    q = np.array(vector(quaternion, 4, "quaternion"))
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


PROJECTIONS = ("perspective", "fisheye", "equirectangular")


@dataclass(frozen=True)
class Camera:
    """A camera: a pinhole one, a fisheye, or one that sees all directions.

    Its frame is the optical one of robotics: x to the right of the picture, y down, z ahead. The world has x east,
    y north, z up. Pixels count from the picture's upper left corner: the first one's centre is (0.5, 0.5).
    """

    eye: Tuple[float, ...]
    """Where it is in metres: east, north, up."""
    quaternion: Tuple[float, ...]
    """(w, x, y, z): turns the optical frame into the world."""
    focal: Tuple[float, ...]
    """fx and fy in pixels; 0 of equirectangular cameras, as principal."""
    principal: Tuple[float, ...]
    """cx and cy in pixels: 0.5 more than OpenCV's, which count from the first pixel's centre."""
    near: float = 0.25
    """Nearer things are cut off; metres along the view axis, of wide cameras along that of a cube's face."""
    distortion: Tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0)
    """(k1, k2, p1, p2, k3) of Brown and Conrady's lens, as OpenCV has them; of perspective cameras."""
    projection: str = "perspective"
    """Or "fisheye" (Kannala and Brandt's lens), or "equirectangular": longitude across, from straight back on to the
    right, and latitude down. In wide pictures labels are those of the nearest pixel that was drawn for them, and
    the label "depth" is the distance."""
    fisheye_k: Tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)
    """(k1, k2, k3, k4) of a fisheye, as OpenCV has them."""
    fisheye_fov: float = 180.0
    """Degrees: the full angle of the cone that a fisheye shows; black outside."""

    @staticmethod
    def look(eye: Sequence[float], heading: float = 0.0, pitch: float = 0.0, roll: float = 0.0,
             fov_y: float = 50.0, size: Size = (1280, 720)) -> Camera:
        """A camera that looks along a heading (degrees clockwise from north) and a pitch (degrees up).

        roll (degrees) lowers its right side; fov_y (degrees) spans a picture of `size` from top to bottom.
        """
        angles = [number(angle, name) for name, angle in
                  [("heading", heading), ("pitch", pitch), ("roll", roll), ("fov_y", fov_y)]]
        return Camera._of(_swell.look(vector(eye, 3, "eye"), *angles, *size_of(size)))

    @staticmethod
    def fisheye(eye: Sequence[float], heading: float = 0.0, pitch: float = 0.0, roll: float = 0.0, fov: float = 180.0,
                size: Size = (720, 720), k: Sequence[float] = (0.0, 0.0, 0.0, 0.0)) -> Camera:
        """A fisheye that looks as look() does; its cone of fov degrees touches the nearer edges of a picture of size."""
        camera = Camera.look(eye, heading, pitch, roll, size=size)
        camera = replace(camera, projection="fisheye", fisheye_k=vector(k, 4, "k"), fisheye_fov=number(fov, "fov"))
        focal = 0.5 * min(size_of(size)) / camera._bent(np.radians(0.5 * camera.fisheye_fov))
        return replace(camera, focal=(float(focal), float(focal)))

    @staticmethod
    def equirectangular(eye: Sequence[float], heading: float = 0.0, pitch: float = 0.0, roll: float = 0.0) -> Camera:
        """A camera of all directions, whose pictures have what look() looks at in the middle."""
        return replace(Camera.look(eye, heading, pitch, roll), focal=(0.0, 0.0), principal=(0.0, 0.0),
                       projection="equirectangular")

    @staticmethod
    def _of(camera: Tuple) -> Camera:
        eye, quaternion, focal, principal, near, projection, fisheye_k, fov = camera
        return Camera(tuple(eye), tuple(quaternion), tuple(focal), tuple(principal), near,
                      projection=PROJECTIONS[projection], fisheye_k=tuple(fisheye_k), fisheye_fov=fov or 180.0)

    @staticmethod
    def from_pose(world_from_optical: npt.ArrayLike, K: npt.ArrayLike, near: float = 0.25) -> Camera:
        """A camera from its pose, a matrix (4, 4) that takes optical points to the world, and its matrix K (3, 3)."""
        pose = matrix(world_from_optical, (4, 4), "world_from_optical")
        k = matrix(K, (3, 3), "K")
        if k[0, 1] != 0.0 or k[1, 0] != 0.0 or tuple(k[2]) != (0.0, 0.0, 1.0):
            raise ValueError("K, got one with skew or another last row, allowed [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")
        return Camera(tuple(pose[:3, 3].tolist()), quaternion_of(pose[:3, :3]),
                      (float(k[0, 0]), float(k[1, 1])), (float(k[0, 2]), float(k[1, 2])), near)

    @staticmethod
    def from_opencv(K: npt.ArrayLike, R: npt.ArrayLike, t: npt.ArrayLike, near: float = 0.25,
                    distortion: npt.ArrayLike = (0.0,) * 5) -> Camera:
        """A camera from OpenCV's K (3, 3), whose cx and cy count from the first pixel's centre, and extrinsics.

        A world point X has the optical coordinates R X + t; R is (3, 3), t is (3,); distortion is (k1, k2, p1, p2, k3).
        """
        rotation = matrix(R, (3, 3), "R")
        pose = np.eye(4)
        pose[:3, :3] = rotation.T
        pose[:3, 3] = -rotation.T @ np.array(vector(t, 3, "t"))
        camera = Camera.from_pose(pose, K, near)
        return replace(camera, principal=(camera.principal[0] + 0.5, camera.principal[1] + 0.5),
                       distortion=vector(distortion, 5, "distortion"))

    @property
    def K(self) -> np.ndarray:
        """The camera matrix (3, 3) in pixels from the picture's upper left corner."""
        return np.array([[self.focal[0], 0.0, self.principal[0]], [0.0, self.focal[1], self.principal[1]],
                         [0.0, 0.0, 1.0]])

    @property
    def world_from_optical(self) -> np.ndarray:
        """The pose (4, 4)."""
        pose = np.eye(4)
        pose[:3, :3] = rotation_of(self.quaternion)
        pose[:3, 3] = self.eye
        return pose

    def project(self, points: npt.ArrayLike, size: Size = (1280, 720)) -> np.ndarray:
        """Where points [..., 3] of the world are in the picture: [..., 3] of x, y in pixels and the depth in metres.

        Of wide cameras the depth is the distance, and NaN stands for what a fisheye does not show; `size` counts for
        equirectangular ones alone. Of a flat world: on a round earth far points are drawn lower
        (docs/look_up/conventions.md).
        """
        relative = numbers(points, "points") - np.array(self.eye)
        x, y, z = np.moveaxis(relative @ rotation_of(self.quaternion), -1, 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.projection == "equirectangular":
                width, height = size_of(size)
                return np.stack([width * (0.5 + np.arctan2(x, z) / (2 * np.pi)),
                                 height * (0.5 + np.arctan2(y, np.hypot(x, z)) / np.pi),
                                 np.linalg.norm(relative, axis=-1)], axis=-1)
            if self.projection == "fisheye":
                across = np.hypot(x, y)
                angle = np.arctan2(across, z)
                seen = np.stack([x, y], axis=-1) * np.where(across > 0, self._bent(angle) / across, 1.0)[..., None]
                seen[angle > np.radians(0.5 * self.fisheye_fov)] = np.nan
                depth = np.linalg.norm(relative, axis=-1)
            else:
                seen = np.stack(self.distort(x / z, y / z), axis=-1)
                depth = z
            xy = seen * np.array(self.focal) + np.array(self.principal)
        return np.concatenate([xy, depth[..., None]], axis=-1)

    def _bent(self, angle: npt.ArrayLike) -> np.ndarray:
        """How far from the principal point a fisheye shows what lies at an angle (radians) from its axis; focal = 1."""
        k1, k2, k3, k4 = self.fisheye_k
        t2 = np.square(angle)
        return angle * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))))

    def distort(self, x: np.ndarray, y: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        """Where the lens shows the directions (x, y, 1) of the optical frame, as directions of a camera without one."""
        k1, k2, p1, p2, k3 = self.distortion
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        return (x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y)

    def _tuple(self):
        if self.projection not in PROJECTIONS:
            raise ValueError(f"camera.projection, got {self.projection!r}, allowed {', '.join(PROJECTIONS)}")
        return (vector(self.eye, 3, "camera.eye"), vector(self.quaternion, 4, "camera.quaternion"),
                vector(self.focal, 2, "camera.focal"), vector(self.principal, 2, "camera.principal"),
                number(self.near, "camera.near"), PROJECTIONS.index(self.projection),
                vector(self.fisheye_k, 4, "camera.fisheye_k"), number(self.fisheye_fov, "camera.fisheye_fov"))
