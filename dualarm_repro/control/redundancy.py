"""What redundancy leaves open: other postures with the same tips, other norms of the velocity."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from .controller import VelocityController
from .problem import QuadraticProgram
from .settings import ControllerSettings
from .simulate import pseudo_inverse
from .system import ArmSystem


def self_motion(system: ArmSystem, q: np.ndarray) -> np.ndarray:
    """A posture (n,) with the same tips as q, reached along the null space of J [rad].

    Steps (I - J^+ J) 1 of 0.01 rad with feedback on the tips, then steps of the feedback alone.
    """
    controller = VelocityController(system, pseudo_inverse(ControllerSettings()))
    tips, still = system.tips(q), np.zeros((len(system.arms), 3))
    moved, direction = q.copy(), np.ones(system.nq)
    for _ in range(400):
        p = controller.problem(moved, tips, still)
        J = np.linalg.pinv(p.A)
        moved = (
            moved + 1e-2 * (direction - J @ (p.A @ direction)) / np.sqrt(system.nq) + 0.05 * J @ p.b
        )
    for _ in range(20):
        p = controller.problem(moved, tips, still)
        moved = moved + 0.1 * np.linalg.pinv(p.A) @ p.b
    return moved


def inertia_weighted(system: ArmSystem, q: np.ndarray, p: QuadraticProgram) -> np.ndarray:
    """min x^T M(q) x under the task A x = b of a problem, M the joint-space inertia [rad/s]."""
    W = np.zeros((system.nq, system.nq))
    start = system.arrays.start
    for k, placed in enumerate(system.arms):
        part = slice(start[k], start[k + 1])
        model = placed.arm.model
        M = pin.crba(model, model.createData(), q[part])
        W[part, part] = np.triu(M) + np.triu(M, 1).T
    inverse = np.linalg.inv(W)
    return inverse @ p.A.T @ np.linalg.solve(p.A @ inverse @ p.A.T, p.b)
