"""Control barrier functions of pink as a planner: a posture task behind a distance barrier.

A. D. Ames et al., Control barrier functions: theory and applications, ECC 2019. pink bounds the
approach of the closest pairs, dd/dt >= -gamma (d - d_min), in the differential inverse kinematics
of S. Caron et al., Pink, 2022.
"""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ..errors import UnsupportedArmError
from ..planning.planner import Ending, FoundPath, PathProblem
from .ompl_problem import EXTRA
from .pinocchio_scene import whole_model

_STEP, _PAIRS, _GAIN = 0.02, 12, 5.0  # [s], closest pairs that count, gamma [1/s]
_ARRIVED, _STILL, _WINDOW, _MOST_STEPS = 1e-3, 1e-4, 50, 1500


def barrier(problem: PathProblem) -> FoundPath:
    """The CBF quadratic program of pink: posture task behind a barrier on the closest pairs."""
    try:
        import pink
        from pink.barriers import SelfCollisionBarrier
        from pink.tasks import PostureTask
    except ImportError:
        raise UnsupportedArmError(f"cbf-qp needs the package pin-pink (extra `{EXTRA}`)") from None
    problem.at_rest("cbf-qp")
    model, geometry = whole_model(problem.scene)
    count = min(_PAIRS, len(geometry.collisionPairs))
    guard = SelfCollisionBarrier(count, _GAIN, safe_displacement_gain=0.0, d_min=problem.margin)
    task = PostureTask(cost=1.0, gain=_GAIN * _STEP)
    task.set_target(problem.goal)
    state = pink.Configuration(
        model, model.createData(), problem.start.copy(),
        collision_model=geometry, collision_data=pin.GeometryData(geometry),
    )  # fmt: skip
    rows, lower, upper = [problem.start], *problem.limits
    for step in range(min(_MOST_STEPS, problem.settings.evaluations)):
        q = rows[-1]
        if np.abs(problem.goal - q).max() <= _ARRIVED:
            return FoundPath(np.array([*rows, problem.goal]), Ending.REACHED)
        problem.evaluations += 1
        try:
            velocity = pink.solve_ik(
                state, [task], _STEP, solver="daqp", safety_break=False,
                barriers=[guard] if count else None,
            )  # fmt: skip
        except pink.exceptions.PinkError:
            return FoundPath(np.array(rows), Ending.STUCK)
        rows.append(np.clip(q + _STEP * velocity, lower, upper))
        state.update(rows[-1])
        if step >= _WINDOW and np.abs(rows[-1] - rows[-1 - _WINDOW]).max() < _STILL:
            return FoundPath(np.array(rows), Ending.STUCK)
    return FoundPath(np.array(rows), Ending.BUDGET)
