"""Scenes as a whole: nodes, key frames, marks, and the HTML of a page and of a file."""

import json
import re

import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro.arms import load_arm
from dualarm_repro.scene import Box, Capsule, ConvexHull, HalfSpace, Sphere
from dualarm_repro.view.scene3d import Scene3D

Q = np.array([0.3, -1.0, 0.5, 0.2, -0.4, 0.1])


@pytest.fixture(scope="module")
def scene():
    arm = load_arm("es165d")
    made = Scene3D("One arm & a box", camera=(3.0, -3.0, 2.0))
    made.add_arm("arm", arm, np.zeros(6))
    made.add_points("cloud", np.eye(3), "#0072B2")
    made.add_path("path", np.eye(3), "#0072B2")
    made.add_box("box", np.full(3, 0.2), np.eye(4), "#D55E00", solid=True)
    made.add_sphere("ball 1", np.ones(3), 0.1, "#D55E00")
    made.add_sphere("virtual point", np.ones(3), 0.1, "#D55E00")
    made.animate({"arm": (arm, np.linspace(np.zeros(6), np.ones(6), 10))}, every=4)
    return made


def data_of(html):
    return json.loads(re.search(r'class="scene-data">(.*?)</script>', html, re.DOTALL)[1])


def test_joint_nodes_carry_the_kinematics():
    arm, base = load_arm("es165d"), pin.SE3(np.eye(3), np.array([1.0, 2.0, 3.0]))
    made = Scene3D("pose", camera=(3.0, -3.0, 2.0))
    made.add_arm("arm", arm, Q, base)
    expected = base.homogeneous @ arm.fk(Q)
    np.testing.assert_allclose(made.contents.nodes["arm/6"], expected, atol=1e-12)


def test_key_frames_hold_every_fourth_and_the_last_posture(scene):
    motion = scene.contents.motion
    assert motion.frames.tolist() == [0, 4, 8, 9]
    last = load_arm("es165d").fk(np.ones(6))
    np.testing.assert_allclose(motion.poses["arm/6"][-1], last, atol=1e-12)


def test_a_path_of_one_posture_does_not_move():
    arm, made = load_arm("es165d"), Scene3D("still", camera=(1.0, 1.0, 1.0))
    made.add_arm("arm", arm, Q)
    made.animate({"arm": (arm, Q[np.newaxis])})
    assert made.contents.motion is None
    assert 'data-moves="no"' in made.page_html()


def test_the_shorter_of_two_paths_waits_at_its_end():
    arm, made = load_arm("es165d"), Scene3D("two", camera=(1.0, 1.0, 1.0))
    paths = {"a": np.linspace(Q, 1.1 * Q, 4), "b": np.linspace(Q, 0.9 * Q, 10)}
    for name in paths:
        made.add_arm(name, arm, Q)
    made.animate({name: (arm, path) for name, path in paths.items()}, every=1)
    np.testing.assert_allclose(made.contents.motion.poses["a/6"][-1], arm.fk(1.1 * Q), atol=1e-12)


def test_names_are_those_of_arms_and_places_without_number(scene):
    assert [mark.text for mark in scene.contents.marks] == ["arm", "virtual point"]


def test_a_page_has_the_picture_the_data_and_no_viewer(scene):
    page, alone = scene.page_html(), scene.html()
    assert 'alt="One arm &amp; a box"' in page
    assert page.count("data:image/webp;base64,") == 1
    assert len(page) < 0.2 * len(alone)
    assert "<iframe" not in page
    assert "http" not in page
    assert "overlap by" in page  # the box stands in the base of the arm
    assert {"start", "goal"} <= set(re.findall(r">(\w+)</span>", page))
    assert "MeshCat" in alone
    assert len(data_of(page)["parts"]) >= len(scene.contents.parts)


def test_a_text_cannot_close_the_script(scene):
    made = Scene3D("</script><b>", camera=(1.0, 1.0, 1.0))
    assert "</script><b>" not in made.page_html()


def test_html_can_be_asked_for_twice(scene):
    assert scene.page_html() == scene.page_html()


def test_a_still_scene_without_obstacle_measures_nothing():
    made = Scene3D("two", camera=(1.0, 1.0, 1.0))
    for k, name in enumerate(("a", "b")):
        made.add_arm(name, load_arm("es165d"), Q, pin.SE3(np.eye(3), np.array([0.0, 2.0 * k, 0.0])))
    assert "nearest" not in data_of(made.page_html())


def test_two_meshed_arms_in_long_motion_stay_small():
    arm = load_arm("panda")
    path = np.linspace(arm.lower, arm.upper, 301)
    made = Scene3D("two", camera=(1.0, 1.0, 1.0))
    for k, name in enumerate(("a", "b")):
        made.add_arm(name, arm, path[0], pin.SE3(np.eye(3), np.array([0.0, 0.5 * k, 0.0])))
    made.animate({"a": (arm, path), "b": (arm, path[::-1])})
    assert len(made.page_html()) < 300_000


@pytest.mark.parametrize(
    "shape",
    [
        Box([0.5, 0.0, 0.5], [0.1, 0.1, 0.1]),
        Sphere([0.5, 0.0, 0.5], 0.1),
        Capsule([0.5, 0.0, 0.5], [0.5, 0.2, 0.5], 0.1),
        ConvexHull(np.vstack([np.zeros(3), 0.2 * np.eye(3)]) + 0.5),
        HalfSpace([0.0, 0.0, 1.0], -0.2),
    ],
)
def test_every_obstacle_is_seen_and_measured(shape):
    made = Scene3D("obstacle", camera=(1.0, 1.0, 1.0))
    made.add_arm("arm", load_arm("irb120"), np.zeros(6))
    before = len(made.contents.parts)
    made.add_solid("thing", shape, "#9A9A9A")
    assert len(made.contents.parts) == before + 1
    assert "arm, link" in made.page_html()
