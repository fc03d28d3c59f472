"""Certificates: gradient and curvature at a known minimum, saddle and slope."""

from dataclasses import replace

import numpy as np
import pytest
from window_scene import GOAL, IMPROVED, MASTER, SLAVE, START, around

from dualarm_repro.errors import InputError
from dualarm_repro.planning import Attraction, certify, obstacles_of
from dualarm_repro.planning.descent.certificate import hessian
from dualarm_repro.planning.descent.problem import problem
from dualarm_repro.scene import Scene, Sphere

NOTHING = obstacles_of(Scene([SLAVE]))
JOINTS = IMPROVED.changed(attraction=Attraction(gain=2.0, position_weight=0.0, joint_weight=1.5))


def test_in_a_bowl_of_the_joints():
    made = problem(SLAVE, START, GOAL, NOTHING, JOINTS)
    assert hessian(made, START, 0) == pytest.approx(3.0 * np.eye(6), abs=1e-6)
    there, away = certify(made, GOAL, 0), certify(made, START, 0)
    assert (there.gradient_norm, there.joint_error, there.position_error) == (0.0, 0.0, 0.0)
    assert there.smallest_curvature == pytest.approx(3.0)
    assert away.gradient_norm == pytest.approx(3.0 * np.linalg.norm(START - GOAL))
    assert there.acting == away.acting == ()


def test_a_saddle_shows_a_negative_curvature():
    """Stretched out exactly away from its target, the arm is in balance, yet every way is down."""
    q = np.zeros(6)
    made = problem(
        MASTER,
        q,
        np.array([np.pi, 0.0, 0.0, 0.0, 0.0, 0.0]),
        obstacles_of(Scene([MASTER])),
        IMPROVED.changed(attraction=Attraction(gain=1.0)),
    )
    assert made.field.gradient(q)[0] == pytest.approx(0.0, abs=1e-12)
    assert certify(made, q, 0).smallest_curvature < -1.0


def test_second_derivatives_are_those_of_the_value():
    ball = Sphere(
        SLAVE.placement.act(SLAVE.arm.positions(START)) + np.array([0.0, 0.0, 0.35]), 0.15
    )
    made = problem(SLAVE, START, GOAL, around(ball=ball), IMPROVED)
    second, h = hessian(made, START, 0), 1e-4
    assert made.repulsion.value(START) > 0
    for j, k in ((0, 0), (1, 2), (3, 4), (1, 1)):
        dj, dk = h * np.eye(6)[j], h * np.eye(6)[k]
        signs = ((1, dj + dk), (-1, dj - dk), (-1, dk - dj), (1, -dj - dk))
        numeric = sum(sign * made.field.value(START + d) for sign, d in signs) / (4 * h * h)
        assert second[j, k] == pytest.approx(numeric, rel=1e-3, abs=1e-3)


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_joints_held_by_a_limit_do_not_count(side):
    arm, second = MASTER.arm, np.arange(6) == 1
    middle, limit = 0.5 * (arm.lower + arm.upper), arm.lower if side < 0 else arm.upper
    settings = JOINTS.changed(enforce_limits=True)
    made = problem(MASTER, middle, middle, obstacles_of(Scene([MASTER])), settings)
    held = np.where(second, limit, middle)
    drawn_back = certify(made, held, 0).gradient_norm
    assert drawn_back == pytest.approx(3.0 * abs(limit - middle)[1])
    drawn_out = replace(made, goal=np.where(second, limit + side * 0.3, middle))
    assert certify(drawn_out, held, 0).gradient_norm == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("q", [[START], START[:, np.newaxis], 0.3])
def test_one_configuration_is_certified(q):
    made = problem(SLAVE, START, GOAL, around(), IMPROVED)
    with pytest.raises(InputError, match=r"certify: q \(its shape\) = .*finite numbers \(n,\)"):
        certify(made, np.array(q), 0)
