"""Random tasks in which the straight joint line between start and goal is blocked."""

from __future__ import annotations

from collections.abc import Callable, Collection

import numpy as np
from numpy.typing import ArrayLike

from ...scene import PlacedArm, Scene, Sphere, distances
from ..checks.contact_check import contact_check

_TRIES = 40
_RADII, _SHELL, _LOWEST = (0.06, 0.14), (0.25, 0.65), 0.15


def blocked_task(
    arm: PlacedArm,
    shoulder: ArrayLike,
    count: int,
    margin: float,
    rng: np.random.Generator,
    floor: float | None = None,
    exempt: Collection[tuple[str, str]] = (),
) -> tuple[Scene, np.ndarray, np.ndarray]:
    """A scene of one arm and ``count`` spheres, a start and a goal (nq,) [rad].

    Both ends are clear by ``margin`` [m]. Radii of the spheres are 0.06 to 0.14 m, their centres
    0.25 to 0.65 m from the ``shoulder`` (3,) and above z = 0.15 m; joints stay within half a turn.
    Drawn until a task fits; 40 pairs of ends are tried in one scene.

    Parameters
    ----------
    floor
        Height of a floor [m], if there is one.
    exempt
        Pairs of bodies that are not watched, see :class:`.Scene`.
    """
    while True:
        balls = {}
        for k in range(count):
            direction = rng.normal(size=3)
            away = rng.uniform(*_SHELL) * direction / np.linalg.norm(direction)
            centre = np.asarray(shoulder) + away
            balls[f"sphere_{k}"] = Sphere(
                [*centre[:2], max(centre[2], _LOWEST)], rng.uniform(*_RADII)
            )
        scene = Scene([arm], balls, floor=floor, exempt=exempt)
        for _ in range(_TRIES):
            ends = rng.uniform(*_turns(scene), (2, arm.arm.nq))
            if (distances(scene, ends).min(axis=1) > margin).all():
                if contact_check(scene, ends).smallest < 0.0:
                    return scene, ends[0], ends[1]


def blocked_goal(
    scene: Scene,
    start: ArrayLike,
    margin: float,
    rng: np.random.Generator,
    draw: Callable[[np.random.Generator], np.ndarray | None] | None = None,
) -> np.ndarray:
    """Configuration of all arms of a scene (nq,), clear by ``margin`` [m], to which the straight
    line from ``start`` is in contact. Drawn until one fits.

    Parameters
    ----------
    draw
        Gives a configuration, or None for a draw that is none; by default uniform over the joints,
        which stay within half a turn.
    """
    while True:
        goal = rng.uniform(*_turns(scene)) if draw is None else draw(rng)
        if goal is None:
            continue
        clear = distances(scene, goal).min() > margin
        if clear and contact_check(scene, np.array([start, goal])).smallest < 0.0:
            return goal


def _turns(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    lower, upper = scene.limits
    return np.maximum(lower, -np.pi), np.minimum(upper, np.pi)
