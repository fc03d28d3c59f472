"""Seeded random tasks of two arms among spheres, of graded difficulty, and ends near contact."""

from __future__ import annotations

import numpy as np
import pinocchio as pin

from ..arms import load_arm
from ..errors import InputError
from ..planning.checks.contact_check import contact_check
from ..scene import PlacedArm, Scene, Sphere, distances
from .case import Case

#: Robots of a pair, and how far apart their bases are [m].
PAIRS: dict[str, tuple[str, str, float]] = {
    "irb120-irb120": ("irb120", "irb120", 0.8),
    "panda-panda": ("panda", "panda", 0.9),
    "irb120-panda": ("irb120", "panda", 0.85),
}
#: Spheres by grade. The straight joint line is blocked in every grade.
GRADES = {"arms alone": 0, "2 spheres": 2, "5 spheres": 5, "10 spheres": 10}
#: Clearance of the ends of an ordinary task, and of an end near contact [m].
MARGIN, NEAR = 0.02, (0.001, 0.005)
_RADII, _HEIGHT = (0.05, 0.12), (0.15, 0.9)  # of spheres, and of their centres [m]
_DRAWS, _SCENES, _BISECTIONS = 300, 200, 60


def random_case(pair: str, grade: str, seed: int) -> Case:
    """Two arms face to face over a half-plane of spheres, both ends clear, the line between not.

    The scene and then start and goal are drawn uniformly and rejected until they fit.
    """
    rng = np.random.default_rng(
        [20_260_015, seed, list(PAIRS).index(pair), list(GRADES).index(grade)]
    )
    for _ in range(_SCENES):
        scene = _scene(pair, GRADES[grade], rng)
        clear = _clear_postures(scene, rng)
        for start, goal in zip(clear[::2], clear[1::2], strict=False):
            if contact_check(scene, np.array([start, goal])).smallest < 0.0:
                return _case(f"{pair}, {grade}, seed {seed}", scene, start, goal)
    raise InputError("arena", "task", f"{pair}, {grade}", f"one in {_SCENES} drawn scenes")


def near_case(pair: str, end: str, seed: int) -> Case:
    """A task among 2 spheres of which ``end`` (``start`` or ``goal``) is 1 to 5 mm from contact.

    The posture is found by bisection between one that is clear and one in contact.
    """
    rng = np.random.default_rng(
        [20_260_016, seed, list(PAIRS).index(pair), ("start", "goal").index(end)]
    )
    for _ in range(_SCENES):
        scene = _scene(pair, 2, rng)
        clear = _clear_postures(scene, rng)
        lower, upper = _turns(scene)
        for q, other in zip(clear[::2], clear[1::2], strict=False):
            touching = rng.uniform(lower, upper)
            near = _near(scene, q, touching)
            if near is None:
                continue
            ends = (near, other) if end == "start" else (other, near)
            return _case(f"{pair}, {end} near contact, seed {seed}", scene, *ends)
    raise InputError("arena", "task near contact", pair, f"one in {_SCENES} drawn scenes")


def _near(scene: Scene, clear: np.ndarray, touching: np.ndarray) -> np.ndarray | None:
    if distances(scene, touching).min() > 0.0:
        return None
    inside, outside = touching, clear
    for _ in range(_BISECTIONS):
        middle = 0.5 * (inside + outside)
        least = float(distances(scene, middle).min())
        if NEAR[0] <= least <= NEAR[1]:
            return middle
        inside, outside = (middle, outside) if least < NEAR[0] else (inside, middle)
    return None


def _case(name: str, scene: Scene, start: np.ndarray, goal: np.ndarray) -> Case:
    ends = [{n: q[part] for n, part in scene.columns.items()} for q in (start, goal)]
    return Case(name, scene, *ends)


def _clear_postures(scene: Scene, rng: np.random.Generator) -> np.ndarray:
    drawn = rng.uniform(*_turns(scene), (_DRAWS, scene.nq))
    return drawn[distances(scene, drawn).min(axis=1) > MARGIN]


def _scene(pair: str, spheres: int, rng: np.random.Generator) -> Scene:
    left, right, apart = PAIRS[pair]
    turned = pin.rpy.rpyToMatrix(0.0, 0.0, np.pi)
    arms = [
        PlacedArm("left", load_arm(left), pin.SE3(np.eye(3), np.array([-0.5 * apart, 0.0, 0.0]))),
        PlacedArm("right", load_arm(right), pin.SE3(turned, np.array([0.5 * apart, 0.0, 0.0]))),
    ]
    bases = [placed.placement.translation for placed in arms]
    balls: dict[str, Sphere] = {}
    while len(balls) < spheres:
        centre = rng.uniform([-0.6, -0.6, _HEIGHT[0]], [0.6, 0.6, _HEIGHT[1]])
        radius = rng.uniform(*_RADII)
        if min(np.linalg.norm((centre - base)[:2]) for base in bases) > radius + 0.2:
            balls[f"sphere_{len(balls)}"] = Sphere(centre, radius)
    return Scene(arms, balls)


def _turns(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    lower, upper = scene.limits
    return np.maximum(lower, -np.pi), np.minimum(upper, np.pi)
