"""Closed form, ellipsoids and the measure of a cell against independent computations."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from dualarm_repro.arms import load_arm
from dualarm_repro.arms.wrist_geometry import wrist_geometry
from dualarm_repro.errors import UnknownNameError, UnsupportedArmError
from dualarm_repro.welding import Objective, Placement, closed_form, inverse_volumes
from dualarm_repro.welding.ellipsoid import (
    coupled_pair_volume,
    ellipsoid_volume,
    gram_matrices,
    intersection_volume,
    intersection_volume_monte_carlo,
    unit_ball_volume,
)
from dualarm_repro.welding.manipulability import tight_measure
from dualarm_repro.welding.objective import CHOICES

from .cells import make_cell
from .references import closed_form_reference, gram_matrices_reference

ARMS = ("er16", "er20-1780", "kr16-2", "irb2400", "irb120", "es165d")


@pytest.mark.parametrize("name", ARMS)
def test_closed_form_is_pinocchio(name):
    arm, rng = load_arm(name), np.random.default_rng(5)
    q = arm.random_configurations(500, rng)
    expected = []
    data = arm.model.createData()
    for row in q:
        frame = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        J = pin.computeFrameJacobian(arm.model, data, row, arm.flange_id, frame)
        expected.append(abs(np.linalg.det(J)))
    assert abs(closed_form(arm, q) - expected).max() < 1e-12
    twin = closed_form_reference(wrist_geometry(name, arm.chain), q)
    assert abs(closed_form(arm, q) - twin).max() < 1e-14


@given(st.integers(0, 10_000))
def test_what_the_closed_form_does_not_depend_on(seed):
    arm, rng = load_arm("kr16-2"), np.random.default_rng(seed)
    q = arm.random_configurations(1, rng)
    turned = q + rng.uniform(-3, 3, 6) * [1, 0, 0, 1, 0, 1]
    assert abs(closed_form(arm, turned) - closed_form(arm, q)).max() < 1e-13


def test_tool_does_not_matter():
    arm, q = (
        load_arm("kr16-2"),
        load_arm("kr16-2").random_configurations(50, np.random.default_rng(1)),
    )
    for lever in np.random.default_rng(2).normal(size=(5, 3)):
        levers = np.tile(lever, (50, 1))
        gram = gram_matrices(arm.chain, np.eye(3), q, levers, 6)
        assert abs(np.sqrt(np.linalg.det(gram)) - closed_form(arm, q)).max() < 1e-12


def test_no_spherical_wrist():
    for name in ("ur5", "panda"):
        with pytest.raises(UnsupportedArmError, match=name):
            closed_form(load_arm(name), np.zeros((1, load_arm(name).nq)))
    with pytest.raises(UnsupportedArmError, match="ur5"):
        make_cell(arms=[load_arm("kr16-2")] * 2 + [load_arm("ur5")])


@pytest.mark.parametrize("rows", [3, 6])
def test_gram_matrices_twin(rows):
    arm, rng = load_arm("er16"), np.random.default_rng(3)
    q, lever = arm.random_configurations(40, rng), rng.normal(size=(40, 3))
    R = pin.exp3(rng.normal(size=3))
    twin = gram_matrices_reference(arm.jacobian(q), R, lever, rows)
    assert abs(gram_matrices(arm.chain, R, q, lever, rows) - twin).max() < 1e-12


def test_gram_matrix_by_finite_differences():
    arm, rng = load_arm("er16"), np.random.default_rng(4)
    q, step = arm.random_configurations(1, rng)[0], 1e-6
    T, tool = arm.fk(q), np.array([0.1, -0.2, 0.3])
    columns = []
    for k in range(6):
        ends = [arm.fk(q + sign * step * np.eye(6)[k]) for sign in (1, -1)]
        columns.append(
            (ends[0][:3, :3] @ tool + ends[0][:3, 3] - ends[1][:3, :3] @ tool - ends[1][:3, 3])
            / (2 * step)
        )
    J = np.array(columns).T
    lever = (T[:3, :3] @ tool)[np.newaxis]
    gram = gram_matrices(arm.chain, np.eye(3), q[np.newaxis], lever, 3)[0]
    assert abs(gram - J @ J.T).max() < 1e-8


def _random_ellipsoids(count, seed):
    J = np.random.default_rng(seed).normal(size=(count, 3, 6))
    return J @ J.transpose(0, 2, 1)


@settings(max_examples=15)
@given(st.integers(0, 1000))
def test_intersection_volume(seed):
    A = _random_ellipsoids(3, seed)
    exact = intersection_volume(A)
    sampled, error = intersection_volume_monte_carlo(A, 40_000, np.random.default_rng(seed))
    assert abs(exact - sampled) < 5 * error + 1e-3 * exact
    assert exact <= ellipsoid_volume(A).min() * (1 + 1e-3)


def test_intersection_of_one_and_of_nested():
    A = _random_ellipsoids(1, 7)
    assert intersection_volume(A) == pytest.approx(float(ellipsoid_volume(A)[0]), rel=1e-3)
    nested = np.concatenate([A, 4 * A])
    assert intersection_volume(nested) == pytest.approx(float(ellipsoid_volume(A)[0]), rel=1e-3)


def test_coupled_pair_lies_inside_both():
    A, B = _random_ellipsoids(2, 8)
    inverse = np.linalg.inv(np.linalg.inv(A) + np.linalg.inv(B))
    expected = unit_ball_volume(3) * np.sqrt(np.linalg.det(inverse))
    assert coupled_pair_volume(A, B) == pytest.approx(expected, rel=1e-12)
    assert coupled_pair_volume(A, B) < intersection_volume(np.stack([A, B]))


@pytest.fixture(scope="module")
def job():
    cell = make_cell()
    placement = Placement(cell, Objective())
    jobs = placement.jobs([[0.0, 0.1, 0.8]])
    assert jobs.feasible.all()
    return cell, jobs


def test_common_intersection_cancels(job):
    """Weights V_int / V and 1 / V give the same measure, whatever V_int is."""
    cell, jobs = job
    inverse = inverse_volumes(cell, jobs.q, "translational", "mean")
    shared = np.random.default_rng(1).uniform(0.1, 10, cell.count)
    objective = Objective()
    one = objective.measures(jobs.w, inverse).system
    other = objective.measures(jobs.w, inverse * shared).system
    assert abs(one - other).max() < 1e-14
    wrong = objective.measures(jobs.w, inverse * np.stack([shared, 1 / shared])).system
    assert abs(one - wrong).max() > 1e-3


def test_harmonic_is_the_harmonic_mean(job):
    _, jobs = job
    found = Objective(weights="harmonic").measures(jobs.w, None)
    expected = 2 / (1 / found.tight + 1 / found.loose)
    assert abs(found.system - expected).max() < 1e-14


def test_full_weights_of_the_coupled_pair_and_of_all_ellipsoids(job):
    cell, jobs = job
    inverse = inverse_volumes(cell, jobs.q, "full", "mean")
    ball = unit_ball_volume(6)
    expected = 0.5 * (1 / jobs.w[:, 0] + 1 / jobs.w[:, 1]) / ball
    assert np.allclose(inverse[:, 0], expected, rtol=1e-9)
    assert np.allclose(inverse[:, 1], 1 / jobs.w[:, 2] / ball, rtol=1e-9)
    coupled = inverse_volumes(cell, jobs.q, "full", "coupled_pair")
    assert (coupled[:, 0] > inverse[:, 0]).all()


def test_unit_scales_the_parts_differently(job):
    _, jobs = job
    metre = Objective(weights="equal").measures(jobs.w, None)
    milli = Objective(weights="equal", unit="mm").measures(jobs.w, None)
    assert np.allclose(milli.tight, metre.tight * 1e18)
    assert np.allclose(milli.loose, metre.loose * 1e9)
    assert np.allclose(milli.system, 0.5 * milli.tight, rtol=1e-6)


def test_tight_measure_is_the_determinant_of_the_block_matrix():
    arm = load_arm("er16")
    q = arm.random_configurations(2, np.random.default_rng(9))
    J = np.zeros((12, 12))
    J[:6, :6], J[6:, 6:] = arm.jacobian(q)
    first, second = closed_form(arm, q)
    assert tight_measure(first, second) == pytest.approx(abs(np.linalg.det(J)), rel=1e-9)
    assert tight_measure(first, second, "geometric_mean") ** 2 == pytest.approx(first * second)


@pytest.mark.parametrize("field", list(CHOICES))
def test_unknown_reading(field):
    with pytest.raises(UnknownNameError, match=f"{field} = 'other'"):
        Objective(**{field: "other"})
    with pytest.raises(UnknownNameError, match="measure"):
        tight_measure(np.ones(1), np.ones(1), "sum")


def test_the_standard_error_of_a_sampled_volume_is_its_spread():
    A = 0.01 * _random_ellipsoids(2, 11)
    runs = [
        intersection_volume_monte_carlo(A, 2000, np.random.default_rng(seed)) for seed in range(200)
    ]
    volumes, errors = np.array(runs).T
    # a deviation of 200 runs has a standard error of 5 %: four of them
    assert np.std(volumes) == pytest.approx(np.mean(errors), rel=0.2)
