"""Random tasks of several arms: a random start, and a circle of any direction for every tip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..scene.clearance import distances
from ..scene.posing import cores_in, frames_of, links_of
from ..scene.scene import Scene
from .circle import Circles
from .motion import FOLLOWED, Motion
from .settings import ControllerSettings
from .simulate import pseudo_inverse, simulate
from .system import ArmSystem

#: Step of the motion that screens a task [s].
SCREEN_STEP = 0.01
_APART = 3  # joints between links of one arm that are watched


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
    ranges = [placed.arm.usual_range for placed in system.arms]
    lower, upper = (np.concatenate(ends) for ends in zip(*ranges, strict=True))
    middle, half = 0.5 * (upper + lower), 0.45 * (upper - lower)
    q0 = middle + half.clip(max=0.9 * np.pi) * rng.uniform(-1.0, 1.0, system.nq)
    normals = rng.normal(size=(len(system.arms), 3))
    angles = rng.uniform(0.0, 2.0 * np.pi, len(system.arms))
    return CircleTask(q0, normals, angles, float(rng.uniform(*radii)))


def stands_clear(system: ArmSystem, task: CircleTask) -> bool:
    """Whether a task can be set on a floor z = 0: at its start no links of one arm touch and all
    that move are above the floor, and so are the paths of the tips."""
    circles = task.circles(system)
    drop = np.hypot(circles.u[:, 2], circles.v[:, 2])
    above = (circles.centre[:, 2] - drop > 0.0).all() and lowest(system, task.q0) > 0.0
    return bool(above and own_clearance(system, task.q0) > 0.0)


def own_clearance(system: ArmSystem, q: np.ndarray) -> float:
    """Smallest distance of two links of one arm, at least three joints apart [m].

    Capsules of links that are nearer along the arm overlap where their joints bend.
    """
    scene = Scene(system.arms, exempt=system.exempt, self_collision=True)
    watched = [
        a.owner == b.owner and abs((a.joint or 0) - (b.joint or 0)) >= _APART
        for a, b in scene.pairs.bodies
    ]
    return float(distances(scene, q)[np.array(watched)].min(initial=np.inf))


def lowest(system: ArmSystem, q: np.ndarray) -> float:
    """Height of the lowest point of all links but base and first, which never sink [m]."""
    heights = []
    for placed, part in zip(system.arms, np.split(q, system.arrays.start[1:-1]), strict=True):
        links, base = links_of(placed.arm), placed.placement.homogeneous[:3]
        frames = frames_of(placed.arm, base, part[np.newaxis])
        cores = cores_in(frames, links.joint, links.local)[0]
        low = cores[..., 2].min(axis=-1) - links.radius
        heights.append(low[links.joint > 1].min(initial=np.inf))
    return float(min(heights))


def naive_motion(system: ArmSystem, task: CircleTask, settings: ControllerSettings) -> Motion:
    """One turn by the pseudo-inverse, in the coarse steps of a screening."""
    circles = task.circles(system)
    return simulate(system, circles, task.q0, pseudo_inverse(settings), dt=SCREEN_STEP)


def admissible(naive: Motion, settings: ControllerSettings) -> bool:
    """Whether a naive motion stays on its path and starts outside the outer range."""
    reached = naive.finished and naive.largest_error < FOLLOWED
    return bool(reached and naive.distance[0] > settings.outer)
