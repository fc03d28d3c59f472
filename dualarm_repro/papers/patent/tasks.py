"""Random tasks for two arms, and the search for the frozen ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from ...control.circle import Circles
from ...control.motion import Motion
from ...control.settings import ControllerSettings
from ...control.simulate import pseudo_inverse, simulate
from ...control.system import ArmSystem
from ...scene.bodies import PlacedArm
from .robots import redundant_arm

REACHED = 1e-3  # [m] a path is within reach if the pseudo-inverse follows it to this
SCREEN_STEP = 0.01  # [s]


@dataclass(frozen=True, eq=False)
class Task:
    """One start of both arms and one circle per tip.

    ``normals`` (2, 3) and ``angles`` (2,) place the circles as in :meth:`.Circles.through`.
    """

    q0: np.ndarray
    normals: np.ndarray
    angles: np.ndarray
    radius: float

    def circles(self, system: ArmSystem, **timing) -> Circles:
        """The circles through the tips at the start."""
        return Circles.through(
            system.tips(self.q0), self.normals, self.angles, self.radius, **timing
        )


def arm_pair(robot: str, base_distance: float, capsules: str = "widened") -> ArmSystem:
    """Two arms of one model, bases ``base_distance`` apart along y, both looking along x."""
    arm = redundant_arm(robot, capsules)
    placed = []
    for name, side in (("left", 1.0), ("right", -1.0)):
        base = np.array([0.0, side * base_distance / 2, 0.0])
        placed.append(PlacedArm(name, arm, pin.SE3(np.eye(3), base)))
    return ArmSystem(placed)


def draw_task(system: ArmSystem, rng: np.random.Generator, radii: tuple[float, float]) -> Task:
    """Joint angles uniform in the middle nine tenths of their ranges, circles of any direction."""
    arrays = system.arrays
    middle, half = 0.5 * (arrays.upper + arrays.lower), 0.45 * (arrays.upper - arrays.lower)
    q0 = middle + half.clip(max=0.9 * np.pi) * rng.uniform(-1.0, 1.0, system.nq)
    normals = rng.normal(size=(len(system.arms), 3))
    angles = rng.uniform(0.0, 2.0 * np.pi, len(system.arms))
    return Task(q0, normals, angles, float(rng.uniform(*radii)))


def naive_motion(
    system: ArmSystem, task: Task, settings: ControllerSettings, dt: float = SCREEN_STEP
) -> Motion | None:
    """Motion by the pseudo-inverse; None if it starts inside the outer range or cannot follow."""
    circles = task.circles(system)
    motion = simulate(system, circles, task.q0, pseudo_inverse(settings), dt=dt)
    reached = motion.completed and motion.largest_error < REACHED
    return motion if reached and motion.distance[0] > settings.outer else None
