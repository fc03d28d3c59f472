"""What is maximised: the measure of three robots over a seam, in every reading of its weights."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np

from ..arguments import OPEN, Shape, checked
from ..errors import InputError, UnknownNameError
from .cell import Cell
from .ellipsoid import coupled_pair_volume, ellipsoid_volume, gram_matrices
from .manipulability import PAIR_MEASURES, tight_measure, weighted_measure

CHOICES = {
    "weights": ("inverse_volume", "equal", "harmonic", "tight_only", "loose_only"),
    "space": ("translational", "full"),
    "carriers": ("mean", "sum", "coupled_pair"),
    "pair": PAIR_MEASURES,
    "aggregation": ("mean", "minimum"),
    "unit": ("m", "mm"),
}
_PER_METRE = {"m": 1.0, "mm": 1000.0}
#: Rows of the Jacobian that each space takes.
ROWS = {"translational": 3, "full": 6}


class Measures(NamedTuple):
    """Measures along the seam (..., N) of carriers, welder and system, and the two weights."""

    tight: np.ndarray
    loose: np.ndarray
    system: np.ndarray
    beta_tight: np.ndarray
    beta_loose: np.ndarray


@checked
@dataclass(frozen=True)
class Objective:
    """One reading of the measure; the fields are explained by :data:`CHOICES`.

    weights: ``inverse_volume`` takes beta = 1 / V of the velocity ellipsoids, which is what
    V_int / V comes to, since a common intersection cancels; ``harmonic`` beta = 1 / M; ``equal`` 1;
    the last two keep one group only. space: translational velocity or full twist. carriers: how the
    two ratios become one weight. pair: see :func:`.manipulability.tight_measure`. aggregation: of a
    seam. unit: of length, in which the measures are added.

    Raises
    ------
    UnknownNameError
        A field with another value.
    """

    weights: str = "inverse_volume"
    space: str = "translational"
    carriers: str = "mean"
    pair: str = "product"
    aggregation: str = "mean"
    unit: str = "m"

    def __post_init__(self) -> None:
        for name, choices in CHOICES.items():
            value = getattr(self, name)
            if value not in choices:
                raise UnknownNameError("objective", name, value, f"one of {', '.join(choices)}")

    @property
    def uses_volumes(self) -> bool:
        """Whether the weights are taken from ellipsoids."""
        return self.weights == "inverse_volume"

    @checked
    def measures(
        self,
        w: Annotated[np.ndarray, OPEN, Shape(..., 3, "N")],
        inverse: Annotated[np.ndarray, OPEN, Shape(..., 2, "N")] | None,
    ) -> Measures:
        """Measures along the seam.

        Parameters
        ----------
        w : ndarray (..., 3, N)
            Manipulabilities of carrier 1, carrier 2 and welder [m^3].
        inverse : ndarray (..., 2, N) or None
            Inverse volumes of carriers and welder (:func:`inverse_volumes`), if they are used.

        Raises
        ------
        InputError
            They are used and not given.
        """
        first, second, loose = np.moveaxis(w * _PER_METRE[self.unit] ** 3, -2, 0)
        tight = tight_measure(first, second, self.pair)
        match self.weights:
            case "inverse_volume":
                if inverse is None:
                    raise InputError("objective", "inverse", None, "inverse volumes (..., 2, N)")
                if inverse.shape[:-2] != w.shape[:-2]:
                    expected = f"{(*w.shape[:-2], 2, w.shape[-1])}"
                    raise InputError("objective", "shape of inverse", inverse.shape, expected)
                beta = inverse[..., 0, :], inverse[..., 1, :]
            case "harmonic":
                beta = 1.0 / tight, 1.0 / loose
            case name:
                beta = (
                    np.full_like(tight, name != "loose_only"),
                    np.full_like(loose, name != "tight_only"),
                )
        return Measures(tight, loose, weighted_measure(tight, loose, *beta), *beta)

    @checked
    def aggregate(self, values: Annotated[np.ndarray, OPEN, Shape(..., "N")]) -> np.ndarray:
        """Mean or minimum over the last axis."""
        return values.mean(axis=-1) if self.aggregation == "mean" else values.min(axis=-1)


def cell_grams(cell: Cell, q: np.ndarray, rows: int) -> np.ndarray:
    """A = J J^T of each robot at its reference point, (P, 3, N, 6) -> (3, P N, rows, rows).

    ``rows`` is 3 for translational velocities, 6 for twists; see :func:`.ellipsoid.gram_matrices`.
    """
    grams = []
    for k, arm in enumerate(cell.arms):
        lever = np.broadcast_to(cell.lever_arms[k], (len(q), cell.count, 3)).reshape(-1, 3)
        path = np.ascontiguousarray(q[:, k].reshape(-1, arm.nq))
        rotation = np.ascontiguousarray(cell.bases[k][:3, :3])
        grams.append(gram_matrices(arm.chain, rotation, path, lever, rows))
    return np.stack(grams)


@checked
def inverse_volumes(
    cell: Cell,
    q: Annotated[np.ndarray, OPEN, Shape("P", 3, "N", 6)],
    space: str,
    carriers: str,
) -> np.ndarray:
    """Inverse ellipsoid volumes of carriers and welder, (P, 3, N, 6) -> (P, 2, N).

    The carriers' two inverse volumes are merged by ``carriers``: their mean, their sum, or the
    inverse volume of the coupled pair.
    """
    for name, value in (("space", space), ("carriers", carriers)):
        if value not in CHOICES[name]:
            expected = f"one of {', '.join(CHOICES[name])}"
            raise UnknownNameError("inverse_volumes", name, value, expected)
    grams = cell_grams(cell, q, ROWS[space])
    first, second, welder = (1.0 / ellipsoid_volume(A) for A in grams)
    match carriers:
        case "mean":
            tight = 0.5 * (first + second)
        case "sum":
            tight = first + second
        case _:
            tight = 1.0 / coupled_pair_volume(grams[0], grams[1])
    return np.stack([tight, welder]).reshape(2, len(q), cell.count).transpose(1, 0, 2)
