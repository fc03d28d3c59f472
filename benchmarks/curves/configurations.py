"""Poses of a six-joint arm, 10 to 10 million configurations at once."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
import pinocchio as pin
from growth import Series
from memory import touch
from robots import NAME, toolbox_chain

from dualarm_repro import load_arm
from dualarm_repro.arms.dh_model import FLANGE

TITLE, X = "poses of the flange in one call", "configurations"
SIZES = tuple(10**k for k in range(1, 8))


def series() -> list[Series]:
    """Ours, the bound of the machine, and peers as far as a call takes about a second."""
    arm = load_arm(NAME)

    def drawn(n: int) -> np.ndarray:
        return arm.random_configurations(n, np.random.default_rng(0))

    def ours(n: int) -> Callable[[], object]:
        q = drawn(n)
        return lambda: arm.fk(q)

    def bound(n: int) -> Callable[[], object]:
        q = drawn(n)
        return lambda: touch(q, np.empty((n, 16)))

    found = [
        Series("dualarm_repro", ours, SIZES),
        Series("touching the memory", bound, SIZES[:6], limit=True),
        Series("Pinocchio, Python loop", lambda n: _loop(arm.model, drawn(n)), SIZES[:5]),
    ]
    if find_spec("roboticstoolbox"):

        def toolbox(n: int) -> Callable[[], object]:
            q, chain = drawn(n), toolbox_chain(arm)
            return lambda: chain.eval(q)

        found.append(Series("roboticstoolbox ETS", toolbox, SIZES[:6]))
    return found


def _loop(model: pin.Model, q: np.ndarray) -> Callable[[], object]:
    data, flange = model.createData(), model.getFrameId(FLANGE)

    def run() -> np.ndarray:
        out = np.empty((len(q), 4, 4))
        for k, row in enumerate(q):
            pin.forwardKinematics(model, data, row)
            out[k] = pin.updateFramePlacement(model, data, flange).homogeneous
        return out

    return run
