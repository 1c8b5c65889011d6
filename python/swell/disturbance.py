"""What disturbs the water."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence, Tuple

from .checks import number, points, vector

_KINDS = ("drop", "footstep", "hull", "rotor")


@dataclass(frozen=True)
class Disturbance:
    """What disturbs the water besides the scene's [[disturbance]], with the same values (docs/look_up/scene.md).

    Waves follow from the list and the time alone: give the same list for earlier times and later ones.
    """

    kind: str
    """drop: a hump at `t` that runs apart in rings; footstep: a hollow; hull: one under way; rotor: gusts from `t` on."""
    position: Sequence[float] = (0.0, 0.0)
    """Of its middle, metres: east, north; not of a hull."""
    t: float = 0.0
    """Seconds; not of a hull, which is at the first point of its path at 0."""
    duration: float = 60.0
    """Of a rotor, over 0, seconds."""
    radius: float = 0.25
    """Metres; not of a hull."""
    height: float = 0.1
    """Metres, not 0; not of a hull."""
    path: Sequence[Sequence[float]] = ()
    """Of a hull: two points or more, metres."""
    speed: float = 3.0
    """Of a hull, over 0, m/s."""
    path_closed: bool = True
    """Whether a hull goes round, or stops at the last point."""
    hull: Sequence[float] = (2.9, 9.2, 0.5)
    """Beam, length, draught in metres."""
    depth: float = 0.0
    """Of the water under a hull, metres; 0: deep."""

    def _tuple(self) -> Tuple:
        if self.kind not in _KINDS:
            raise ValueError(f"disturbance's kind, got '{self.kind}', allowed {', '.join(_KINDS)}")
        values = {name: number(getattr(self, name), f"disturbance's {name}")
                  for name in ("t", "duration", "radius", "height", "speed", "depth")}
        for name in ("duration", "radius", "height", "speed"):  # 0 stands for the default in the C interface
            if values[name] == 0.0:
                raise ValueError(f"disturbance's {name}, got 0, allowed other numbers")
        return (_KINDS.index(self.kind), vector(self.position, 2, "disturbance's position"), values["t"],
                values["duration"], values["radius"], values["height"],
                points(self.path, "disturbance's path").tolist(), values["speed"], not self.path_closed,
                vector(self.hull, 3, "disturbance's hull"), values["depth"])
