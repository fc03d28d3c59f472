"""One control step of two seven-joint arms: kinematics, all distances, avoidance rows and QP."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from importlib.util import find_spec

import daqp
import numpy as np
from control_peers import Step, mink_step, pink_step
from equal_work import DifferentWork, reference, same
from timing import OURS, Row, timed

from dualarm_repro.control import QuadraticProgram
from dualarm_repro.control.controller import VelocityController
from dualarm_repro.control.settings import ControllerSettings
from dualarm_repro.control.simulate import simulate
from dualarm_repro.control.solvers import SOLVERS, solve
from dualarm_repro.papers.patent.document import frozen

TASK, SOLVED = "control step of two Pandas with avoidance", "velocity problem, certified answer"
LOOP = 200
SAME = 1e-3  # [m/s], [rad/s]


def measure() -> Iterator[Row]:
    """Rows of this suite; peers that are not installed are left out."""
    scenario, settings = frozen("crossing"), ControllerSettings()
    motion = simulate(scenario.system, scenario.circles, scenario.q0, settings)
    busy = np.flatnonzero(motion.rows > 0)
    picked = busy[:: max(1, len(busy) // LOOP)][:LOOP]
    samples = [(motion.q[k], *scenario.circles.at(motion.time[k])) for k in picked]
    controller = VelocityController(scenario.system, settings)
    steps: dict[str, Step] = {
        OURS: controller.velocity,
        "kinematics and rows here, DAQP": _daqp(controller),
    }
    for module, name, peer in (
        ("pink", "pin-pink, self-collision barrier", pink_step),
        ("mink", "mink, collision avoidance limit", mink_step),
    ):
        if find_spec(module):
            steps[name] = peer(scenario, settings)
    for name, step in steps.items():
        check = _same_motion(step, controller, samples)
        yield timed(TASK, name, _loop(step, samples), len(samples), check=check)
    yield from _solvers(controller, samples)


def _same_motion(
    step: Step, controller: VelocityController, samples: Sequence[tuple]
) -> Callable[[], str]:
    """Tips move as asked, and no pair of bodies comes nearer faster than the damper allows."""

    def check() -> str:
        off = approach = 0.0
        for sample in samples:
            x, p = step(*sample), controller.problem(*sample)
            off = max(off, float(np.abs(p.A @ x - p.b).max()))
            approach = max(approach, float((p.G @ x - p.h).max(initial=0.0)))
        if not (off <= SAME and approach <= SAME):
            raise DifferentWork(f"off the path by {off:.1e}, too near by {approach:.1e} m/s")
        return f"tips as asked, arms apart to {SAME:.0e} m/s"

    return check


def _solvers(controller: VelocityController, samples: Sequence[tuple]) -> Iterator[Row]:
    """The problems alone: the same minimiser from every solver, certified by each."""
    problems = [controller.problem(*sample) for sample in samples]
    for solver in SOLVERS:
        if solver == "cvxpy":  # a language for problems, not a solver for a loop
            continue
        ours = solver == "active_set"
        check = reference() if ours else _same_minimisers(problems, solver)
        call = partial(_solve_all, problems, solver)
        yield timed(SOLVED, OURS if ours else solver, call, len(problems), check=check)


def _same_minimisers(problems: Sequence[QuadraticProgram], solver: str) -> Callable[[], str]:
    return same(
        lambda: [solve(p).x for p in problems], lambda: [solve(p, solver).x for p in problems], SAME
    )


def _solve_all(problems: Sequence[QuadraticProgram], solver: str) -> None:
    for problem in problems:
        solve(problem, solver)


def _loop(step: Step, samples: Sequence[tuple]) -> Callable[[], None]:
    def run() -> None:
        for sample in samples:
            step(*sample)

    return run


def _daqp(controller: VelocityController) -> Step:
    def step(q: np.ndarray, position: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        p = controller.problem(q, position, velocity)
        m = len(p.b)
        rows, sense = np.vstack([p.A, p.G]), np.zeros(p.size + m + len(p.h), dtype=np.int32)
        sense[p.size : p.size + m] = 5
        upper = np.concatenate([p.upper, p.b, p.h])
        lower = np.concatenate([p.lower, p.b, np.full(len(p.h), -1e30)])
        return daqp.solve(np.eye(p.size), -p.target, rows, upper, lower, sense)[0]

    return step
