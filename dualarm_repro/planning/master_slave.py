"""Arms planned in turn: the master first, then each slave around the motions planned before it.

Prioritised planning: M. Erdmann and T. Lozano-Perez, On multiple moving objects, Algorithmica 2,
1987.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import NonNegative, Positive, Shape, checked
from ..errors import InputError, UnknownNameError
from ..scene import JointPath, PlacedArm, Scene
from ..settings import Settings
from .arm_path import ArmPath
from .checks.link_clearance import LinkClearance, link_clearance
from .descent.compiled import plan_apf_compiled
from .field.control_points import ControlPoints, control_points
from .field.obstacles import Obstacles, obstacles_of
from .plan import Plan
from .settings import APFSettings, PointSet

Planner = Callable[[PlacedArm, ArrayLike, ArrayLike, Obstacles, APFSettings], Plan]
#: Which points of an arm repel the next one: those it is planned with, or others by name or number.
MasterPoints = Literal["joint_points"] | PointSet | Sequence[int]
_Settings_co = TypeVar("_Settings_co", bound=Settings, covariant=True)
_Plan_co = TypeVar("_Plan_co", bound=ArmPath, covariant=True)


@checked
@dataclass(frozen=True, eq=False)
class Task(Generic[_Settings_co]):
    """What one arm is to do.

    Attributes
    ----------
    start, goal : (nq,)
        [rad]
    settings : Settings
        Of the planner.
    index : (steps + 1,), optional
        When the later arms meet each configuration of this one, in their steps; default its own
        steps, so that all arms make one step at a time.
    """

    start: Annotated[ArrayLike, Shape("n")]
    goal: Annotated[ArrayLike, Shape("n")]
    settings: _Settings_co
    index: Callable[[Plan], np.ndarray] | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.settings, Settings):
            raise InputError("Task", "settings", self.settings, "the settings of a planner")


@dataclass(frozen=True, eq=False)
class CoordinatedPlan(Generic[_Plan_co]):
    """Plans of several arms over a common index; an arm that has arrived stays at its goal.

    Attributes
    ----------
    scene : Scene
    plans : mapping of arm to its plan
        In the order of planning.
    paths : dict of arm to JointPath
        The same motions over the common index, the steps of the last arm.
    residuals : dict of arm to float
        How far the posture planned to misses the point asked for, where that is out of reach [m].
    """

    scene: Scene
    plans: Mapping[str, _Plan_co]
    paths: dict[str, JointPath] = field(repr=False)
    residuals: dict[str, float] = field(default_factory=dict)

    @property
    def master(self) -> _Plan_co:
        """The first plan."""
        return next(iter(self.plans.values()))

    @property
    def slave(self) -> _Plan_co:
        """The last plan."""
        return list(self.plans.values())[-1]

    @property
    def index(self) -> np.ndarray:
        """0, 1, ... until every arm has arrived."""
        return np.arange(1.0 + max(np.ceil(path.index[-1]) for path in self.paths.values()))

    @checked
    def links(self, max_step: Positive) -> LinkClearance:
        """Distances of whole links, see :func:`.link_clearance.link_clearance`."""
        return link_clearance(self.scene, self.paths, max_step)


@checked
def plan_master_slave(
    scene: Scene,
    tasks: Mapping[str, Task[APFSettings]],
    *,
    master_points: MasterPoints = "joint_points",
    radius: NonNegative | None = None,
    leave_out: Collection[str] = (),
    planner: Planner = plan_apf_compiled,
) -> CoordinatedPlan[Plan]:
    """Plan the arms in the order of ``tasks``; each meets all earlier ones as moving obstacles.

    An arm is planned without regard to those that come later. Obstacles and earlier arms are met
    step by step, at the same index.

    Parameters
    ----------
    master_points : "joint_points", name of a point set, or frame numbers
        What of an earlier arm repels; ``joint_points`` are the control points it was planned with.
    radius : float, optional
        Of these points [m]; default 0, or the radii of the capsules.
    leave_out : names
        Obstacles the planner is not told about.
    planner : callable
        Default :func:`.compiled.plan_apf_compiled`.

    Raises
    ------
    UnknownNameError
        The scene has no arm of that name.
    InputError
        Whatever the planner finds wrong, or no task.
    """
    arms = {placed.name: placed for placed in scene.arms}
    if not tasks:
        raise InputError("plan_master_slave", "tasks", {}, f"a task for one of {', '.join(arms)}")
    obstacles = obstacles_of(scene, leave_out)
    plans: dict[str, Plan] = {}
    paths: dict[str, JointPath] = {}
    for name, task in tasks.items():
        if name not in arms:
            raise UnknownNameError("plan_master_slave", "arm", name, f"one of {', '.join(arms)}")
        plan = planner(arms[name], task.start, task.goal, obstacles, task.settings)
        plans[name], paths[name] = plan, JointPath(plan.path, task.index and task.index(plan))
        points = _points(plan, task, master_points, radius)
        obstacles = obstacles.with_arm(arms[name], points, paths[name])
    return CoordinatedPlan(scene, plans, paths)


@checked
def at_tool_speed(step: Positive) -> Callable[[Plan], np.ndarray]:
    """Index of a plan at which its flange advances ``step`` [m] per step of the later arms.

    A piece of path on which the flange rests takes a thousandth of a step.
    """

    def index(plan: Plan) -> np.ndarray:
        advance = np.linalg.norm(np.diff(plan.tcp, axis=0), axis=1) / step
        return np.concatenate([[0.0], np.cumsum(np.maximum(advance, 1e-3))])

    return index


def _points(
    plan: Plan, task: Task[APFSettings], choice: MasterPoints, radius: float | None
) -> ControlPoints:
    chosen = task.settings.control_points if choice == "joint_points" else choice
    return control_points(plan.placed.arm, chosen, radius=radius)
