"""Reach of an arm: how far its flange comes, and two bases within reach of each other."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import scipy

from .arm import Arm


def largest_reach(arm: Arm, rng: np.random.Generator, draws: int = 20_000) -> float:
    """max |p(q)|, the largest distance of the flange from the base, joint limits left aside [m].

    Best of some random configurations, polished by quasi-Newton steps with the exact Jacobian.

    Raises
    ------
    UnsupportedArmError
        A joint slides: without its limits there is no largest distance.
    """
    arm.chain  # noqa: B018  refuses
    q = rng.uniform(-np.pi, np.pi, (draws, arm.nq))
    best = q[np.argmax(np.linalg.norm(arm.fk(q)[:, :3, 3], axis=1))]

    def negative_square(configuration: np.ndarray) -> tuple[float, np.ndarray]:
        point = arm.fk(configuration)[:3, 3]
        return -float(point @ point), -2.0 * point @ arm.jacobian(configuration)[:3]

    found = scipy.optimize.minimize(
        negative_square, best, jac=True, method="BFGS", options={"gtol": 1e-10}
    )
    return float(np.sqrt(-found.fun))


def symmetric_bases(distance: float) -> tuple[pin.SE3, pin.SE3]:
    """Bases of two arms side by side, ``distance`` [m] apart along y, the first on the +y side.

    They are symmetric to the xz plane, in which an arm and its mirror image reflect each other.
    """
    half = np.array([0.0, 0.5 * distance, 0.0])
    return pin.SE3(np.eye(3), half), pin.SE3(np.eye(3), -half)
