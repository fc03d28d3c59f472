"""Trajectory optimisation by crocoddyl: joint velocities over a fixed number of knots.

x_(k+1) = x_k + u_k minimises sum_k 1/2 w_u |u_k|^2 + 1/2 w_c sum_p max(0, m - d_p(x_k))^2 and
1/2 w_g |x_K - q_g|^2 at the last knot, by feasibility-driven differential dynamic programming:
C. Mastalli et al., Crocoddyl: an efficient and versatile framework for multi-contact optimal
control, ICRA 2020. It starts from the straight joint line, and from lines through random
configurations where that ends in contact.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import UnsupportedArmError
from ..planning.planner import Ending, FoundPath, PathProblem
from ..scene import densify
from .ompl_problem import EXTRA

_KNOTS, _ITERATIONS, _SWEEPS, _STARTS = 30, 30, 3, 4
_EFFORT, _CONTACT, _GOAL = 1.0, 1e4, 1e4  # w_u [1/rad^2], w_c [1/m^2], w_g [1/rad^2]
_RANGE = 0.03  # kept beyond the margin, so that it holds between the knots [m]
_NEAR = 1e-2  # [rad]


def shooting(problem: PathProblem) -> FoundPath:
    """Trajectory optimisation by crocoddyl (FDDP) with penalised distances of all pairs."""
    try:
        import crocoddyl
    except ImportError:
        raise UnsupportedArmError(
            f"trajectory optimisation needs the package crocoddyl (extra `{EXTRA}`)"
        ) from None
    problem.at_rest("trajectory-optimisation")
    model = _knot_model(problem)
    start, goal, rng = problem.start, problem.goal, np.random.default_rng(problem.settings.seed)
    best = start[np.newaxis]
    for attempt in range(_STARTS):
        via = 0.5 * (start + goal)
        if attempt:
            via = via + rng.normal(scale=0.5, size=len(via))
        path = _optimised(crocoddyl, problem, model, np.clip(via, *problem.limits))
        arrived = np.abs(path[-1] - goal).max() <= _NEAR
        if arrived:
            path[-1] = goal
            best = path
            if _clear(problem, path):
                return FoundPath(path, Ending.REACHED)
        if problem.spent:
            return FoundPath(best, Ending.BUDGET)
    return FoundPath(best, Ending.DIVERGED)


def _optimised(crocoddyl: Any, problem: PathProblem, model: Any, via: np.ndarray) -> np.ndarray:
    half = _KNOTS // 2
    line = np.concatenate([
        np.linspace(problem.start, via, half, endpoint=False),
        np.linspace(via, problem.goal, _KNOTS + 1 - half),
    ])  # fmt: skip
    running, last = model(final=False), model(final=True)
    shots = crocoddyl.ShootingProblem(problem.start, [running] * _KNOTS, last)
    solver = crocoddyl.SolverFDDP(shots)
    states, speeds = list(line), list(np.diff(line, axis=0))
    for _ in range(_ITERATIONS // _SWEEPS):  # in portions, since each may be the last
        done = solver.solve(states, speeds, _SWEEPS, True)
        states, speeds = list(solver.xs), list(solver.us)
        if done or problem.spent:
            break
    return np.clip(np.array(solver.xs), *problem.limits)


def _clear(problem: PathProblem, path: np.ndarray) -> bool:
    """Whether the planner's own look at its path, at the resolution, finds no contact."""
    rows, _ = densify(path, problem.settings.resolution)
    return all(problem.clearance(q) > 0.0 for q in rows)


def _knot_model(problem: PathProblem) -> Any:
    import crocoddyl

    size, keep = len(problem.start), problem.margin + _RANGE

    class Knot(crocoddyl.ActionModelAbstract):
        """One knot of the path; the last one has the goal instead of a velocity."""

        def __init__(self, final: bool) -> None:
            super().__init__(crocoddyl.StateVector(size), size, 0)
            self.final = final

        def calc(self, data: Any, x: np.ndarray, u: np.ndarray | None = None) -> None:
            q = np.array(x)
            short = np.maximum(keep - problem.distances(q), 0.0)
            data.cost = 0.5 * _CONTACT * float(short @ short)
            if self.final:
                data.cost += 0.5 * _GOAL * float(((q - problem.goal) ** 2).sum())
            if u is not None:
                data.cost += 0.5 * _EFFORT * float(u @ u)
                data.xnext = q + u
            else:
                data.xnext = q

        def calcDiff(self, data: Any, x: np.ndarray, u: np.ndarray | None = None) -> None:
            q = np.array(x)
            clearance, gradient = problem.gradient(q)
            short = np.maximum(keep - clearance.distance, 0.0)
            near = gradient[short > 0.0]
            data.Lx = -_CONTACT * short[short > 0.0] @ near
            data.Lxx = _CONTACT * near.T @ near
            if self.final:
                data.Lx = data.Lx + _GOAL * (q - problem.goal)
                data.Lxx = data.Lxx + _GOAL * np.eye(size)
            if u is not None:
                data.Fx, data.Fu = np.eye(size), np.eye(size)
                data.Lu, data.Luu = _EFFORT * np.array(u), _EFFORT * np.eye(size)

    return Knot
