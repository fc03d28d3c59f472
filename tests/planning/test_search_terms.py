"""Terms of the search: attraction, repulsion, variable gain, adaptive step."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from two_spheres import GOAL, START, obstacles, placed_arm, settings

from dualarm_repro.planning.descent.adaptive_step import step_length
from dualarm_repro.planning.field.joint_attraction import (
    conic_force,
    conic_potential,
    set_conic_force,
)
from dualarm_repro.planning.field.repulsive_force import (
    add_torque,
    inverse_distance_force,
    inverse_distance_potential,
    joint_torques,
)
from dualarm_repro.planning.field.variable_gain import gain_factor, is_flip
from dualarm_repro.planning.search.bidirectional import surroundings_at
from dualarm_repro.planning.search.bidirectional_settings import (
    FlipRule,
    GainRule,
    SearchStep,
    StepRule,
    Threshold,
)
from dualarm_repro.planning.search.search_problem import search_problem
from dualarm_repro.settings import code

VECTOR = st.lists(st.floats(-2, 2), min_size=6, max_size=6).map(np.array)


def gradient(function, q, step=1e-6):
    shifts = step * np.eye(len(q))
    return np.array([function(q + s) - function(q - s) for s in shifts]) / (2 * step)


@pytest.mark.parametrize("measure", Threshold)
@given(q=VECTOR)
def test_attraction_is_the_negative_gradient(measure, q):
    terms = (GOAL, 1000.0, 0.4, measure)
    force = conic_force(q, *terms)
    # forces are up to 980; differences may straddle the kink at the threshold
    assert force == pytest.approx(-gradient(lambda x: conic_potential(x, *terms), q), abs=1e-2)
    bound = 400.0 * (1 if measure is Threshold.NORM else np.sqrt(6))
    assert np.linalg.norm(force) <= bound * (1 + 1e-12)


@pytest.mark.parametrize("measure", Threshold)
@given(q=VECTOR)
def test_compiled_attraction(measure, q):
    out = np.empty(6)
    set_conic_force(q, GOAL, 1000.0, 0.4, code(measure), out)
    assert out == pytest.approx(conic_force(q, GOAL, 1000.0, 0.4, measure), abs=1e-10)


@given(rho=st.floats(0.01, 0.6))
def test_repulsion_is_the_negative_slope(rho):
    slope = gradient(lambda x: inverse_distance_potential(x[0], 3.0, 0.4), np.array([rho]), 1e-7)
    assert inverse_distance_force(rho, 3.0, 0.4, 1e-3) == pytest.approx(
        -slope[0], rel=1e-4, abs=1e-4
    )


def test_repulsion_is_zero_beyond_its_range_and_bounded_in_contact():
    assert inverse_distance_force(0.4, 3.0, 0.4, 1e-3) == 0.0
    assert inverse_distance_force(-1.0, 3.0, 0.4, 1e-3) == inverse_distance_force(
        1e-3, 3.0, 0.4, 1e-3
    )


def test_torques_are_the_negative_gradient_of_the_repulsive_potential():
    made = search_problem(placed_arm(), START, GOAL, obstacles(), settings())
    gain, influence = 10.0, 0.4

    def potential(q):
        rho = surroundings_at(made, 0, q, 0).distance
        return inverse_distance_potential(rho, gain, influence).sum()

    for q in np.linspace(START, GOAL, 7)[:-1]:
        found = surroundings_at(made, 0, q, 0)
        strength = inverse_distance_force.py_func
        push = sum(
            np.array([strength(d, gain, influence, 1e-3) for d in found.distance[:, m]])[:, None]
            * found.outward[:, m]
            for m in range(found.distance.shape[1])
        )
        torque = joint_torques(found.frames, made.points.joint, found.points, push)
        numeric = -gradient(potential, q)
        assert torque == pytest.approx(numeric, rel=1e-5, abs=1e-5 * np.abs(numeric).max())
        out = np.zeros(6)
        for joint, point, force in zip(made.points.joint, found.points, push, strict=True):
            add_torque(found.frames, joint, tuple(point), tuple(force), out)
        assert out == pytest.approx(torque, abs=1e-9)


@given(rho=st.floats(0.0, 1.0), kappa=st.floats(0.01, 1.0), flips=st.integers(1, 20))
def test_gain_factor(rho, kappa, flips):
    for rule in GainRule:
        value = gain_factor(code(rule), kappa, 0.05, rho, 0.3, flips)
        assert 0.0 <= value <= 1.0
        assert gain_factor(code(rule), kappa, 0.05, rho, 0.3, 0) == 1.0
        if abs(rho - 0.3) > 0.05:
            assert value == 1.0
    fewer = gain_factor(code(GainRule.POWER), kappa, 0.05, 0.3, 0.3, flips)
    assert gain_factor(code(GainRule.POWER), kappa, 0.05, 0.3, 0.3, flips + 1) <= fewer
    assert gain_factor(code(GainRule.POWER), 1.0, 0.05, 0.3, 0.3, flips) == 1.0
    assert gain_factor(code(GainRule.RAMP), kappa, 0.05, 0.3, 0.3, flips) == pytest.approx(
        1 - kappa
    )
    assert gain_factor(code(GainRule.PROPORTIONAL), kappa, 0.05, 0.3, 0.3, flips) == 0.0


def test_flip_rules():
    assert is_flip(code(FlipRule.NEGATIVE), -0.1)
    assert not is_flip(code(FlipRule.BELOW_MINUS_HALF), -0.1)
    assert is_flip(code(FlipRule.BELOW_MINUS_HALF), -0.6)


def values_without_floor(rho, weights):
    """The saturating step without its floor."""
    return step_length(code(StepRule.SATURATING), 0.05, 0.0, 2.0, weights, rho, 0.4)


@given(rho=st.lists(st.floats(0.0, 5.0), min_size=3, max_size=3).map(np.array))
def test_step_length(rho):
    weights = np.array([1.0, 2.0, 3.0]) / 6.0
    values = {rule: step_length(code(rule), 0.05, 0.2, 2.0, weights, rho, 0.4) for rule in StepRule}
    assert values[StepRule.CONSTANT] == 0.05
    assert all(0.2 * 0.05 <= value <= 2.0 * 0.05 for value in values.values())
    assert values[StepRule.SATURATING] <= 0.05 * (1 + 1e-12)
    lengthened = min(0.05 + values_without_floor(rho, weights), 0.1)
    assert values[StepRule.LENGTHENED] == pytest.approx(lengthened)
    for rule in StepRule:
        further = step_length(code(rule), 0.05, 0.2, 2.0, weights, rho + 0.1, 0.4)
        assert further >= values[rule] - 1e-15
    nothing_near = np.full(3, np.inf)
    assert step_length(code(StepRule.RELATIVE), 0.05, 0.2, 2.0, weights, nothing_near, 0.4) == 0.1


def test_a_step_keeps_between_a_fifth_and_twice_its_length_unless_told_otherwise():
    step, weights = SearchStep(length=0.05), np.ones(1)
    bounds = step.length, step.floor, step.cap
    for rho, share in ((0.0, 0.2), (np.inf, 2.0)):
        found = step_length(code(StepRule.RELATIVE), *bounds, weights, np.array([rho]), 0.4)
        assert found == pytest.approx(0.05 * share)
