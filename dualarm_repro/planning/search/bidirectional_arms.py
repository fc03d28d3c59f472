"""Two arms by searches from both ends: the master alone, then the slave around its moving hull.

The joined path of each is smoothed; the time map of :mod:`.time_map` says where the master is at
every sample of the slave, and both are played along it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pandas as pd
from pydantic import Field

from ...arms import Arm
from ...errors import InputError
from ...scene import JointPath, PlacedArm, Scene
from ...settings import Positive
from ..arm_path import ArmPath
from ..descent.outcome import leaves_limits
from ..descent.termination import StopReason
from ..field.control_points import control_points
from ..field.hull_obstacle import HullTrack, JointCircles
from ..field.obstacles import Obstacles, obstacles_of
from ..master_slave import CoordinatedPlan, Task
from ..settings import Count, Share
from .bidirectional_compiled import plan_bidirectional_compiled
from .bidirectional_settings import BidirectionalSettings, StepRule
from .failure import Failure, classify
from .search_plan import SearchPlan
from .splice import smoothed
from .time_map import hull_tracks, replay, shares, time_map

_SHORTEST = 5  # samples that a spline needs


class TwoArmSettings(BidirectionalSettings):
    """A search, the smoothing of its path, and the hull by which the slave sees the master."""

    smoothing: Share = Field(default=1.0, description="mu of the spline, see splice")
    end_weight: Positive = Field(default=1e4, description="weight of both ends of the path")
    hull_radius: Positive | None = Field(
        default=None, description="of the circles at the joints [m]; default the widest capsule"
    )
    hull_points: Count = Field(default=12, description="points per circle")
    spread: Count | None = Field(
        default=None, description="searches in which the master is met up to its middle"
    )


@dataclass(frozen=True)
class SearchEnd:
    """Where a search that did not arrive ended: gap of the halves, or to the goal [rad], smallest
    distance of a control point on the way [m], and how a one-sided search failed."""

    gap: float
    control_clearance: float
    failure: Failure | None


@dataclass(frozen=True, eq=False)
class SplicedPlan(ArmPath):
    """A search and the path to execute (N, nq) [rad]: smoothed, or as far as the forward half
    came."""

    search: SearchPlan
    path: np.ndarray

    @property
    def placed(self) -> PlacedArm:  # type: ignore[override]
        """The arm."""
        return self.search.problem.placed

    @property
    def goal(self) -> np.ndarray:
        """Goal (nq,) [rad]."""
        return self.search.problem.goal

    @property
    def reached(self) -> bool:
        """Whether the goal is reached."""
        return self.search.reached

    @property
    def reason(self) -> StopReason:
        """Why the search ended."""
        return self.search.reason

    @cached_property
    def certificate(self) -> SearchEnd | None:
        """How the search ended; None if the goal is reached."""
        if self.reached:
            return None
        failure = None if self.search.problem.settings.two_sided else classify(self.search)
        return SearchEnd(self.search.gap, self.search.control_clearance, failure)

    @property
    def outside_limits(self) -> tuple[str, ...]:
        """Which of ``start``, ``goal`` and ``path`` leave the joint limits."""
        return leaves_limits(self.placed.arm, self.search.problem.start, self.goal, self.path)

    def to_frame(self) -> pd.DataFrame:
        """One row per step: joints q1 ... [rad], flange x, y, z [m]."""
        return pd.DataFrame(self.columns()).rename_axis("step")


def spliced(search: SearchPlan, settings: TwoArmSettings) -> SplicedPlan:
    """The smoothed path of a search; of halves that did not meet the forward one, as it is."""
    if not search.reached or len(search.path) < _SHORTEST:
        return SplicedPlan(search, search.path if search.reached else search.record.paths[0])
    return SplicedPlan(search, smoothed(search.path, settings.smoothing, settings.end_weight))


def plan_arms_bidirectional(
    scene: Scene, tasks: Mapping[str, Task[TwoArmSettings]], leave_out: tuple[str, ...] = ()
) -> CoordinatedPlan[SplicedPlan]:
    """Plan one arm, or a master and its slave, in the order of ``tasks``.

    Settings of the tasks are :class:`TwoArmSettings`; those of the slave say how it sees the
    master. Both paths run over the common samples of the time map.

    Raises
    ------
    InputError
        Not one or two tasks, or whatever the search finds wrong.
    """
    arms = {placed.name: placed for placed in scene.arms}
    if not 1 <= len(tasks) <= 2:
        raise InputError("bidirectional", "tasks", list(tasks), "one arm, or a master and a slave")
    obstacles = obstacles_of(scene, leave_out)
    (first, task), *rest = tasks.items()
    master = _planned(arms[first], task, obstacles)
    if not rest:
        return CoordinatedPlan(scene, {first: master}, {first: JointPath(master.path)})
    ((second, task),) = rest
    spread = task.settings.spread or max(1, len(master.path) // 2)
    circles, both = joint_circles(arms[first].arm, task.settings), task.settings.two_sided
    hulls = hull_tracks(arms[first], master.path, circles, spread, both)
    slave = _planned(arms[second], task, obstacles, hulls)
    paths = dict(zip(tasks, _played(master.path, slave, spread), strict=True))
    played = {name: JointPath(path) for name, path in paths.items()}
    plans = {first: replace(master, path=paths[first]), second: replace(slave, path=paths[second])}
    return CoordinatedPlan(scene, plans, played)


def _planned(
    placed: PlacedArm,
    task: Task[TwoArmSettings],
    obstacles: Obstacles,
    hulls: tuple[HullTrack, HullTrack] | None = None,
) -> SplicedPlan:
    ends = task.start, task.goal
    found = plan_bidirectional_compiled(placed, *ends, obstacles, task.settings, hulls)
    return spliced(found, task.settings)


def _played(master: np.ndarray, slave: SplicedPlan, spread: int) -> tuple[np.ndarray, np.ndarray]:
    """Both paths on common samples; a slave that stops early stays while the master goes on."""
    if slave.reached:
        share = time_map(slave.search, spread)
    else:
        end = 0.5 if slave.search.problem.settings.two_sided else 1.0
        share = shares(slave.search.searches, spread, end)
    rest = share[-1] < 1.0
    path = np.vstack([slave.path, slave.path[-1]]) if rest else slave.path
    return replay(master, path, np.append(share, 1.0) if rest else share, spread)


def joint_circles(arm: Arm, settings: TwoArmSettings) -> JointCircles:
    """Circles at all joint origins and the flange, by default as wide as the widest capsule."""
    radius = settings.hull_radius or float(control_points(arm, "capsules").radius.max())
    frames = tuple(range(1, arm.nq + 2))
    return JointCircles(frames, (radius,) * len(frames), settings.hull_points)


def one_sided(settings: TwoArmSettings) -> TwoArmSettings:
    """The classic search from the start, with constant gain and step."""
    return settings.changed(
        two_sided=False,
        variable_gain={"rule": "constant"},
        step=settings.step.changed(rule=StepRule.CONSTANT),
    )
