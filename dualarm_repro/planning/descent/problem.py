"""A planning problem: one arm, start, goal, obstacles and settings, checked once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ConfigurationError, InputError
from ...scene.bodies import PlacedArm
from ...settings import code
from ..field.control_points import ControlPoints, control_points, end_effector
from ..field.obstacles import Obstacles
from ..field.potentials import JointAttraction, PointRepulsion, PositionAttraction, Potential, Sum
from ..settings import APFSettings, Attraction, Combination, Repulsion
from .termination import largest_joint_error
from .virtual_point import NO_POINT, Switch, SwitchRules, acting

Attractions = Sum[tuple[PositionAttraction, JointAttraction]]

# Stands for the absence of repulsion: gain 0.
_NO_REPULSION = (0.0, 1.0, 0.5, Combination.SUM)


@dataclass(frozen=True, eq=False)
class PlanningProblem:
    """What a planner is given; build it with :func:`problem`."""

    placed: PlacedArm
    start: np.ndarray
    goal: np.ndarray
    obstacles: Obstacles
    settings: APFSettings
    points: ControlPoints

    @cached_property
    def goal_point(self) -> np.ndarray:
        """X_g, the flange at the goal in the world (3,) [m]."""
        return end_effector(self.placed, self.goal)

    @cached_property
    def attraction(self) -> Attractions:
        """U_att of the goal."""
        chosen = self.settings.attraction
        return _attraction(self.placed, chosen, self.goal_point, self.goal)

    @cached_property
    def repulsion(self) -> PointRepulsion:
        """U_rep of all obstacles; zero if the settings have none."""
        chosen = self.settings.repulsion
        numbers = _NO_REPULSION if chosen is None else _numbers(chosen)
        return PointRepulsion(self.placed, self.points, self.obstacles, *numbers)

    @cached_property
    def virtual(self) -> Attractions:
        """U_v of the virtual point; zero if the settings have none."""
        point = self.settings.virtual_point
        if point is None:
            none = Attraction.model_construct(gain=0.0, position_weight=0.0, joint_weight=0.0)
            return _attraction(self.placed, none, np.zeros(3), self.goal)
        weight = 0.0 if point.joints is None else point.joint_weight
        joints = self.goal if point.joints is None else np.array(point.joints)
        chosen = Attraction(gain=point.gain, joint_weight=weight)
        return _attraction(self.placed, chosen, np.array(point.position), joints)

    @cached_property
    def field(self) -> Sum[Sequence[Potential]]:
        """U_att + U_rep, in which a trap is judged."""
        return Sum([self.attraction, self.repulsion])

    def field_in(self, state: Switch) -> Sum[Sequence[Potential]]:
        """What the arm descends in a state of the virtual point."""
        goal, virtual = acting(state, self.switch_rules)
        parts: list[Potential] = [self.attraction] * goal
        return Sum([*parts, self.repulsion, *[self.virtual] * virtual])

    @cached_property
    def switch_rules(self) -> SwitchRules:
        """Rules of the virtual point."""
        point = self.settings.virtual_point
        if point is None:
            return SwitchRules(NO_POINT, 0.0, 0, 0)
        rule = code(point.switching)
        return SwitchRules(rule, point.release_distance, point.max_steps, point.max_activations)

    @property
    def tolerances(self) -> tuple[float, float]:
        """Of the joints [rad] and of the position [m]; infinite where none is demanded."""
        end = self.settings.termination
        return _or_infinite(end.joint_tolerance), _or_infinite(end.position_tolerance)

    @property
    def limits(self) -> tuple[np.ndarray, np.ndarray]:
        """Limits a step may not leave; infinite unless they are enforced."""
        return self.placed.arm.limits(self.settings.enforce_limits)

    def errors(self, q: np.ndarray) -> tuple[float, float]:
        """max_j |q_j - q_gj| [rad] and |X - X_g| [m]."""
        offset = end_effector(self.placed, q) - self.goal_point
        return float(largest_joint_error(q, self.goal)), float(np.linalg.norm(offset))

    def repels_at_goal(self, step: int) -> bool:
        """Whether an obstacle repels the arm at its goal."""
        return bool(self.repulsion.value(self.goal, step) > 0.0)


def problem(
    placed: PlacedArm,
    start: ArrayLike,
    goal: ArrayLike,
    obstacles: Obstacles,
    settings: APFSettings,
) -> PlanningProblem:
    """Check the parts of a problem and put them together.

    Raises
    ------
    ConfigurationError
        Start, goal or virtual joints of the wrong shape, with NaN or infinity, or outside the
        limits if these are enforced.
    InputError
        At the start a control point touches or is inside an obstacle; control points the arm lacks.
    """
    point = settings.virtual_point
    ends = checked_ends(placed, start, goal, settings.enforce_limits)
    if point is not None and point.joints is not None:
        _configuration(placed, "virtual_point.joints", point.joints)
    points = control_points(placed.arm, settings.control_points, settings.weights)
    made = PlanningProblem(placed, *ends, obstacles, settings, points)
    require_clear(made, made.start[np.newaxis])
    return made


def require_clear(made: PlanningProblem, starts: np.ndarray) -> None:
    """Raise InputError where a control point touches an obstacle at the first step.

    Parameters
    ----------
    starts : (N, nq)
    """
    distance = made.repulsion.distances(starts)
    if distance.size and distance.min() <= 0.0:
        n, k, m = np.unravel_index(distance.argmin(), distance.shape)
        expected = (
            f"{made.points.names[k]} outside {made.obstacles.names[m]}, "
            f"not at a distance of {distance[n, k, m]:.4g} m"
        )
        raise InputError(f"arm {made.placed.name}", "start", starts[n].tolist(), expected)


def checked_ends(
    placed: PlacedArm, start: ArrayLike, goal: ArrayLike, within_limits: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Start and goal (nq,) as float64 arrays of their own; ConfigurationError where one is wrong,
    or has to be and is not within the limits."""
    ends = _configuration(placed, "start", start), _configuration(placed, "goal", goal)
    for field, q in zip(("start", "goal"), ends, strict=True):
        if within_limits and not placed.arm.within_limits(q):
            raise ConfigurationError(f"arm {placed.name}", field, q, "a value within the limits")
    return ends


def checked_starts(placed: PlacedArm, starts: ArrayLike) -> np.ndarray:
    """Starts of a batch (N, nq), at least one; ConfigurationError where they are something else."""
    rows = np.atleast_2d(placed.arm.configurations(starts))
    if not len(rows):
        expected = f"at least one row of {placed.arm.nq} finite numbers [rad]"
        raise ConfigurationError(f"arm {placed.name}", "shape of starts", rows.shape, expected)
    return rows


def _configuration(placed: PlacedArm, field: str, q: ArrayLike) -> np.ndarray:
    source, expected = f"arm {placed.name}", f"{placed.arm.nq} finite numbers [rad]"
    try:
        checked = placed.arm.configurations(q)
    except ConfigurationError as error:
        raise ConfigurationError(source, field, error.value, expected) from None
    if checked.ndim != 1:
        raise ConfigurationError(source, field, checked.shape, expected)
    return checked.copy()


def _attraction(
    placed: PlacedArm, chosen: Attraction, position: np.ndarray, joints: np.ndarray
) -> Attractions:
    return Sum(
        (
            PositionAttraction(placed, position, chosen.gain * chosen.position_weight),
            JointAttraction(joints, chosen.gain * chosen.joint_weight),
        )
    )


def _or_infinite(tolerance: float | None) -> float:
    return np.inf if tolerance is None else tolerance


def _numbers(chosen: Repulsion) -> tuple[float, float, float, Combination]:
    return chosen.gain, chosen.influence, chosen.contact, chosen.combination
