"""The arm of the benchmarks as other libraries know it."""

from __future__ import annotations

from typing import Any

import numpy as np

from dualarm_repro import load_arm
from dualarm_repro.arms.robot_file import load_robot_file
from dualarm_repro.datafiles import data_path

NAME = "irb120"


def toolbox_chain() -> Any:
    """The arm as a compiled ETS of roboticstoolbox, checked to have the same kinematics."""
    import roboticstoolbox as rtb

    table = load_robot_file(data_path("robots", f"{NAME}.yaml"))
    links = [
        rtb.RevoluteDH(d=j.d, a=j.a, alpha=float(j.alpha), offset=float(j.offset))
        for j in table.joints
    ]
    chain, arm = rtb.DHRobot(links).ets().compile(), load_arm(NAME)
    q = arm.random_configurations(100, np.random.default_rng(0))
    np.testing.assert_allclose(chain.eval(q), arm.fk(q), atol=1e-9)
    return chain
