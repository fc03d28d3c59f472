"""Leaving obstacles out never changes the smallest distance of a motion."""

import time
from itertools import pairwise

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import (
    Box,
    Capsule,
    ConvexHull,
    HalfSpace,
    PlacedArm,
    Scene,
    Sphere,
    certified_minimum,
    distances,
)
from dualarm_repro.scene.broad_phase import MANY, bounds_of, near_scene, swept_boxes, with_arms
from dualarm_repro.scene.posing import cores_in, frames_of, links_of


def arms():
    right = pin.SE3(np.eye(3), np.array([0.0, 1.0, 0.0]))
    return [PlacedArm("left", load_arm("irb120")), PlacedArm("right", load_arm("panda"), right)]


def crowd(count, rng):
    """Small balls, bars, boxes and hulls in a wide ring, a few of them within reach."""
    found = {}
    for k in range(count):
        at = rng.uniform(-4.0, 4.0, 3) + np.array([0.0, 0.0, 1.0])
        if np.linalg.norm(at[:2] - [0.0, 0.5]) < 1.0:
            at[2] += 3.0
        corners = at + np.vstack([np.zeros(3), 0.1 * np.eye(3)])
        found[f"o{k}"] = (
            Sphere(at, 0.05),
            Capsule(at, at + 0.1, 0.03),
            Box(at, [0.1, 0.2, 0.05], pin.rpy.rpyToMatrix(*rng.uniform(-1, 1, 3))),
            ConvexHull(corners),
        )[k % 4]
    return found


def motion(scene, rng):
    ends = [
        np.concatenate([one.arm.random_configurations(1, rng)[0] for one in scene.arms])
        for _ in range(3)
    ]
    return np.vstack([np.linspace(a, b, 12) for a, b in pairwise(ends)])


@pytest.mark.parametrize("seed", [0, 1])
def test_the_smallest_distance_stays_the_same(seed):
    rng = np.random.default_rng(seed)
    scene = Scene(arms(), crowd(240, rng), floor=-0.5, exempt=[("o3", "left"), ("right", "floor")])
    path = motion(scene, rng)
    index = np.arange(float(len(path)))
    near = near_scene(scene, path, index)
    assert len(near.obstacles) < 0.7 * len(scene.obstacles)
    assert distances(near, path).min() == distances(scene, path).min()
    whole = certified_minimum(scene, path, index, 5e-3)
    part = certified_minimum(near, path, index, 5e-3)
    # the tolerance that both certificates were asked for [m]
    assert part.upper == pytest.approx(whole.upper, abs=5e-3)
    assert part.lower <= whole.upper + 1e-12


def test_few_obstacles_are_all_kept():
    scene = Scene(arms(), crowd(MANY - 1, np.random.default_rng(0)))
    assert near_scene(scene, np.zeros((1, scene.nq)), np.zeros(1)) is scene


SLIDING = """<robot name="slide"><link name="b"/>
<link name="l1"/><link name="l2"/><link name="l3"><collision><origin xyz="0.3 0 0"/><geometry>
<sphere radius="0.05"/></geometry></collision></link>
<joint name="turn" type="continuous"><parent link="b"/><child link="l1"/><axis xyz="0 0 1"/></joint>
<joint name="out" type="prismatic"><parent link="l1"/><child link="l2"/><axis xyz="1 0 0"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
<joint name="bend" type="revolute"><parent link="l2"/><child link="l3"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>"""


@pytest.mark.parametrize("sliding", [False, True])
def test_swept_boxes_hold_the_links_between_the_samples(sliding, tmp_path):
    """Turned by half a circle with the slide far out, a link comes 2 m away from both ends."""
    rng = np.random.default_rng(2)
    (tmp_path / "slide.urdf").write_text(SLIDING, encoding="utf-8")
    one = PlacedArm("slide", load_arm(tmp_path / "slide.urdf")) if sliding else arms()[0]
    scene = Scene([one])
    path = scene.arms[0].arm.random_configurations(2, rng)
    if sliding:
        path = np.array([[-1.5, 2.0, 0.3], [1.5, 2.0, -0.3]])
    low, high = swept_boxes(scene, path)
    arm, links = scene.arms[0].arm, links_of(scene.arms[0].arm)
    rows = path[0] + np.linspace(0, 1, 50)[:, None] * (path[1] - path[0])
    cores = cores_in(frames_of(arm, np.eye(3, 4), rows), links.joint, links.local)
    assert (cores.min(axis=2) - links.radius[:, None] >= low - 1e-12).all()
    assert (cores.max(axis=2) + links.radius[:, None] <= high + 1e-12).all()


@pytest.mark.parametrize(
    ("shape", "low", "high"),
    [
        (Sphere([1, 2, 3], 0.5), [0.5, 1.5, 2.5], [1.5, 2.5, 3.5]),
        (Capsule([0, 0, 0], [1, 0, 0], 0.1), [-0.1] * 3, [1.1, 0.1, 0.1]),
        (Box([0, 0, 0], [2, 1, 1], pin.rpy.rpyToMatrix(0, 0, np.pi / 2)), [-0.5, -1, -0.5], None),
        (ConvexHull(np.vstack([np.zeros(3), np.eye(3)])), [0, 0, 0], [1, 1, 1]),
        (HalfSpace([0, 0, 1], 0), [-np.inf] * 3, [np.inf] * 3),
    ],
)
def test_bounds(shape, low, high):
    found = bounds_of(shape)
    assert found[0] == pytest.approx(np.array(low, dtype=float))
    if high is not None:
        assert found[1] == pytest.approx(np.array(high, dtype=float))


def test_an_arm_alone_keeps_what_it_is_exempt_from():
    scene = Scene(arms(), floor=0.0, exempt=[("left", "floor"), ("right", "left")])
    alone = with_arms(scene, ["left"])
    assert list(alone.columns) == ["left"]
    assert list(alone.exempt) == [("left", "floor")]


def test_three_thousand_obstacles_and_thirteen_joints_take_seconds():
    rng = np.random.default_rng(4)
    scene = Scene(arms(), crowd(3000, rng))
    path = motion(scene, rng)
    began = time.process_time()
    near = near_scene(scene, path, np.arange(float(len(path))))
    certified_minimum(near, path, None, 1e-2)
    assert time.process_time() - began < 20.0
