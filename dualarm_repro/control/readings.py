"""What a controller reads of the arms that it moves: noisy distances, biased and late angles."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from ..arguments import Joints, Number, Shape, checked
from ..errors import InputError
from ..kernel import kernel
from .system import ArmSystem


class Readings(NamedTuple):
    """Errors of what is read; the arms move as they do.

    Attributes
    ----------
    noise : (steps, P) or (0, 0)
        Added to the distances of each tick [m].
    offset : (n,)
        Added to the joint angles [rad]: with a wrong angle goes a wrong model, f, J and distances.
    delay : int
        Ticks by which the joint angles are late.
    """

    noise: np.ndarray
    offset: np.ndarray
    delay: int

    @classmethod
    @checked
    def of(
        cls,
        system: ArmSystem,
        *,
        noise: Annotated[np.ndarray, Shape("T", "P")] | None = None,
        offset: Joints | None = None,
        delay: Number = 0,
    ) -> Readings:
        """Readings of a system with the errors that are given.

        Raises
        ------
        InputError
            An offset that is not of its joints.
        """
        none = np.empty((0, 0))
        offset = np.zeros(system.nq) if offset is None else offset
        if len(offset) != system.nq:
            raise InputError("Readings.of", "length of offset", len(offset), f"{system.nq}")
        return cls(none if noise is None else noise, offset, delay)


def readings_for(system: ArmSystem, given: Readings | None) -> Readings:
    """What a run reads: without errors unless given, and never of another number of pairs or
    joints, which a kernel would look for beyond the end of the arrays.

    Raises
    ------
    InputError
        Readings that do not fit the system.
    """
    if given is None:
        return Readings.of(system)
    found, pairs = Readings.of(system, **given._asdict()), len(system.arrays.pairs)
    if len(found.noise) and found.noise.shape[1] != pairs:
        expected = f"(steps, {pairs}), one for each watched pair"
        raise InputError("Readings", "shape of noise", found.noise.shape, expected)
    return found


@kernel
def noise_at(readings, step):
    """Noise of the distances at a tick (P,) or (0,)."""
    return readings.noise[step] if step < len(readings.noise) else np.empty(0)


@kernel
def angles_at(readings, q, step):
    """Joint angles (n,) as they are read at a tick of a motion q."""
    return q[max(step - readings.delay, 0)] + readings.offset


def low_pass(noise: np.ndarray, dt: float, time: float) -> np.ndarray:
    """Noise (steps, P) behind a filter of first order, y' = (u - y) / time.

    The lag that the filter has on the distances themselves is left out.
    """
    share, filtered = dt / (time + dt), np.empty_like(noise)
    state = np.zeros(noise.shape[1])
    for k, reading in enumerate(noise):
        state = state + share * (reading - state)
        filtered[k] = state
    return filtered
