"""The mutual-avoidance quadratic program as a planner: straight to the goal, as far as it lets.

At each step x minimises 1/2 |x - x_g|^2 with x_g = K (q_g - q), scaled down to the speed limits,
under -grad d . x <= beta(d) for every pair within the outer range and the joint bounds; then
q <- q + dt x. Every pair of the scene gives a row, those of arms and obstacles alike: B. Faverjon
and P. Tournassoud, A local based approach for path planning of manipulators with a high number of
degrees of freedom, ICRA 1987.
"""

from __future__ import annotations

import numpy as np

from ..control import ControllerSettings, NoSolution, QuadraticProgram, solve
from ..control.damper import approach_bound
from ..planning.planner import Ending, FoundPath, PathProblem
from ..settings import code

_GAIN, _STEP = 2.0, 0.02  # K [1/s], dt [s]
_ARRIVED, _STILL = 1e-4, 1e-4  # [rad]
_WINDOW = 50  # steps over which standing still is noticed
_MOST_STEPS = 3000


def mutual_avoidance(problem: PathProblem) -> FoundPath:
    """The mutual-avoidance QP, driving all arms straight to their goals in joint space."""
    inner = problem.margin
    settings = ControllerSettings(inner=inner, outer=inner + 0.07)
    number = code(settings.damper)
    lower, upper = problem.limits
    fastest = np.concatenate([placed.arm.velocity_limit for placed in problem.scene.arms])
    q = problem.start.copy()
    rows = [q]
    for step in range(min(_MOST_STEPS, problem.settings.evaluations)):
        away = problem.goal - q
        if np.abs(away).max() <= _ARRIVED:
            return FoundPath(np.array([*rows, problem.goal]), Ending.REACHED)
        target = _GAIN * away
        target /= max(1.0, float((np.abs(target) / fastest).max()))
        clearance, gradient = problem.gradient(q, float(step))
        near = np.flatnonzero(clearance.distance < settings.outer)
        bound = [
            approach_bound(number, d, settings.damper_gain, settings.outer, inner)
            for d in clearance.distance[near].tolist()
        ]
        low = np.clip(settings.limit_gain * (lower - q), -fastest, fastest)
        high = np.clip(settings.limit_gain * (upper - q), -fastest, fastest)
        none = np.zeros((0, len(q)))
        program = QuadraticProgram(target, none, [], -gradient[near], bound, low, high)
        try:
            x = solve(program).x
        except NoSolution:
            return FoundPath(np.array(rows), Ending.STUCK)
        q = q + _STEP * x
        rows.append(q)
        if step >= _WINDOW and np.abs(q - rows[-_WINDOW]).max() < _STILL:
            return FoundPath(np.array(rows), Ending.STUCK)
    return FoundPath(np.array(rows), Ending.BUDGET)
