"""Arms of the benchmarks as other libraries know them."""

from __future__ import annotations

from typing import Any

import numpy as np

from dualarm_repro.arms import Arm

NAME = "irb120"


def toolbox_chain(arm: Arm) -> Any:
    """The arm as a compiled ETS of roboticstoolbox, checked to have the same kinematics."""
    import roboticstoolbox as rtb

    parts = []
    for k in range(1, arm.model.njoints):
        parts += [rtb.ET.SE3(arm.model.jointPlacements[k].homogeneous), rtb.ET.Rz()]
    parts.append(rtb.ET.SE3(arm.model.frames[arm.flange_id].placement.homogeneous))
    chain = rtb.ETS(parts).compile()
    q = arm.random_configurations(100, np.random.default_rng(0))
    np.testing.assert_allclose(chain.eval(q), arm.fk(q), atol=1e-9)
    return chain
