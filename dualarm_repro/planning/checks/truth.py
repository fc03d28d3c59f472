"""One truth after any method: a certified lower bound of the distance of all bodies over the whole
motion, who arrived, and whether the joints stayed within their limits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ...arguments import checked
from ...scene import JointPath, Scene, certified_minimum, distances
from ...scene.broad_phase import near_scene
from ...scene.certificate import Bracket
from ...scene.exact_shapes import exact_minimum
from ..gate import ROUNDING, beyond_limits
from .whole_motion import require_paths

#: Wanted width of the bracket, and that tried where the wide one does not decide [m].
TOLERANCE, FINE = 1e-3, 2e-5


class Verdict(StrEnum):
    """What the distances of a motion amount to."""

    FREE = "certified free"
    COLLISION = "COLLISION"
    UNDECIDED = "not certified free"


@dataclass(frozen=True, eq=False)
class Truth:
    """``lower`` <= smallest distance of any two watched bodies at any time <= ``upper`` [m].

    Attributes
    ----------
    pair : (str, str) or None
        The bodies that are ``upper`` apart; None if no pair is watched.
    index : float
        Index of the paths at which they are.
    q : dict of ndarray (nq,)
        The arms then [rad, m].
    beyond_limits : dict of float
        Largest excess of each arm over a limit of a joint [rad, m]; 0 inside.
    """

    lower: float
    upper: float
    pair: tuple[str, str] | None
    index: float
    q: dict[str, np.ndarray]
    beyond_limits: dict[str, float]

    @property
    def collision_free(self) -> bool:
        """Whether the lower bound is positive."""
        return self.lower > 0.0

    @property
    def within_limits(self) -> bool:
        """Whether no joint leaves its limits by more than rounding."""
        return all(excess <= ROUNDING for excess in self.beyond_limits.values())

    @property
    def verdict(self) -> Verdict:
        """In words."""
        if self.collision_free:
            return Verdict.FREE
        return Verdict.COLLISION if self.upper <= 0.0 else Verdict.UNDECIDED


_Pair = tuple[str, str] | None


@checked
def truth(scene: Scene, paths: Mapping[str, JointPath]) -> Truth:
    """Judge the motion of all arms of a scene, from the first index to the last of any path.

    Between samples a path is linear in the joints, at its ends an arm waits; obstacles that move
    are followed until they rest.

    Parameters
    ----------
    paths : mapping of arm to path
        Of every arm of the scene, over a common index; a parked arm has one sample.

    Raises
    ------
    InputError
        No mapping of name to JointPath.
    UnknownNameError
        An arm without a path, or a path without an arm.
    """
    require_paths("truth", scene, paths)
    first = min(float(path.index[0]) for path in paths.values())
    tracks = [*paths.values(), *(mover.path for mover in scene.moving.values())]
    index = np.unique(np.concatenate([track.index for track in tracks]))
    index = index[index >= first]
    q = scene.stack(**{name: path.at(index) for name, path in paths.items()})
    near = near_scene(scene, q, index)
    found = certified_minimum(near, q, index, TOLERANCE)
    if found.lower <= 0.0 < found.upper:
        fine = certified_minimum(near, q, index, FINE, enough=FINE)
        if fine.lower > 0.0 or fine.upper < found.upper:
            found = fine
    pair = None
    if len(near.pairs):
        pair = near.pairs.names[int(distances(near, found.q, found.time).argmin())]
    if found.lower > 0.0:
        found, pair = _with_exact_shapes(scene, q, index, found, pair)
    excess = {
        one.name: beyond_limits(one, q[:, scene.columns[one.name]]).max() for one in scene.arms
    }
    return Truth(
        found.lower,
        found.upper,
        pair,
        found.time,
        {name: found.q[columns] for name, columns in scene.columns.items()},
        {name: float(value) for name, value in excess.items()},
    )


def _with_exact_shapes(
    scene: Scene, q: np.ndarray, index: np.ndarray, found: Bracket, pair: _Pair
) -> tuple[Bracket, _Pair]:
    """The bracket and pair after a look at shapes of one arm whose capsules do not tell."""
    for placed in scene.arms:
        path = JointPath(q[:, scene.columns[placed.name]], index)
        exact = exact_minimum(scene, placed, path, TOLERANCE, found.lower)
        if exact is None:
            continue
        one, names = exact
        lower = min(found.lower, one.lower)
        if one.upper < found.upper:
            row = JointPath(q, index).at(np.array([one.time]))[0]
            found, pair = found._replace(upper=one.upper, q=row, time=one.time), names
        found = found._replace(lower=lower)
    return found, pair
