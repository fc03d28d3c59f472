"""Random tasks of one arm: scenes of spheres in which the straight joint line is blocked."""

from __future__ import annotations

import numpy as np

from ...planning.checks.contact_check import contact_check
from ...scene import Scene, Sphere, distances
from .scenario import BASES, placed, shoulder

MARGIN = 0.03  # clearance of start and goal [m]


def random_task(count: int, rng: np.random.Generator) -> tuple[Scene, np.ndarray, np.ndarray]:
    """A scene with ``count`` spheres, a start and a goal (6,): both clear, the straight joint line
    blocked.

    Radii 0.06 to 0.14 m, centres 0.25 to 0.65 m from the shoulder and above the table; joints 4 and
    6 within half a turn. Drawn until a task fits.
    """
    arm = placed("master")
    limit = np.minimum(arm.arm.upper, np.pi), np.maximum(arm.arm.lower, -np.pi)
    while True:
        balls = {}
        for k in range(count):
            direction = rng.normal(size=3)
            centre = shoulder(BASES["master"]) + rng.uniform(
                0.25, 0.65
            ) * direction / np.linalg.norm(direction)
            balls[f"sphere_{k}"] = Sphere(
                [*centre[:2], max(centre[2], 0.15)], rng.uniform(0.06, 0.14)
            )
        turning = [("master/capsule_1_joint_1", "floor")]
        scene = Scene([arm], balls, floor=0.0, exempt=turning)
        for _ in range(40):
            ends = rng.uniform(limit[1], limit[0], (2, 6))
            if (distances(scene, ends).min(axis=1) > MARGIN).all():
                if contact_check(scene, ends).smallest < 0.0:
                    return scene, ends[0], ends[1]
