"""Equations (9)-(15) of `pan`: Jacobians column by column from the axes of the joints."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.special import gamma

from dualarm_repro.ledger import Verdict, evaluate
from dualarm_repro.papers.pan.document import SEED, stand_in
from dualarm_repro.papers.pan.pages.measure import kinematics as page
from dualarm_repro.welding import closed_form

ARMS = ("er16", "er20-1780", "kr16-2", "irb2400")


def geometric(arm, q):
    """Columns (z x (p - o), z) of the Jacobian of the flange."""
    data = arm.model.createData()
    pin.framesForwardKinematics(arm.model, data, q)
    flange = data.oMf[arm.model.nframes - 1].translation
    return np.column_stack([
        np.concatenate([np.cross(M.rotation[:, 2], flange - M.translation), M.rotation[:, 2]])
        for M in list(data.oMi)[1:]
    ])  # fmt: skip


@pytest.fixture(scope="module", params=ARMS)
def arm(request, registry):
    return stand_in(request.param)


def test_measure_is_the_volume_of_the_columns(arm):
    q = arm.random_configurations(20, np.random.default_rng(1))
    columns = [geometric(arm, one) for one in q]
    np.testing.assert_allclose(arm.jacobian(q), columns, atol=1e-10)
    by_hand = [abs(np.linalg.det(J)) for J in columns]
    np.testing.assert_allclose(closed_form(arm, q), by_hand, atol=1e-11)


def test_largest_value_of_the_page_is_that_of_its_draws(stored, registry):
    arm = stand_in("er16")
    q = arm.random_configurations(500, np.random.default_rng(SEED))
    by_hand = max(abs(np.linalg.det(geometric(arm, one))) for one in q)
    assert stored["eq11"]["largest"] == pytest.approx(by_hand, rel=1e-9)


def test_pair_measure_is_the_product_of_its_draws(stored, registry):
    arm, rng = stand_in("er16"), np.random.default_rng(SEED)
    first, second = (arm.random_configurations(500, rng) for _ in range(2))
    products = [
        abs(np.linalg.det(geometric(arm, a))) * abs(np.linalg.det(geometric(arm, b)))
        for a, b in zip(first, second, strict=True)
    ]
    assert stored["eq15"]["largest"] == pytest.approx(max(products), rel=1e-9)


def test_no_unit_joint_velocity_leaves_the_ellipsoid(stored, registry):
    """v^T (J J^T)^-1 v = |J^+ v|^2 <= |q_dot|^2 = 1, and 1 only without a part that J forgets."""
    assert 0.9 < stored["eq10"]["inside"] <= 1.0 + 1e-12
    arm, rng = stand_in("er16"), np.random.default_rng(SEED)
    J = arm.jacobian(arm.random_configurations(500, rng))[:, :3]
    qd = page._unit(rng.normal(size=(500, 6)))
    shares = [np.linalg.norm(np.linalg.pinv(j) @ (j @ x)) ** 2 for j, x in zip(J, qd, strict=True)]
    assert stored["eq10"]["inside"] == pytest.approx(max(shares), rel=1e-9)


def test_volume_of_the_unit_ball_in_six_dimensions(stored):
    assert stored["claim_volume"]["factor"] == pytest.approx(np.pi**3 / gamma(4.0), rel=1e-9)


def test_unit_vectors_and_eigenvalues():
    vectors = np.array([[3.0, 4.0], [0.0, -2.0]])
    np.testing.assert_allclose(page._unit(vectors), [[0.6, 0.8], [0.0, -1.0]])
    np.testing.assert_allclose(page._eigenvalues(np.diag([1.0, 9.0, 4.0])), [9.0, 4.0, 1.0])


def test_random_motions_have_unit_speed_and_lie_within_limits(arm):
    motions = page._motions(arm, 30)
    assert len(motions) == 30
    for q, qd in motions:
        assert (arm.lower <= q).all()
        assert (q <= arm.upper).all()
        assert np.linalg.norm(qd) == pytest.approx(1.0)
    again = page._motions(arm, 30)
    assert all((a == c).all() and (b == d).all()
               for (a, b), (c, d) in zip(motions, again, strict=True))  # fmt: skip


@pytest.mark.parametrize(
    ("rows", "columns", "size"),
    [("12", "m + n", (12, 12)), ("2*m", "2*n", (12, 14)), ("2", "m", (2, 6))],
)
def test_printed_sizes(rows, columns, size):
    m, n = 6, 7 if rows == "2*m" else 6
    assert page._size({"rows": rows, "columns": columns}, m, n) == size


@pytest.mark.parametrize("item", ["eq09", "eq10", "eq11", "eq12", "eq14", "eq15", "claim_volume"])
@pytest.mark.parametrize("name", ["kr16-2"])
def test_equations_hold_for_another_arm(registry, item, name):
    assert evaluate(registry, f"pan.{item}", {"arm": name}).verdict is Verdict.REPRODUCED


def test_sizes_are_a_contradiction_because_of_print_alone(registry, stored):
    assert stored["eq13"]["entries"] == {"X_dot": 12, "Q_dot": 12}
    assert stored["eq13"]["sizes"] == {"X_dot": [2, 6], "Q_dot": [2, 6]}
    mended = {
        "X_dot": {"stack": ["x1_dot", "x2_dot"], "rows": "2*m", "columns": "1"},
        "Q_dot": {"stack": ["q1_dot", "q2_dot"], "rows": "2*n", "columns": "1"},
    }
    with registry.with_printed("pan.eq13", mended):
        assert evaluate(registry, "pan.eq13").verdict is Verdict.REPRODUCED
    short = {**mended, "X_dot": {**mended["X_dot"], "stack": ["x1_dot"]}}
    with registry.with_printed("pan.eq13", short):
        found = evaluate(registry, "pan.eq13")
    assert found.result.obtained["stacked"] is False
    assert found.result.obtained["as_printed"] is None
