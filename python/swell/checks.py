"""Arguments of programs: what they must be before they become numbers of the C interface."""

from __future__ import annotations

from decimal import Decimal
from numbers import Real
from operator import index
from typing import Any, Tuple

import numpy as np
import numpy.typing as npt

Size = Tuple[int, int]
"""Width and height of a picture in pixels."""


def numbers(values: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    """The values as an array: NumPy alone would make numbers of texts, dates and complex numbers as well."""
    array = np.asarray(values)
    kind = array.dtype.kind
    if kind == "O":
        wrong = next((type(v).__name__ for v in array.flat if not isinstance(v, (Real, Decimal, np.bool_))), None)
    else:
        wrong = None if kind in "fiub" else array.dtype.name
    if wrong is not None:
        raise TypeError(f"{name}, got {wrong}, allowed numbers")
    return array.astype(np.float64, copy=False)


def vector(values: npt.ArrayLike, length: int, name: str) -> Tuple[float, ...]:
    array = numbers(values, name)
    if array.shape != (length,):
        raise ValueError(f"{name}, got an array of shape {array.shape}, allowed ({length},)")
    return tuple(array.tolist())


def points(values: npt.ArrayLike, name: str, axes: int = 2) -> npt.NDArray[np.float64]:
    """Points of a plane [n, 2], or of space with three axes; none: []."""
    array = numbers(values, name)
    if array.size == 0:
        return np.zeros((0, axes))
    if array.ndim != 2 or array.shape[1] != axes:
        raise ValueError(f"{name}, got an array of shape {array.shape}, allowed (n, {axes})")
    return array


def matrix(values: npt.ArrayLike, shape: Tuple[int, int], name: str) -> np.ndarray:
    array = numbers(values, name)
    if array.shape != shape:
        raise ValueError(f"{name}, got an array of shape {array.shape}, allowed {shape}")
    return array


def number(value: Any, name: str) -> float:
    if type(value) is float:
        return value
    array = numbers(value, name)
    if array.shape != ():
        raise ValueError(f"{name}, got an array of shape {array.shape}, allowed a number")
    return float(array)


def size_of(size: Size) -> Size:
    """A picture's size. Raises ValueError for anything but two whole numbers."""
    try:
        width, height = (index(n) for n in size)
    except (TypeError, ValueError):
        raise ValueError(f"size, got {size!r:.100}, allowed (width, height), whole numbers") from None
    return width, height


def instance(value: Any, kind: type, name: str) -> Any:
    """The value, if it is one of that kind."""
    if not isinstance(value, kind):
        raise TypeError(f"{name}, got {type(value).__name__}, allowed swell.{kind.__name__}")
    return value
