"""A slave that is searched from both ends around the moving hull of its master, and both played.

The master's path is planned without the slave. Circles at its joints span its hull at every pose;
:mod:`.time_map` says which pose each half of the slave meets, and where the master is at every
sample of the slave's path.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...scene import PlacedArm, Scene
from ..checks.contact_check import ContactCheck, contact_check
from ..field.control_points import end_effector
from ..field.hull_obstacle import JointCircles
from ..field.obstacles import Obstacles
from .bidirectional_compiled import plan_bidirectional_compiled
from .bidirectional_settings import BidirectionalSettings
from .search_plan import SearchPlan
from .time_map import along_path, hull_tracks, replay, time_map


@dataclass(frozen=True, eq=False)
class DualSearch:
    """Master and slave: their searches, the paths to execute (N, nq) [rad], and the circles and the
    number of searches by which the slave has met the master."""

    master: SearchPlan
    slave: SearchPlan
    master_path: np.ndarray
    slave_path: np.ndarray
    circles: JointCircles
    spread: int

    @property
    def reached(self) -> bool:
        """Whether both searches arrived."""
        return self.master.reached and self.slave.reached

    @property
    def arms(self) -> tuple[PlacedArm, PlacedArm]:
        """Master and slave."""
        return self.master.placed, self.slave.placed

    def played(self, how: str = "time map", shift: int = 0) -> tuple[np.ndarray, np.ndarray]:
        """Paths (M, nq) of master and slave on common samples.

        Parameters
        ----------
        how
            ``time map``: as planned; ``uniform``: the master goes at constant speed while the slave
            moves.
        shift
            The master is this many samples ahead of the time map.
        """
        share = time_map(self.slave, self.spread)
        if how == "uniform":
            share = np.linspace(0.0, 1.0, len(share))
            return along_path(self.master_path, share), self.slave_path
        ahead = np.clip(share + shift * (0.5 / self.spread), 0.0, 1.0)
        return replay(self.master_path, self.slave_path, ahead, self.spread)

    def stacked(self, scene: Scene, how: str = "time map", shift: int = 0) -> np.ndarray:
        """The same as configurations (M, nq of the scene)."""
        names = (placed.name for placed in self.arms)
        return scene.stack(**dict(zip(names, self.played(how, shift), strict=True)))

    def contact(self, scene: Scene, how: str = "time map", shift: int = 0) -> ContactCheck:
        """Contact of whole links while both arms move in a scene of both."""
        return contact_check(scene, self.stacked(scene, how, shift))

    def tips(self) -> tuple[np.ndarray, np.ndarray]:
        """Flanges of master and slave on common samples, in the world (M, 3) [m]."""
        first, second = map(end_effector, self.arms, self.played())
        return first, second


def search_around(
    master: SearchPlan,
    slave: PlacedArm,
    ends: tuple[np.ndarray, np.ndarray],
    obstacles: Obstacles,
    settings: BidirectionalSettings,
    circles: JointCircles,
    spread: int,
    smooth: Callable[[np.ndarray], np.ndarray],
) -> DualSearch:
    """Search the slave from start to goal (nq,) [rad] around the hull of the master on its path.

    Parameters
    ----------
    obstacles, settings
        Of the slave.
    circles, spread
        The hull of the master, and the searches over which its path is spread up to its middle.
    smooth
        Gives the path to execute for the joined path of a search (N, nq).

    Raises
    ------
    ConfigurationError, InputError
        See :func:`.search_problem.search_problem` and :func:`.time_map.shares`.
    """
    path = smooth(master.path)
    hulls = hull_tracks(master.placed, path, circles, spread)
    found = plan_bidirectional_compiled(slave, *ends, obstacles, settings, hulls)
    return DualSearch(master, found, path, smooth(found.path), circles, spread)
