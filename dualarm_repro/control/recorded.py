"""Problems recorded along a motion, for a contest of solvers on equal terms."""

from __future__ import annotations

import numpy as np

from ..arguments import Count, checked
from .circle import Circles
from .controller import VelocityController
from .motion import Motion
from .parts import ProgramParts, ProgramStack
from .problem import QuadraticProgram
from .settings import ControllerSettings
from .system import ArmSystem


@checked
def recorded_problems(
    system: ArmSystem, circles: Circles, motion: Motion, settings: ControllerSettings, every: Count
) -> list[QuadraticProgram]:
    """The problem of each ``every``-th step of a motion."""
    controller = VelocityController(system, settings, home=motion.q[0])
    return [
        controller.problem(motion.q[k], *circles.at(motion.time[k]))
        for k in range(0, len(motion.x), every)
    ]


def stacked(problems: list[QuadraticProgram]) -> ProgramStack:
    """All problems in arrays with a leading axis, for the kernels."""
    rows = np.array([len(p.h) for p in problems])
    n, most = problems[0].size, int(rows.max(initial=0))
    G, h = np.zeros((len(problems), most, n)), np.zeros((len(problems), most))
    for k, p in enumerate(problems):
        G[k, : rows[k]], h[k, : rows[k]] = p.G, p.h
    target, A, b, lower, upper = (
        np.array([getattr(p, name) for p in problems])
        for name in ("target", "A", "b", "lower", "upper")
    )
    return ProgramStack(ProgramParts(target, A, b, G, h, lower, upper), rows)
