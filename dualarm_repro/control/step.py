"""One control step compiled as a whole: kinematics, distances, rows, minimiser, certificate."""

from __future__ import annotations

import numpy as np
from numba import types
from numba.experimental import structref

from ..kernel import kernel
from .assembly import sense_near, state
from .certificate import residual
from .few_constraints import minimise

#: Status of a step that was asked for with NaN or infinity.
NOT_FINITE = -1


@kernel
def control_step(arrays, numbers, q, home, position, velocity, buffers, work):
    """State, solve and certify one step: status, number of rows, residual, smallest distance.

    The joint velocity and the multipliers are left in ``work``, the problem in ``buffers``.
    """
    count, smallest = sense_near(arrays, numbers, q, np.empty(0), buffers)
    program = state(arrays, numbers, q, home, position, velocity, count, buffers)
    status = minimise(program, work)
    worst = residual(program, work.x, work.y, work.z, work.w)
    return status, len(program.h), worst, smallest


@structref.register
class StepType(types.StructRef):
    """Type of a :class:`Step`."""


class Step(structref.StructRefProxy):
    """What stays from step to step as one argument: to hand over each array takes too long."""


structref.define_boxing(StepType, Step)
structref.define_constructor(Step, StepType, ["arrays", "numbers", "home", "buffers", "work"])


@kernel
def make_step(arrays, numbers, home, buffers, work):
    """The parts of a step as one argument."""
    return Step(arrays, numbers, home, buffers, work)


@kernel
def taken(step, q, position, velocity, x):
    """:func:`control_step` with the joint velocity written to ``x``."""
    finite = 0.0
    for i in range(len(q)):
        finite += 0.0 * q[i]
    for arm in range(len(position)):
        for r in range(3):
            finite += 0.0 * position[arm, r] + 0.0 * velocity[arm, r]
    if finite != 0.0:
        return NOT_FINITE, 0, np.inf, np.inf
    found = control_step(
        step.arrays, step.numbers, q, step.home, position, velocity, step.buffers, step.work
    )
    for i in range(len(x)):
        x[i] = step.work.x[i]
    return found
