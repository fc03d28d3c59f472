"""A timed motion as CSV, JSON, and YAML of the form of a ROS ``JointTrajectory`` message."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pandas as pd
import yaml

from .timed_motion import TimedMotion

#: Digits after the point in files, so many that differences of rows keep the limits as well.
_DIGITS = 9


def to_csv(motion: TimedMotion) -> str:
    """A row a sample: ``time`` [s], ``ARM.q1`` ... [rad], ``ARM.x``, ``ARM.y``, ``ARM.z`` [m].

    ``dualarm check`` reads it.
    """
    columns: dict[str, np.ndarray] = {"time": motion.time}
    for name, part in motion.scene.columns.items():
        joints = motion.q[:, part]
        columns |= {f"{name}.q{j + 1}": joints[:, j] for j in range(joints.shape[1])}
    for name, tips in motion.tips().items():
        columns |= {f"{name}.{axis}": tips[:, k] for k, axis in enumerate("xyz")}
    return pd.DataFrame(columns).to_csv(index=False, float_format=f"%.{_DIGITS}f")


def to_json(motion: TimedMotion) -> str:
    """Joint names, times [s], joints [rad], their speeds and accelerations, and tips [m]."""
    made = {
        "joint_names": joint_names(motion),
        "time_s": _rounded(motion.time),
        "joints_rad": _rounded(motion.q),
        "speeds_rad_per_s": _rounded(motion.speed),
        "accelerations_rad_per_s2": _rounded(motion.acceleration),
        "tips_m": {name: _rounded(tips) for name, tips in motion.tips().items()},
    }
    return json.dumps(made, indent=1) + "\n"


def to_joint_trajectory(motion: TimedMotion) -> str:
    """YAML of the fields of ``trajectory_msgs/JointTrajectory``, version 2 of ROS."""
    rows = zip(motion.time, motion.q, motion.speed, motion.acceleration, strict=True)
    points = [
        {
            "positions": _rounded(q),
            "velocities": _rounded(speed),
            "accelerations": _rounded(acceleration),
            "time_from_start": _duration(float(time)),
        }
        for time, q, speed, acceleration in rows
    ]
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    message = {"header": header, "joint_names": joint_names(motion), "points": points}
    return yaml.safe_dump(message, sort_keys=False, default_flow_style=None, width=10_000)


def joint_names(motion: TimedMotion) -> list[str]:
    """``ARM_JOINT`` for every joint, in the order of the columns."""
    return [
        f"{placed.name}_{placed.arm.model.names[j + 1]}"
        for placed in motion.scene.arms
        for j in range(placed.arm.nq)
    ]


def _duration(time: float) -> dict[str, int]:
    nanoseconds = round(time * 10**_DIGITS) * 10 ** (9 - _DIGITS)
    return {"sec": nanoseconds // 10**9, "nanosec": nanoseconds % 10**9}


def _rounded(values: np.ndarray) -> Any:
    return np.round(values, _DIGITS).tolist()
