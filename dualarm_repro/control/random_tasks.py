"""Random tasks of several arms: a random start, and a circle of any direction for every tip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .circle import Circles
from .motion import Motion
from .settings import ControllerSettings
from .simulate import pseudo_inverse, simulate
from .system import ArmSystem

#: A path is within reach if the pseudo-inverse follows it to this [m].
WITHIN_REACH = 1e-3
#: Step of the motion that screens a task [s].
SCREEN_STEP = 0.01


@dataclass(frozen=True, eq=False)
class CircleTask:
    """One start of all A arms and one circle per tip.

    Attributes
    ----------
    q0 : (n,) [rad]
    normals, angles : (A, 3), (A,)
        They place the circles as in :meth:`.Circles.through`.
    radius : float [m]
    """

    q0: np.ndarray
    normals: np.ndarray
    angles: np.ndarray
    radius: float

    def circles(self, system: ArmSystem, **timing: Any) -> Circles:
        """The circles through the tips at the start."""
        tips = system.tips(self.q0)
        return Circles.through(tips, self.normals, self.angles, self.radius, **timing)


def draw_task(
    system: ArmSystem, rng: np.random.Generator, radii: tuple[float, float]
) -> CircleTask:
    """Joint angles uniform in the middle nine tenths of their ranges, circles of any direction."""
    arrays = system.arrays
    middle, half = 0.5 * (arrays.upper + arrays.lower), 0.45 * (arrays.upper - arrays.lower)
    q0 = middle + half.clip(max=0.9 * np.pi) * rng.uniform(-1.0, 1.0, system.nq)
    normals = rng.normal(size=(len(system.arms), 3))
    angles = rng.uniform(0.0, 2.0 * np.pi, len(system.arms))
    return CircleTask(q0, normals, angles, float(rng.uniform(*radii)))


def naive_motion(system: ArmSystem, task: CircleTask, settings: ControllerSettings) -> Motion:
    """One turn by the pseudo-inverse, in the coarse steps of a screening."""
    circles = task.circles(system)
    return simulate(system, circles, task.q0, pseudo_inverse(settings), dt=SCREEN_STEP)


def admissible(naive: Motion, settings: ControllerSettings) -> bool:
    """Whether a naive motion stays on its path and starts outside the outer range."""
    reached = naive.completed and naive.largest_error < WITHIN_REACH
    return bool(reached and naive.distance[0] > settings.outer)
