"""Random shapes and scenes, and coal as an independent judge."""

import coal
import numpy as np
import pinocchio as pin
from hypothesis import settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import (
    Box,
    Capsule,
    ConvexHull,
    HalfSpace,
    PlacedArm,
    Scene,
    Sphere,
    facing,
    window_frame,
)

# The first example compiles kernels.
thorough = settings(deadline=None, max_examples=60)

coordinates = st.floats(-1, 1).map(lambda x: round(x, 6))
points = st.tuples(coordinates, coordinates, coordinates)
lengths = st.floats(0.01, 0.8)
seeds = st.integers(0, 2**32 - 1)


def random_placement(rng, scale=1.0):
    q = rng.normal(size=4)
    return pin.SE3(pin.Quaternion(*q / np.linalg.norm(q)).matrix(), scale * rng.normal(size=3))


placements = seeds.map(lambda seed: random_placement(np.random.default_rng(seed)))
spheres = st.builds(Sphere, points, lengths)
capsules = st.builds(Capsule, points, points, lengths)
boxes = st.builds(
    lambda center, size, placement: Box(center, size, placement.rotation),
    points,
    st.tuples(lengths, lengths, lengths),
    placements,
)
half_spaces = st.builds(
    lambda placement, offset: HalfSpace(placement.rotation[:, 2], offset), placements, coordinates
)
hulls = seeds.map(
    lambda seed: ConvexHull(0.3 * np.random.default_rng(seed).normal(size=(12, 3)) + 0.2)
)
round_shapes = st.one_of(spheres, capsules)
shapes = st.one_of(spheres, capsules, boxes, half_spaces, hulls)


def random_capsule(rng, scale=0.5):
    return Capsule(scale * rng.normal(size=3), scale * rng.normal(size=3), rng.uniform(0.02, 0.2))


def random_box(rng):
    return Box(0.3 * rng.normal(size=3), rng.uniform(0.05, 0.8, 3), random_placement(rng).rotation)


def judged(a, b):
    """coal's signed distance and normal, with its tolerances tightened."""
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.gjk_tolerance = request.epa_tolerance = 1e-12
    request.gjk_max_iterations = request.epa_max_iterations = 1000
    distance = coal.distance(*a.coal(), *b.coal(), request, result)
    return distance, result.normal.copy()


def two_arms(obstacles=True, name="irb120", **options):
    """Two arms beside each other, turned by 90 degrees, among obstacles of every sort."""
    arm = load_arm(name)
    turn = pin.rpy.rpyToMatrix(0.0, 0.0, np.pi / 2)
    arms = [
        PlacedArm("left", arm, pin.SE3(turn, np.array([0.3, 0.0, 0.0]))),
        PlacedArm("right", arm, pin.SE3(turn, np.array([-0.3, 0.0, 0.0]))),
    ]
    rng = np.random.default_rng(5)
    things = {
        "ball": Sphere((0.0, 0.3, 0.6), 0.1),
        "pole": Capsule((0.4, 0.5, 0.0), (0.4, 0.5, 1.0), 0.05),
        "window": window_frame((0.0, 0.45, 0.5), facing((1.0, 0.2, 0.0)), 0.6, 0.6, 0.1, 0.08),
        "wall": HalfSpace((0.0, 1.0, 0.0), -0.3),
        "stone": ConvexHull(0.15 * rng.normal(size=(14, 3)) + [0.1, 0.45, 0.3]),
    }
    return Scene(arms, things if obstacles else {}, **options)


def central_difference(function, q, step=1e-6):
    """Derivative of a function of q (nq,), along a new last axis."""
    columns = []
    for unit in step * np.eye(len(q)):
        columns.append((function(q + unit) - function(q - unit)) / (2 * step))
    return np.stack(columns, axis=-1)
