"""Checked geometric quantities: finite, of the right form, read-only."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from ..annotation import real_array
from ..errors import InputError


def vector3(source: str, name: str, value: ArrayLike) -> np.ndarray:
    """Three finite numbers as a read-only array."""
    return array_of(source, name, value, (3,), "three finite numbers")


def positive(source: str, name: str, value: float, unit: str = "m") -> float:
    """A positive finite number."""
    expected = f"a positive finite number [{unit}]"
    number = array_of(source, name, value, (), expected)
    if not number > 0:
        raise InputError(source, name, value, expected)
    return float(number)


def rotation3(source: str, name: str, value: ArrayLike) -> np.ndarray:
    """A rotation matrix, to 1e-9."""
    expected = "a rotation matrix (3, 3)"
    rotation = array_of(source, name, value, (3, 3), expected)
    if not np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-9) or np.linalg.det(rotation) < 0:
        raise InputError(source, name, value, expected)
    return rotation


def unit3(source: str, name: str, value: ArrayLike) -> np.ndarray:
    """A non-zero vector, scaled to length one."""
    direction = vector3(source, name, value)
    if not (length := np.linalg.norm(direction)) > 0:
        raise InputError(source, name, value, "a vector that is not zero")
    return frozen(direction / length)


def finite_pose(source: str, name: str, value: pin.SE3) -> None:
    """Refuse a pose with NaN or infinity, or something that is no pose."""
    expected = "a finite pinocchio.SE3"
    if not isinstance(value, pin.SE3):
        raise InputError(source, name, value, expected)
    array_of(source, name, value.homogeneous, (4, 4), expected)


def array_of(
    source: str, name: str, value: ArrayLike, shape: tuple[int | None, ...], expected: str
) -> np.ndarray:
    """Finite numbers of a shape as a read-only copy; None stands for any length."""
    try:
        array = real_array(value).copy()
    except (TypeError, ValueError, OverflowError):
        raise InputError(source, name, value, expected) from None
    fits = len(shape) == array.ndim and all(
        wanted in (None, length) for wanted, length in zip(shape, array.shape, strict=True)
    )
    if not fits or not np.isfinite(array).all():
        raise InputError(source, name, value, expected)
    return frozen(array)


def frozen(array: np.ndarray) -> np.ndarray:
    """The array, made read-only."""
    array.flags.writeable = False
    return array
