"""What a lidar, or a depth sensor of single beams, gets back of a World."""

from __future__ import annotations

from dataclasses import dataclass
from typing import List

import numpy as np
import numpy.typing as npt

from . import _swell
from .checks import Size, number, size_of, vector


@dataclass(frozen=True)
class Returns:
    """What the beams of World.lidar() got back: arrays of the beams' shape [...]."""

    range: npt.NDArray[np.float32]
    """Metres along the beam; inf: nothing came back."""
    intensity: npt.NDArray[np.float32]
    """In [0, 1]: 1 is a white matt surface that is met squarely."""
    incidence: npt.NDArray[np.float32]
    """Degrees between the beam and the surface's normal, in [0, 90]."""
    id: npt.NDArray[np.uint32]
    """As in the label "id"; 0: nothing."""
    klass: npt.NDArray[np.uint32]
    """As in the label "class"; 0: nothing."""
    point: npt.NDArray[np.float32]
    """[..., 3], metres in the sensor's frame as the beam left; nan: nothing."""


def lidars() -> List[str]:
    """The names of the spinning lidars whose beams are known, by their makers' data sheets."""
    return _swell.lidars()


def spinning_beams(model: str, columns: int = 1024, *, start_deg: float = 0.0,
                   duration: float = 0.1) -> npt.NDArray[np.float64]:
    """A clockwise turn of a spinning lidar, as World.lidar() takes it: [columns, beams, 3].

    model: "vlp-16", "hdl-32e", "os1-64" or "os1-128".
    start_deg: azimuth of the first column, from x (ahead) towards y (left).
    duration: of the turn in seconds, in which the columns leave one after the other.
    """
    return _swell.spinning_beams(model, columns, number(start_deg, "start_deg"), number(duration, "duration"))


def grid_beams(size: Size, fov_deg: Size, *, duration: float = 0.0) -> npt.NDArray[np.float64]:
    """The beams of a solid-state lidar or a depth camera at even angles, as World.lidar() takes them: [height, width, 3].

    size: (width, height); rows from the top, left to right.
    fov_deg: (width, height) of the field of view, whose even cells have a beam in their middles.
    duration: seconds in which the rows leave one after the other.
    """
    return _swell.grid_beams(size_of(size), vector(fov_deg, 2, "fov_deg"), number(duration, "duration"))
