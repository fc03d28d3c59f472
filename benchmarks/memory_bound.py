"""Forward kinematics of a batch beside the time that touching its memory takes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from equal_work import reference
from memory import touch
from timing import OURS, Row, timed

from dualarm_repro import load_arm

TASK, N = "poses of 100 000 configurations", 100_000


def measure() -> Iterator[Row]:
    """Rows of this suite; the bound allocates its result in every call, as the kernel does."""
    arm = load_arm("irb120")
    q = arm.random_configurations(N, np.random.default_rng(0))
    yield timed(TASK, OURS, lambda: arm.fk(q), N, check=reference())
    yield timed(
        *(TASK, "touching the memory", lambda: touch(q, np.empty((N, 16))), N),
        check=reference("the same bytes read and written"),
    )
