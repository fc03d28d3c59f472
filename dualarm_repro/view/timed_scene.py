"""A timed motion of all arms as a 3-D scene with a play bar."""

from __future__ import annotations

import numpy as np

from ..planning.timing.timed_motion import TimedMotion
from .scene3d import Scene3D
from .task_scene import drawn_scene

#: Pictures a second.
_FRAMES = 20.0


def timed_scene(motion: TimedMotion, title: str) -> Scene3D:
    """The arms at equal times."""
    count = max(int(np.ceil(motion.duration * _FRAMES)), 1)
    time = np.linspace(0.0, motion.duration, count + 1)
    rows = {name: path.at(time) for name, path in motion.paths.items()}
    return drawn_scene(motion.scene, title, rows, np.arange(count + 1.0))
