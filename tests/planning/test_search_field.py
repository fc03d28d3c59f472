"""Repulsion of a search at a posture, the field around a disc, and the names of the variants."""

import numpy as np
import pytest
from two_spheres import GOAL, START, obstacles, placed_arm, settings

from dualarm_repro.differences import central_differences
from dualarm_repro.planning.field.disc_field import DiscField
from dualarm_repro.planning.search.search_field import (
    balance_distance,
    repulsive_potential_at,
    repulsive_torque_at,
)
from dualarm_repro.planning.search.search_problem import search_problem
from dualarm_repro.planning.search.variants import IMPROVED, TRADITIONAL, VARIANTS

Q = np.array([0.9, 0.3, -0.4, 0.1, 0.2, 0.0])


@pytest.mark.parametrize("sources", ["sum", "nearest"])
def test_torque_is_the_negative_slope_of_the_potential(sources):
    chosen = settings(repulsion={"sources": sources})
    made = search_problem(placed_arm(), START, GOAL, obstacles(), chosen)
    slope = central_differences(lambda q: repulsive_potential_at(made, q), Q)
    assert np.linalg.norm(slope) > 1.0
    assert repulsive_torque_at(made, Q) == pytest.approx(-slope, rel=1e-5, abs=1e-4)


def test_at_the_distance_of_balance_the_torque_is_the_pull():
    rho = balance_distance(40.0, 0.4, 400.0, 0.5)
    assert 0.5 * 40.0 * (1 / rho - 1 / 0.4) / rho**2 == pytest.approx(400.0, rel=1e-3)


def test_forces_of_a_disc_are_the_negative_slope():
    made = DiscField(np.array([1.0, 0.0]), np.array([0.45, -0.05]), 0.15, 1000.0, 0.4, 4.0, 0.4)
    for point in ([0.0, 0.25], [0.45, 0.32], [0.75, -0.2]):
        assert made.imbalance(np.array(point)) < 1e-6
    assert np.linalg.norm(made.forces(np.array([-2.0, 2.0]))[1]) == 0.0


def test_variants_are_named_by_their_improvements():
    assert (TRADITIONAL.name, IMPROVED.name) == ("traditional", "VAB")
    assert len({variant.name for variant in VARIANTS}) == 8
    assert [variant.two_sided for variant in VARIANTS] == [False] * 4 + [True] * 4
