"""Pictures as lenses distort them: a wider pinhole picture, looked up anew."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Callable, Tuple

import numpy as np

from .camera import Camera, Size

if TYPE_CHECKING:
    from . import Picture

_STEPS = 30
_SLACK_PX = 0.01


class Lookup:
    """Where the pixels of a distorted picture lie in a pinhole picture that is wide enough."""

    def __init__(self, camera: Camera, size: Size):
        if camera.projection != "perspective":
            raise ValueError(f"camera.distortion, got one of a camera with projection {camera.projection!r}, allowed "
                             "for 'perspective'")
        fx, fy = camera.focal
        column, row = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
        seen_x, seen_y = (column - camera.principal[0]) / fx, (row - camera.principal[1]) / fy
        x, y = _undistorted(camera, seen_x, seen_y)
        left, top = np.floor(fx * x.min()) - 1, np.floor(fy * y.min()) - 1
        self.size = (int(np.ceil(fx * x.max()) - left) + 2, int(np.ceil(fy * y.max()) - top) + 2)
        if max(self.size) > 8192:
            raise ValueError(f"camera.distortion, got one that takes a picture of {self.size[0]} x {self.size[1]} "
                             "pixels, allowed 8192 x 8192")
        self.camera = replace(camera, principal=(-left, -top), distortion=(0.0,) * 5)
        self._x, self._y = fx * x - left, fy * y - top

    def nearest(self, plane: np.ndarray) -> np.ndarray:
        """The values of the nearest pixels."""
        return plane[self._y.astype(np.intp), self._x.astype(np.intp)]

    def blended(self, plane: np.ndarray) -> np.ndarray:
        """The four pixels around, bilinear."""
        x, y = self._x - 0.5, self._y - 0.5
        i, j = np.floor(x).astype(np.intp), np.floor(y).astype(np.intp)
        a, b = (x - i)[..., None], (y - j)[..., None]
        values = plane.astype(np.float64)
        mixed = ((1 - b) * ((1 - a) * values[j, i] + a * values[j, i + 1])
                 + b * ((1 - a) * values[j + 1, i] + a * values[j + 1, i + 1]))
        if plane.dtype == np.uint8:
            mixed = np.floor(mixed + 0.5)
        return mixed.astype(plane.dtype)


def _undistorted(camera: Camera, seen_x: np.ndarray, seen_y: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Turns camera.distort() back, by Newton's method."""
    def residual(x: np.ndarray, y: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        u, v = camera.distort(x, y)
        return u - seen_x, v - seen_y

    x, y, h = seen_x.copy(), seen_y.copy(), 1e-6
    with np.errstate(all="ignore"):
        for _ in range(_STEPS):
            u, v = residual(x, y)
            ux, vx = ((p - q) / h for p, q in zip(residual(x + h, y), (u, v)))
            uy, vy = ((p - q) / h for p, q in zip(residual(x, y + h), (u, v)))
            det = ux * vy - uy * vx
            x, y = x - (vy * u - uy * v) / det, y - (ux * v - vx * u) / det
        u, v = residual(x, y)
        off_px = max(np.abs(u).max() * camera.focal[0], np.abs(v).max() * camera.focal[1])
    # Beyond the first fold of the lens there are no pictures: the determinant changes its sign there.
    if not (off_px < _SLACK_PX and (det > 0.0).all()):
        raise ValueError("camera.distortion, got one that folds the picture or does not reach its corners, allowed lenses "
                         "that are one to one on it")
    return x, y


class DistortedPicture:
    """A picture as the camera's lens distorts it, with the arrays of Picture but for the label "motion".

    Colours are blended between pixels, labels those of the nearest one. Of such a picture there is no hash.
    """

    def __init__(self, pinhole: Picture, lookup: Lookup, camera: Camera):
        self._pinhole, self._lookup = pinhole, lookup
        self.camera = camera
        """The camera that it was drawn with."""
        self.t = pinhole.t
        """Its time in seconds."""

    @property
    def rgba(self) -> np.ndarray:
        """(height, width, 4) uint8: sRGB."""
        return self._lookup.blended(self._pinhole.rgba)

    @property
    def rgb(self) -> np.ndarray:
        """(height, width, 3) uint8: sRGB."""
        return self.rgba[..., :3]

    @property
    def linear(self) -> np.ndarray:
        """(height, width, 3) float32: linear light, of render(linear=True)."""
        return self._lookup.blended(self._pinhole.linear)

    def __getitem__(self, label: str) -> np.ndarray:
        """A label that was asked for, as of Picture."""
        if label == "motion":
            raise ValueError("label, got 'motion', allowed others: a lens bends motion")
        return self._lookup.nearest(self._pinhole[label])
