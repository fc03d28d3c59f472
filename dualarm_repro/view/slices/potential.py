"""The slice of a potential: its terms along a line, with the gain of each on a slider."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..page import Page
from .curves import Curve, curve_slice

#: U(q) of configurations (N, nq) -> (N,), such as ``field.value``.
Potential = Callable[[np.ndarray], np.ndarray]


def potential_slice(
    title: str,
    line: ArrayLike,
    base: Mapping[str, Potential],
    added: Mapping[str, Potential],
    *,
    x_label: str,
    x: ArrayLike | None = None,
    marks: Mapping[str, float] | None = None,
    y_range: tuple[float, float] | None = None,
) -> Page:
    """U along a line through configurations, once as it is and once with further terms.

    The dashed curve is the sum of ``base``; the other adds ``added``, each with a factor that a
    slider changes from 0 to 3, 1 being the potential as given. Circles are minima along the line: a
    trap of the one that is none of the other shows as a circle that goes away.

    Parameters
    ----------
    line : (N, nq)
        Configurations, e.g. ``trap + s * direction``.
    base, added
        Name of a term to its potential; the names of ``added`` stand at the sliders.
    x : (N,)
        Coordinate along the line; default its length in the joints [rad], without rests.
    marks
        Name to a place on x, e.g. the trap.
    """
    q = np.asarray(line, dtype=float)
    if x is None:
        steps = np.linalg.norm(np.diff(q, axis=0), axis=1)
        moves = np.append(True, steps > 0.0)
        q, x = q[moves], np.append(0.0, np.cumsum(steps))[moves]
    fixed = {name: np.asarray(value(q), dtype=float) for name, value in base.items()}
    moved = {name: np.asarray(value(q), dtype=float) for name, value in added.items()}
    return curve_slice(
        title,
        x,
        [
            Curve(f"with {' and '.join(moved)}", {**fixed, **moved}),
            Curve(f"without {'it' if len(moved) == 1 else 'them'}", fixed, dashed=True),
        ],
        x_label=x_label,
        y_label="potential U",
        gains=dict.fromkeys(moved, 1.0),
        marks=marks,
        y_range=y_range,
        minima=True,
    )
