"""One configuration: pose, Jacobian and manipulability beside Pinocchio's own calls."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pinocchio as pin
from equal_work import reference, same
from timing import OURS, Row, timed

from dualarm_repro import load_arm
from dualarm_repro.arms.dh_model import FLANGE

CALLS = 500
POSE, JACOBIAN, MEASURE = "one pose", "one Jacobian", "one manipulability"


def measure() -> Iterator[Row]:
    """Rows of this suite."""
    arm = load_arm("irb120")
    some = list(arm.random_configurations(CALLS, np.random.default_rng(0)))
    model, data, flange = arm.model, arm.model.createData(), arm.model.getFrameId(FLANGE)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def pose(q: np.ndarray) -> object:
        pin.forwardKinematics(model, data, q)
        return pin.updateFramePlacement(model, data, flange)

    def jacobian(q: np.ndarray) -> np.ndarray:
        return pin.computeFrameJacobian(model, data, q, flange, axes)

    def manipulability(q: np.ndarray) -> float:
        return abs(np.linalg.det(jacobian(q)))

    for task, ours, theirs, read in (
        (POSE, arm.fk, pose, lambda found: found.homogeneous),
        (JACOBIAN, arm.jacobian, jacobian, np.array),
        (MEASURE, arm.manipulability, manipulability, float),
    ):
        yield timed(task, OURS, _each(ours, some), CALLS, check=reference())
        yield timed(
            *(task, "pinocchio", _each(theirs, some), CALLS),
            check=same(
                lambda ours=ours: np.stack([ours(q) for q in some]),
                lambda theirs=theirs, read=read: np.stack([read(theirs(q)) for q in some]),
                1e-9,
            ),
        )


def _each(call: Callable[[np.ndarray], object], some: list[np.ndarray]) -> Callable[[], None]:
    def run() -> None:
        for q in some:
            call(q)

    return run
