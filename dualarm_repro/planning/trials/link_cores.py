"""Clearance of whole links for every radius at once: distances of their cores.

Links are capsules about the segments between the joints. Their cores are measured once; a radius r
of all links then leaves core distance - r to an obstacle, and core distance - 2 r between two arms.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...scene import JointPath, Scene
from ..checks.link_clearance import LinkClearance, link_clearance


@dataclass(frozen=True, eq=False)
class LinkCores:
    """Core distances of the links over the index of all motions.

    Attributes
    ----------
    found : LinkClearance
        Its distances are those of the cores [m].
    """

    found: LinkClearance

    def between(self, first: str, second: str) -> np.ndarray:
        """Smallest core distance of two owners, of whichever order, at every index (M,) [m]."""
        return self.found.distance[:, self._columns(first, second)].min(axis=1)

    def nearest(self, first: str, second: str) -> tuple[str, str]:
        """Which two bodies of two owners come closest."""
        columns = self._columns(first, second)
        return self.found.pairs[columns[self.found.distance[:, columns].min(axis=0).argmin()]]

    def _columns(self, first: str, second: str) -> np.ndarray:
        owners = ({body.partition("/")[0] for body in pair} for pair in self.found.pairs)
        return np.flatnonzero([owner == {first, second} for owner in owners])


def link_cores(scene: Scene, paths: Mapping[str, JointPath], max_step: float) -> LinkCores:
    """Core distances along the motion of the arms in ``paths``, until all of them rest.

    Parameters
    ----------
    paths : mapping of arm to path
        Over a common index.
    max_step : float
        Largest motion of a joint between two looks [rad].

    Raises
    ------
    UnknownNameError
        The scene has no such arm.
    """
    found = link_clearance(scene, paths, max_step)
    radii = [
        sum(scene.bodies.radius[body.row] for body in pair if body.sort == "capsule")
        for pair in scene.pairs.bodies
    ]
    return LinkCores(
        LinkClearance(found.pairs, found.index, found.q, found.distance + np.array(radii))
    )
