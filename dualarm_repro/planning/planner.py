"""What a planner is: one function from a problem to a path of all arms at once.

A planner of one's own is a function of this form, named by an entry point of the group
:data:`GROUP`; ``dualarm methods`` lists it, ``plan`` runs it and ``arena`` judges it. It is given a
copy of the problem (:mod:`.foreign`): what it writes into is never what it is judged by.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Annotated, Protocol

import numpy as np
from pydantic import Field

from ..arguments import FILLED, LATER, Number, Shape, checked
from ..errors import InputError
from ..scene import JointPath, MovingArm, Scene, distances
from ..scene.clearance import Clearance
from ..scene.gradients import clearance_gradient
from ..settings import Positive, Settings

#: Entry points of this group are planners.
GROUP = "dualarm_repro.planners"
#: No search leaves its ends by more [rad, m]; files state limits of 1e16, of which nothing could be
#: drawn.
FARTHEST = 25.0


class PlannerSettings(Settings):
    """What every planner of this form is set up with."""

    seed: int = Field(default=0, ge=0, description="of whatever the planner draws")
    evaluations: int = Field(
        default=20_000, ge=2, description="configurations whose distances it may ask for"
    )
    margin: float = Field(
        default=0.005, ge=0, description="distance to keep, where start and goal have it [m]"
    )
    resolution: Positive = Field(
        default=0.02, description="largest way of a joint between configurations of a path [rad]"
    )


class Ending(StrEnum):
    """Why a planner ended."""

    REACHED = "reached"
    BUDGET = "evaluations used up"
    STUCK = "stuck"
    DIVERGED = "not converged"


@checked
@dataclass(frozen=True, eq=False)
class FoundPath:
    """A path (N, nq) [rad] of all arms, linear between rows, and what its planner says of it.

    A planner that did not arrive gives the path as far as it came, at least the start.
    """

    path: Annotated[np.ndarray, Shape("N", "nq"), FILLED]
    reason: str

    @property
    def claimed(self) -> bool:
        """Whether the planner says that it arrived without contact."""
        return self.reason == Ending.REACHED


@checked
@dataclass(eq=False)
class PathProblem:
    """Two configurations of all arms of a scene, and counted access to its distances.

    Attributes
    ----------
    scene : Scene
        Every arm with a task is controlled; parked arms are obstacles.
    start, goal : ndarray (nq,)
        Of the arms one after the other [rad].
    settings : PlannerSettings
    evaluations : int
        Configurations whose distances have been asked for so far.
    """

    scene: Scene
    start: Annotated[np.ndarray, LATER]
    goal: Annotated[np.ndarray, LATER]
    settings: PlannerSettings = field(default_factory=PlannerSettings)
    evaluations: Number = 0

    def __post_init__(self) -> None:
        self.start = self.scene.configurations(self.start)
        self.goal = self.scene.configurations(self.goal)
        self._margin: float | None = None

    @property
    def spent(self) -> bool:
        """Whether all evaluations are used up."""
        return self.evaluations >= self.settings.evaluations

    @property
    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        """Limits of the joints (nq,) [rad, m], finite and wide enough for start and goal: those of
        a continuous joint are two turns apart, or reach to an end that lies farther; none is more
        than ``FARTHEST`` away from both ends."""
        lower, upper = self.scene.limits
        ends = np.array([self.start, self.goal])
        first, last = ends.min(axis=0), ends.max(axis=0)
        lower, upper = np.maximum(lower, first - FARTHEST), np.minimum(upper, last + FARTHEST)
        return np.minimum(lower, first), np.maximum(upper, last)

    @property
    def margin(self) -> float:
        """Distance to keep: that of the settings, or half of what start and goal have [m]."""
        if self._margin is None:
            ends = distances(self.scene, np.array([self.start, self.goal]))
            least = float(ends.min(initial=np.inf))
            self._margin = float(np.clip(0.5 * least, 0.0, self.settings.margin))
        return self._margin

    def distances(self, q: np.ndarray, time: float = 0.0) -> np.ndarray:
        """Distances (P,) of all watched pairs at q (nq,) [m]."""
        self.evaluations += 1
        return distances(self.scene, q, time)

    def clearance(self, q: np.ndarray, time: float = 0.0) -> float:
        """The smallest of them [m]; infinite without a pair."""
        return float(self.distances(q, time).min(initial=np.inf))

    def gradient(self, q: np.ndarray, time: float = 0.0) -> tuple[Clearance, np.ndarray]:
        """Distances (P,) of all pairs [m] and their gradients (P, nq) [m/rad]."""
        self.evaluations += 1
        return clearance_gradient(self.scene, q, time)

    @checked
    def at_rest(self, method: str) -> None:
        """Raise if something moves by itself, for a method that knows no time.

        Raises
        ------
        InputError
            Naming the first body that moves.
        """
        for name, mover in self.scene.moving.items():
            if not isinstance(mover, MovingArm) or len(mover.path.index) > 1:
                raise InputError(method, "moving", name, "a scene in which only the arms move")

    @checked
    def without(self, others: dict[str, Annotated[np.ndarray, LATER]]) -> PathProblem:
        """The same for fewer arms: ``others`` (nq,) [rad] stand where it says."""
        scene = self.scene
        for name, q in others.items():
            scene = scene.replaying(name, JointPath([q]))
        start, goal = (
            np.concatenate([end[self.scene.columns[name]] for name in scene.columns])
            for end in (self.start, self.goal)
        )
        left = max(self.settings.evaluations - self.evaluations, 2)
        return PathProblem(scene, start, goal, self.settings.changed(evaluations=left))


class PathPlanner(Protocol):
    """A planner: its name is that of the entry point, the first line of its docstring describes it.

    It may ask ``problem`` for as many distances as the settings allow, draws only from generators
    seeded with ``problem.settings.seed``, and raises an error of :mod:`dualarm_repro.errors` for a
    problem it cannot take.
    """

    def __call__(self, problem: PathProblem, /) -> FoundPath:
        """The path that is found, or as far as it came."""
        ...
