"""Flange paths among spheres: names of marked points, and numbers of common times."""

import matplotlib.pyplot as plt
import numpy as np
import pinocchio as pin
import pytest

from dualarm_repro import load_arm
from dualarm_repro.scene import PlacedArm
from dualarm_repro.view.tip_paths import TipPanel, tip_path_figure

ARMS = [
    PlacedArm(name, load_arm("irb120"), pin.SE3(np.eye(3), np.array([x, 0.0, 0.0])))
    for name, x in (("left", -0.4), ("right", 0.4))
]
TURNS = [np.array([turn, 0.2, 0.1, 0.0, 0.5, 0.0]) for turn in (0.0, 0.6, 1.2)]
MARKS = {"start": np.array([0.3, 0.2, 0.5]), "goal": np.array([0.3, 0.25, 0.52])}


@pytest.fixture(autouse=True)
def closed():
    yield
    plt.close("all")


def drawn(arms, marks=None):
    postures = [(arm, q) for arm in arms for q in TURNS]
    figure = tip_path_figure([TipPanel("panel", {}, postures, marks or {})], [])
    return figure, [text for text in figure.axes[0].texts if text.get_text()]


def test_postures_of_several_arms_carry_the_number_of_their_time():
    _, texts = drawn(ARMS)
    assert sorted(text.get_text() for text in texts) == ["1", "1", "2", "2", "3", "3"]


def test_postures_of_one_arm_carry_none():
    assert drawn(ARMS[:1])[1] == []


def test_names_of_near_points_stand_apart():
    figure, texts = drawn(ARMS[:1], MARKS)
    figure.draw_without_rendering()
    one, other = (plt.Text.get_window_extent(text) for text in texts)
    assert {text.get_text() for text in texts} == set(MARKS)
    assert not one.overlaps(other)
