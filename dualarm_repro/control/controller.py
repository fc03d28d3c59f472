"""One control step for a user: joint velocities that follow the tips and keep the arms apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..annotation import real_array
from ..arguments import checked
from ..errors import InputError
from ..kernel import kernel
from .assembly import make_buffers, sense, state
from .certificate import residual
from .least_distance import INFEASIBLE, SOLVED, least_distance
from .problem import CERTIFIED, NoSolution, QuadraticProgram, Solution
from .relaxed import least_distance_with_slack
from .settings import ControllerSettings
from .simulate import SLACK_WEIGHT
from .system import ArmSystem


@kernel
def stated(arrays, numbers, q, home, position, velocity, buffers):
    """Write the problem of one step into the buffers; returns it with the rows in use."""
    count = sense(arrays, numbers, q, np.empty(0), buffers)
    return state(arrays, numbers, q, home, position, velocity, count, buffers)


@kernel
def control_step(arrays, numbers, q, home, position, velocity, buffers):
    """State, solve and certify one step: status, number of rows, residual, joint velocity."""
    program = stated(arrays, numbers, q, home, position, velocity, buffers)
    status, x, y, z, w = least_distance(program)
    return status, len(program.h), residual(program, x, y, z, w), x


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
        self._home = None if home is None else system.configuration(home)

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
        arguments = self._checked(q, position, velocity)
        status, self._count, worst, x = control_step(*arguments, self._buffers)
        if status == SOLVED and worst <= CERTIFIED:
            return x
        return self._yielding(status).x

    def solution(self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike) -> Solution:
        """The same with multipliers, slack and certificate."""
        problem = self.problem(q, position, velocity)
        status, *parts = least_distance(problem.parts)
        found = Solution(problem, *parts) if status == SOLVED else None
        return found if found and found.certified() else self._yielding(status)

    def problem(self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike) -> QuadraticProgram:
        """The problem of this step, as stated, for any solver."""
        self._count = len(stated(*self._checked(q, position, velocity), self._buffers).h)
        return self._problem()

    @property
    def distance(self) -> float:
        """Smallest surface distance at the configuration asked for last [m]."""
        return float(self._buffers.surface.min(initial=np.inf))

    @property
    def tips(self) -> np.ndarray:
        """Flange positions at the configuration asked for last (A, 3) [m]."""
        return self._buffers.tips.copy()

    def _checked(self, q: ArrayLike, position: ArrayLike, velocity: ArrayLike) -> tuple:
        """Arguments of the compiled step."""
        q = self.system.configuration(q)
        if self._home is None:
            self._home = q.copy()
        position, velocity = self._tips("position", position), self._tips("velocity", velocity)
        return self.system.arrays, self._numbers, q, self._home, position, velocity

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
        p, k = self._buffers.program, self._count
        parts = p._replace(G=p.G[:k], h=p.h[:k])
        return QuadraticProgram(*(part.copy() for part in parts))

    def _yielding(self, status: int) -> Solution:
        """Solution with slack, or the error that says what is wrong."""
        problem = self._problem()
        if self.slack:
            status, *parts = least_distance_with_slack(problem.parts, SLACK_WEIGHT)
            solution = Solution(problem, *parts)
            if status == SOLVED and solution.certified():
                return solution
        exclude = "the task and the inequalities exclude each other"
        reason = exclude if status == INFEASIBLE else "the answer fails its certificate"
        raise NoSolution("controller", problem, reason)
