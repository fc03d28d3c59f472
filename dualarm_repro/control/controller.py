"""One control step for a user: joint velocities that follow the tips and keep the arms apart."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..annotation import real_array
from ..arguments import checked
from ..errors import InputError
from .assembly import make_buffers, stated_in
from .few_constraints import make_work
from .least_distance import INFEASIBLE, SOLVED
from .problem import CERTIFIED, NoSolution, QuadraticProgram, Solution
from .relaxed import least_distance_with_slack
from .settings import ControllerSettings
from .simulate import SLACK_WEIGHT
from .solvers import second_opinion
from .step import NOT_FINITE, make_step, taken
from .system import ArmSystem


@checked
class VelocityController:
    """min 1/2 |x + lambda (q - q_0)|^2 under task, avoidance rows and joint bounds, step by step.

    Parameters
    ----------
    system : ArmSystem
    settings : ControllerSettings
    home : (n,), optional
        q_0 of the repetitive term [rad]; default: the first configuration asked for.
    slack : bool
        Let the task yield where it excludes the inequalities, rather than raise.

    Raises
    ------
    InputError, ConfigurationError
        Bad settings or home.
    """

    def __init__(
        self,
        system: ArmSystem,
        settings: ControllerSettings | None = None,
        *,
        home: ArrayLike | None = None,
        slack: bool = False,
    ) -> None:
        self.system, self.settings, self.slack = system, settings or ControllerSettings(), slack
        self._numbers = self.settings.numbers()
        self._buffers = make_buffers(system.arrays, self._numbers)
        n, arms = system.nq, len(system.arms)
        self._work = make_work(n, 3 * arms, len(self._buffers.program.h))
        self._step: Any = None
        self._count: int = 0
        self._distance: float = np.inf
        self._shapes = (n,), (arms, 3), (arms, 3)
        if home is not None:
            self._begin(system.configuration(home))

    def velocity(self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike) -> np.ndarray:
        """Joint velocity for tips that shall be at ``position`` and move at ``velocity``.

        Parameters
        ----------
        q : (n,) [rad]
        position, velocity : (A, 3) [m], [m/s]

        Returns
        -------
        ndarray (n,) [rad/s]

        Raises
        ------
        ConfigurationError, InputError
            NaN, infinity or a wrong shape.
        NoSolution
            The constraints exclude each other, or the answer fails its certificate.
        """
        x = np.empty(self._shapes[0])
        status, worst = self._take(q, position, velocity, x)
        if status == SOLVED and worst <= CERTIFIED:
            return x
        return self._yielding(status).x

    def solution(self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike) -> Solution:
        """The same with multipliers, slack and certificate."""
        status, worst = self._take(q, position, velocity, np.empty(self._shapes[0]))
        if status == SOLVED and worst <= CERTIFIED:
            w = self._work
            parts = w.x, w.y, w.z[: self._count], w.w
            return Solution(self._problem(), *(part.copy() for part in parts))
        return self._yielding(status)

    def problem(self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike) -> QuadraticProgram:
        """The problem of this step, as stated, for any solver."""
        self._take(q, position, velocity, np.empty(self._shapes[0]))
        return self._problem()

    @property
    def distance(self) -> float:
        """Smallest surface distance at the configuration asked for last [m]."""
        return self._distance

    @property
    def tips(self) -> np.ndarray:
        """Flange positions at the configuration asked for last (A, 3) [m]."""
        return self._buffers.tips.copy()

    def _begin(self, home: np.ndarray) -> None:
        """Bind everything that stays from step to step."""
        parts = self.system.arrays, self._numbers, home.copy(), self._buffers, self._work
        self._step = make_step(*parts)

    def _take(
        self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike, x: np.ndarray
    ) -> tuple[int, float]:
        """Take one step, after the checks; status and residual."""
        given: tuple = (q, position, velocity)
        # Arrays of floats of the right shape are looked at by the compiled step itself.
        if self._step is not None and all(
            type(one) is np.ndarray and one.dtype == np.float64 and one.shape == shape
            for one, shape in zip(given, self._shapes, strict=True)
        ):
            given = tuple(np.ascontiguousarray(one) for one in given)
            status, count, worst, distance = taken(self._step, *given, x)
            if status != NOT_FINITE:
                self._count, self._distance = count, distance
                return status, worst
        q = self.system.configuration(q)
        given = q, self._tips("position", position), self._tips("velocity", velocity)
        if self._step is None:
            self._begin(q)
        status, self._count, worst, self._distance = taken(self._step, *given, x)
        return status, worst

    def _tips(self, name: str, value: ArrayLike) -> np.ndarray:
        try:
            array = np.ascontiguousarray(real_array(value))
        except (TypeError, ValueError):
            raise InputError("controller", name, value, "finite numbers") from None
        if array.shape != self._buffers.tips.shape:
            raise InputError(
                "controller", f"shape of {name}", array.shape, str(self._buffers.tips.shape)
            )
        if not np.isfinite(array).all():
            raise InputError(
                "controller", name, float(array[~np.isfinite(array)][0]), "finite numbers"
            )
        return array

    def _problem(self) -> QuadraticProgram:
        return stated_in(self._buffers, self._count)

    def _yielding(self, status: int) -> Solution:
        """Solution with slack, or the error that says what is wrong."""
        problem = self._problem()
        if (other := second_opinion(problem)) is not None:
            return other
        if self.slack:
            status, *parts = least_distance_with_slack(problem.parts, SLACK_WEIGHT)
            solution = Solution(problem, *parts)
            if status == SOLVED and solution.certified():
                return solution
        exclude = "the task and the inequalities exclude each other"
        reason = exclude if status == INFEASIBLE else "the answer fails its certificate"
        raise NoSolution("controller", problem, reason)
