"""How the water moves below its surface, and what it does to hulls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .checks import points

IN_WATER, ABOVE_WATER, IN_GROUND = range(3)
"""What Motion.place holds."""


@dataclass(frozen=True)
class Motion:
    """The water's motion at points [..., 3]; 0 out of the water."""

    velocity: npt.NDArray[np.float32]
    """[..., 3], m/s: east, north, up."""
    acceleration: npt.NDArray[np.float32]
    """[..., 3], m/s2: the velocity's rate at a place that stands still, by the waves alone."""
    pressure: npt.NDArray[np.float32]
    """[...], Pa: of the waves, without that of still water."""
    place: npt.NDArray[np.uint8]
    """[...]: IN_WATER, ABOVE_WATER or IN_GROUND."""


@dataclass(frozen=True)
class Load:
    """A force and its moment, east, north, up."""

    force: npt.NDArray[np.float64]
    """(3,), N."""
    moment: npt.NDArray[np.float64]
    """(3,), N m."""


@dataclass(frozen=True)
class HullLoads:
    """What presses on the part of a hull that is under the surface."""

    buoyancy: Load
    """Of the pressure of still water."""
    froude_krylov: Load
    """Of the waves' pressure."""


def triangles_of(triangles: npt.ArrayLike, count: int) -> npt.NDArray[np.uint32]:
    """Indices (m, 3) of triangles' corners among so many points."""
    array = points(triangles, "triangles", 3)
    wrong = array[(array != np.floor(array)) | (array < 0) | (array >= count)]
    if wrong.size:
        raise ValueError(f"triangles, got point {wrong[0]:g}, allowed 0 to {count - 1}")
    return array.astype(np.uint32)
