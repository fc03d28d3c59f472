"""A motion as a table for other tools: time, joints, path and distance, one row a sample."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from .circle import Circles
from .motion import Motion
from .system import ArmSystem

_DIGITS = 10  # kept behind the point: a tenth of a nanometre


def trajectory(system: ArmSystem, circles: Circles, motion: Motion) -> pd.DataFrame:
    """Columns of a motion along circles, its path time that of the clock.

    Of every arm the joint angles ``ARM_q1 [rad]`` ..., the joint velocities that are held over the
    step that follows, ``ARM_v1 [rad/s]`` ... (none in the last row), and where its tip shall be and
    how fast it shall move, ``ARM_x [m]`` ..., ``ARM_vx [m/s]`` ...; then ``distance [m]``.
    """
    held = np.vstack([motion.x, np.full((len(motion.q) - len(motion.x), system.nq), np.nan)])
    path = np.array([circles.at(float(t)) for t in motion.time])
    columns: dict[str, np.ndarray] = {"time [s]": motion.time}
    start = system.arrays.start
    for k, placed in enumerate(system.arms):
        joints = range(start[k], start[k + 1])
        for name, unit, values in (("q", "rad", motion.q), ("v", "rad/s", held)):
            columns |= {
                f"{placed.name}_{name}{j - start[k] + 1} [{unit}]": values[:, j] for j in joints
            }
        for which, unit in enumerate(("m", "m/s")):
            name = ("", "v")[which]
            columns |= {
                f"{placed.name}_{name}{axis} [{unit}]": path[:, which, k, r]
                for r, axis in enumerate("xyz")
            }
    columns["distance [m]"] = motion.distance
    return pd.DataFrame(columns).round(_DIGITS)


def trajectories(
    named: Mapping[str, tuple[ArmSystem, Circles, Motion]],
) -> pd.DataFrame:
    """Several motions one below the other, the first column says which."""
    return pd.concat(
        [trajectory(*of).assign(motion=name) for name, of in named.items()], ignore_index=True
    )[lambda made: ["motion", *made.columns.drop("motion")]]
