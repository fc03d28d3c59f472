"""A planned motion beside that of another arm, over one index: tips, distances, who waits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from ...scene import JointPath, PlacedArm
from ..field.control_points import end_effector
from ..field.obstacles import Obstacles
from ..plan import Plan
from .encounter import to_obstacles


@dataclass(frozen=True, eq=False)
class Replay:
    """The motion of one arm beside that of another; whichever arrives first waits at its goal.

    Attributes
    ----------
    plan : Plan
        Of the first arm.
    other : PlacedArm
    track : JointPath
        Joint path of the other arm over the steps of the plan.
    obstacles : Obstacles
        At rest, that distances are taken to.
    """

    plan: Plan
    other: PlacedArm
    track: JointPath
    obstacles: Obstacles

    @property
    def times(self) -> np.ndarray:
        """Steps 0, 1, ... until both arms rest (T,)."""
        return np.arange(1 + max(self.plan.steps, int(np.ceil(self.track.index[-1]))))

    @property
    def paths(self) -> dict[str, JointPath]:
        """Joint paths by arm, over the common index."""
        return {self.other.name: self.track, self.plan.placed.name: self.plan.joint_path()}

    def apart(self, *, moving: bool = False) -> np.ndarray:
        """Distance of the end effectors until both arms rest, or while the planned one moves [m].

        Shape (T,), or (N,) for the N configurations of the plan: an arm that waits has no track.
        """
        times = self.times[: self.plan.steps + 1 if moving else None]
        mine = self.plan.tcp[np.minimum(times, self.plan.steps)]
        return np.linalg.norm(mine - end_effector(self.other, self.track.at(times)), axis=1)

    def to_obstacles(self) -> np.ndarray:
        """Signed distance of the planned end effector to the nearest obstacle (N,) [m]."""
        return to_obstacles(self.plan, "end_effector", self.obstacles).min(axis=1)

    def until_rest(self, values: np.ndarray) -> np.ndarray:
        """A quantity (N, ...) of the planned arm, at every instant until both rest (T, ...)."""
        return values[np.minimum(self.times, len(values) - 1)]

    def configurations(self) -> dict[str, np.ndarray]:
        """Configurations by arm at every instant (T, nq) [rad]."""
        mine = self.until_rest(self.plan.path)
        return {self.other.name: self.track.at(self.times), self.plan.placed.name: mine}

    def to_frame(self) -> pd.DataFrame:
        """One row per step: end effectors of both arms, columns <arm>_x_m ... [m]."""
        tips = {
            self.other.name: end_effector(self.other, self.track.at(self.times)),
            self.plan.placed.name: self.until_rest(self.plan.tcp),
        }
        columns = {
            f"{name}_{axis}_m": points[:, k]
            for name, points in tips.items()
            for k, axis in enumerate("xyz")
        }
        return pd.DataFrame({"step": self.times, **columns})
