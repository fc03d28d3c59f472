"""What a controller reads of the arms that it moves: noisy distances, biased and late angles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

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
    def of(
        cls,
        system: ArmSystem,
        *,
        noise: np.ndarray | None = None,
        offset: np.ndarray | None = None,
        delay: int = 0,
    ) -> Readings:
        """Readings of a system with the errors that are given."""
        none = np.empty((0, 0))
        still = np.zeros(system.nq)
        return cls(none if noise is None else noise, still if offset is None else offset, delay)


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
