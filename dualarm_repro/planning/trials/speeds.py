"""Two senses of the speed of a motion per instant: in the joints, and at the tool."""

from __future__ import annotations

import numpy as np

from ...scene import JointPath


def largest_joint_step(track: JointPath) -> float:
    """max |q_{i+1} - q_i| / (t_{i+1} - t_i), the largest displacement per instant [rad]."""
    steps = np.linalg.norm(np.diff(track.configurations, axis=0), axis=1) / np.diff(track.index)
    return float(steps.max())


def mean_advance(points: np.ndarray, index: np.ndarray) -> float:
    """Length of a track (N, 3) over the instants (N,) it takes [m]."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() / index[-1])
