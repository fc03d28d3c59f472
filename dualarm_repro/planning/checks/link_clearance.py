"""What a plan is worth: distances of whole links, between the steps too, of all arms together."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from ...arguments import Positive, checked
from ...errors import InputError, UnknownNameError
from ...scene import JointPath, Scene, densify, distances
from ...scene.certificate import Bracket, certified_minimum


@dataclass(frozen=True, eq=False)
class LinkClearance:
    """Signed distances [m] of the watched pairs of bodies over a common index.

    Attributes
    ----------
    pairs : tuple of (str, str)
    index : ndarray (M,)
        Step of the plans; fractions lie between steps.
    q : ndarray (M, nq)
        Joints of all arms one after the other [rad].
    distance : ndarray (M, P)
    """

    pairs: tuple[tuple[str, str], ...]
    index: np.ndarray
    q: np.ndarray
    distance: np.ndarray

    @property
    def minimum(self) -> float:
        """Smallest distance of any pair at any index; infinite if no pair is watched."""
        return float(self.distance.min(initial=np.inf))

    @property
    def nearest(self) -> tuple[tuple[str, str], float]:
        """The pair that attains the minimum and the index where it does; needs a watched pair."""
        row, column = np.unravel_index(self.distance.argmin(), self.distance.shape)
        return self.pairs[column], float(self.index[row])

    def to_frame(self) -> pd.DataFrame:
        """One column per pair, one row per index."""
        names = [f"{first} - {second}" for first, second in self.pairs]
        return pd.DataFrame(self.distance, columns=names).set_index(
            pd.Index(self.index, name="step")
        )


@checked
def link_clearance(
    scene: Scene, paths: Mapping[str, JointPath], max_step: Positive
) -> LinkClearance:
    """Distances along the motion of the arms in ``paths``, from the first index to the last of any.

    An arm waits at the ends of its path. Arms of the scene without a path are left out.

    Parameters
    ----------
    paths : mapping of arm to path
        Over a common index, e.g. ``plan.joint_path()``.
    max_step : float
        Largest motion of a joint between two looks [rad].

    Raises
    ------
    UnknownNameError
        The scene has no such arm.
    """
    moving, q, index = _motion(scene, paths)
    q, index = densify(q, max_step, index)
    return LinkClearance(moving.pairs.names, index, q, distances(moving, q, index))


@checked
def certified_clearance(
    scene: Scene, paths: Mapping[str, JointPath], tolerance: Positive = 1e-3
) -> Bracket:
    """Bounds on the smallest distance of the same motion that hold between the looks too."""
    moving, q, index = _motion(scene, paths)
    return certified_minimum(moving, q, index, tolerance)


@checked
def require_links_clear(scene: Scene, q: Mapping[str, ArrayLike], field: str = "start") -> None:
    """Raise if two watched bodies touch, with the arms at ``q`` and without all other arms.

    Raises
    ------
    InputError
        Names the pair and its distance.
    """
    only = _only(scene, q)
    found = distances(only, only.stack(**q))
    if found.size and found.min() <= 0.0:
        first, second = only.pairs.names[found.argmin()]
        expected = f"{first} and {second} apart, not at a distance of {found.min():.4g} m"
        raise InputError(
            "scene", field, {name: np.asarray(q[name]).tolist() for name in q}, expected
        )


def _only(scene: Scene, names: Collection[str]) -> Scene:
    """The scene with some of its arms."""
    for name in names:
        if name not in scene.columns:
            raise UnknownNameError("scene", "arm", name, f"one of {', '.join(scene.columns)}")
    return replace(scene, arms=[placed for placed in scene.arms if placed.name in names])


def _motion(scene: Scene, paths: Mapping[str, JointPath]) -> tuple[Scene, np.ndarray, np.ndarray]:
    """The scene with the moving arms only, and their joints at every index that any path names."""
    moving = _only(scene, paths)
    index = np.unique(np.concatenate([path.index for path in paths.values()]))
    return moving, moving.stack(**{name: path.at(index) for name, path in paths.items()}), index
