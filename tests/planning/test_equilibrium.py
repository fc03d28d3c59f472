"""Balance of attraction and repulsion: at one ratio of the gains, or at none."""

import numpy as np
import pytest
from two_spheres import START, obstacles, placed_arm, settings

from dualarm_repro.planning.field.joint_attraction import conic_force
from dualarm_repro.planning.search.equilibrium import equilibrium_at, nearest_equilibria, opposed
from dualarm_repro.planning.search.search_field import repulsive_torque_at
from dualarm_repro.planning.search.search_problem import search_problem

Q = np.array([0.9, 0.3, -0.4, 0.1, 0.2, 0.0])
TURN = np.eye(6)[3]


@pytest.fixture
def made():
    return search_problem(placed_arm(), START, START, obstacles(), settings())


@pytest.fixture
def opposing(made):
    """A goal (6,) that the repulsion at Q pushes straight away from."""
    push = repulsive_torque_at(made, Q)
    return Q - 1.3 * push / np.linalg.norm(push)


def test_opposed_forces_balance_at_the_ratio_that_is_found(made, opposing):
    found = equilibrium_at(made, Q, opposing)
    assert found.angle < 1e-7
    push = repulsive_torque_at(made, Q) / made.settings.repulsion.gain
    pull = conic_force(Q, opposing, 1000.0, 0.4, made.settings.attraction.measure)
    assert np.linalg.norm(pull + found.ratio * 1000.0 * push) < 1e-9 * np.linalg.norm(pull)
    assert np.isfinite(found.curvature)


def test_the_angle_is_that_between_attraction_and_the_opposite_of_repulsion(made, opposing):
    away = np.linalg.norm(opposing - Q) * (TURN - TURN @ (opposing - Q) * (opposing - Q) / 1.69)
    away /= np.linalg.norm(away) / np.linalg.norm(opposing - Q)
    goal = Q + np.cos(0.7) * (opposing - Q) + np.sin(0.7) * away
    assert equilibrium_at(made, Q, goal).angle == pytest.approx(0.7, abs=1e-6)
    assert np.linalg.norm(opposed(made, Q, goal)) == pytest.approx(2.0 * np.sin(0.35), abs=1e-6)


def test_a_balance_within_reach_is_found_and_one_out_of_reach_is_not(made, opposing):
    def place(x):
        return Q, opposing + x[0] * TURN

    limits = np.array([-2.0]), np.array([2.0])
    (found,) = nearest_equilibria(made, place, [np.array([1.5])], limits)
    assert found.angle < 1e-4
    beyond = np.array([1.0]), np.array([2.0])
    (missed,) = nearest_equilibria(made, place, [np.array([1.5])], beyond)
    assert missed.angle > 0.3


def test_without_repulsion_there_is_no_balance(made):
    chosen = settings(repulsion={"influence": 1e-6})
    quiet = search_problem(placed_arm(), START, START, obstacles(), chosen)
    found = equilibrium_at(quiet, Q, START)
    assert not np.isfinite(found.ratio)
    assert found.angle == pytest.approx(np.pi / 3)


def test_a_start_that_cannot_be_placed_is_left_out(made):
    assert nearest_equilibria(made, lambda x: None, [np.zeros(1)], (-np.ones(1), np.ones(1))) == []
