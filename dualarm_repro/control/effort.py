"""What a motion costs the drives: work, the part that drives, and the heat of the motors.

tau = M(q) dx/dt + c(q, x) + g(q) by inverse dynamics (Featherstone 2008, recursive Newton-Euler),
with the inertias of the models and gravity along -z;

work    integral of sum |tau_i x_i|          nothing is won back in braking
driven  integral of sum max(tau_i x_i, 0)    braking costs nothing
heat    integral of sum tau_i^2              what the windings lose, up to a factor
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pinocchio as pin

from .motion import Motion
from .system import ArmSystem


class Effort(NamedTuple):
    """``work`` and ``driven`` [J], ``heat`` [N^2 m^2 s]."""

    work: float
    driven: float
    heat: float


def effort(system: ArmSystem, motion: Motion) -> Effort:
    """Effort of a motion; its bases stand upright."""
    x = motion.x
    if len(x) < 2:
        return Effort(0.0, 0.0, 0.0)
    changes, start = np.gradient(x, motion.dt, axis=0), system.arrays.start
    work = driven = heat = 0.0
    for k, placed in enumerate(system.arms):
        part, model = slice(start[k], start[k + 1]), placed.arm.model
        data = model.createData()
        for q, v, a in zip(motion.q[:-1, part], x[:, part], changes[:, part], strict=True):
            torque = pin.rnea(model, data, q, v, a)
            power = torque * v
            work += float(np.abs(power).sum())
            driven += float(power.clip(min=0.0).sum())
            heat += float((torque**2).sum())
    return Effort(*(motion.dt * total for total in (work, driven, heat)))
