"""Clearance of whole links over a motion, beside the check of the end effectors alone.

Links are capsules about the segments between the joints. Their cores are measured once; a radius r
of all links then leaves core distance - r to a bar and core distance - 2 r between the arms.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...planning.checks.link_clearance import LinkClearance, link_clearance
from ...planning.plan import Plan
from ...scene import JointPath
from .layout import Layout, scene_of

#: Largest joint step between two checked configurations [rad].
CLOSE = 0.02


@dataclass(frozen=True, eq=False)
class Cores:
    """Core distances of the links over the index of both motions.

    Attributes
    ----------
    found : LinkClearance
        Its distances are those of the cores [m].
    """

    found: LinkClearance

    def between(self, first: str, second: str) -> np.ndarray:
        """Smallest core distance of two owners at every index (M,) [m]."""
        return self.found.distance[:, self._mask(first, second)].min(axis=1)

    def nearest(self, first: str, second: str) -> tuple[str, str]:
        """Which two bodies of two owners come closest."""
        columns = np.flatnonzero(self._mask(first, second))
        return self.found.pairs[columns[self.found.distance[:, columns].min(axis=0).argmin()]]

    @property
    def smallest(self) -> dict[str, float]:
        """Smallest core distance over the motion: either arm to a bar, and between the arms [m]."""
        return {
            "slave_window": float(self.between("slave", "window").min()),
            "master_window": float(self.between("master", "window").min()),
            "arms": float(self.between("master", "slave").min()),
        }

    def _mask(self, first: str, second: str) -> np.ndarray:
        owners = [{body.partition("/")[0] for body in pair} for pair in self.found.pairs]
        return np.array([owner == {first, second} for owner in owners])


def largest_radius(smallest: dict[str, float]) -> float:
    """Radius up to which no link touches a bar or the other arm [m]."""
    return min(smallest["slave_window"], smallest["master_window"], 0.5 * smallest["arms"])


def link_cores(layout: Layout, slave: Plan, track: JointPath, floor: float | None = None) -> Cores:
    """Core distances from the start until both arms rest, on a densified path."""
    scene = scene_of(layout, floor)
    found = link_clearance(scene, {"master": track, "slave": slave.joint_path()}, CLOSE)
    radii = [
        sum(scene.bodies.radius[body.row] for body in pair if body.sort == "capsule")
        for pair in scene.pairs.bodies
    ]
    return Cores(LinkClearance(found.pairs, found.index, found.q, found.distance + np.array(radii)))
