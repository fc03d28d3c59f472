"""Distance over time, with the closest pair under the pointer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ...errors import InputError
from ..page import Page
from .curves import Curve, curve_slice


def distance_slice(
    title: str,
    distances: Mapping[str, ArrayLike],
    *,
    time: ArrayLike | None = None,
    time_label: str = "step",
    levels: Mapping[str, float] | None = None,
    pairs: Sequence[tuple[str, str]] | None = None,
) -> Page:
    """Signed distances [m] over time, drawn in millimetres; contact is marked.

    Parameters
    ----------
    distances : mapping of str to (N,)
        Name of a curve to distances [m], e.g. of a plan with and without repulsion; the shorter
        one stays where it ends.
    time : (N,)
        Default the index.
    levels
        Name to a distance [m] that is marked beside contact, e.g. the range of a repulsion.
    pairs
        The two bodies that are closest at each time.

    Raises
    ------
    InputError
        Not one distance at a time.
    """
    rows = {name: 1e3 * np.asarray(values, dtype=float) for name, values in distances.items()}
    for name, values in rows.items():
        if values.ndim != 1 or not len(values):
            expected = "distances one after the other"
            raise InputError("distance_slice", f"shape of {name}", values.shape, expected)
    count = max(map(len, rows.values()))
    whole = {
        name: np.append(values, np.full(count - len(values), values[-1]))
        for name, values in rows.items()
    }
    return curve_slice(
        title,
        np.arange(count) if time is None else time,
        [Curve(name, {name: values}) for name, values in whole.items()],
        x_label=time_label,
        y_label="distance [mm]",
        levels={"contact": 0.0} | {name: 1e3 * value for name, value in (levels or {}).items()},
        names=None if pairs is None else [f"{a} – {b}" for a, b in pairs],
    )
